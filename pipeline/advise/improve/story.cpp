#include "pipeline/advise/improve/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "pipeline/advise/improve/nudges.h"
#include "pipeline/base/readable.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

/// The best with one thing off, as trials were run.
std::vector<ImprovementStory::Nudge> nudged(const Improvement& found, std::size_t trial,
                                            const ImproveRequest& request, double off,
                                            const StudyPlaces& places, const MakeRows& make_rows) {
  std::vector<ImprovementStory::Nudge> told;
  if (off == 0) return told;
  const std::vector<std::string>& sets = found.trials[trial].sets;
  const std::vector<Nudge> nudges = nudges_of(changed_jobs(request, sets, "place"), off);
  Study study{found.name, {}, found.keep_trials};
  std::vector<std::vector<std::string>> jobs;
  for (std::size_t k = 0; k < nudges.size(); ++k) {
    std::vector<std::string> all = sets;
    all.insert(all.end(), nudges[k].sets.begin(), nudges[k].sets.end());
    jobs.emplace_back();
    for (StudyJob& job : changed_jobs(request, all, fmt::format("off_{:02}", k + 1))) {
      jobs.back().push_back(job.name);
      study.jobs.push_back(std::move(job));
    }
  }
  if (study.jobs.empty()) return told;
  const std::vector<RankingRow> rows = make_rows(study);
  for (std::size_t k = 0; k < nudges.size(); ++k) {
    std::vector<Outcome> outcomes;
    for (const RankingRow& row : rows)
      if (is_of(row, jobs[k])) outcomes.push_back(outcome_of(row, places.job(row.job), found.limits));
    const Outcome worst = worst_of(outcomes);
    const double share = worst.hours / found.trials[trial].worst.hours;
    told.push_back({nudges[k].what, worst.failure.empty(), share, worst.words()});
  }
  return told;
}

ImprovementStory::Lives lives_of(const Finals& finals, const Final& of, const Outcome& outcome,
                                 const StudyPlaces& places) {
  ImprovementStory::Lives lives{"", outcome.feasible() ? "all kept" : outcome.words()};
  if (const RankingRow* row = finals.worst_row(of)) {
    if (kind_of(places.job(row->job) / "page.html") != FileKind::absent)
      lives.page = row->job + "/page.html";
    const std::array<double, 3> hours =
        row->planned() ? row->planned_hours : std::array{row->life_hours, row->life_hours, row->life_hours};
    lives.p10 = hours[0], lives.p50 = hours[1], lives.p90 = hours[2];
  }
  return lives;
}

/// How much the best forgives, in a line.
std::string forgives_words(const std::vector<ImprovementStory::Nudge>& nudges, double off) {
  if (nudges.empty()) return "";
  double least = HUGE_VAL;
  int broken = 0;
  for (const ImprovementStory::Nudge& nudge : nudges) {
    broken += !nudge.words.empty();
    if (nudge.ran && std::isfinite(nudge.share)) least = std::min(least, nudge.share);
  }
  std::string text = fmt::format("With a clamp or the length off by {:.3g} mm", 1000 * off);
  if (std::isfinite(least)) text += fmt::format(" it lives at least {:.2g} times as long", least);
  const char* joint = std::isfinite(least) ? ", and" : "";
  if (broken == 0) return text + joint + " all limits are kept\n";
  return text + fmt::format("{} {} of {} such jobs pass a limit\n", joint, broken, nudges.size());
}

std::string change_lines(const Trial& trial) {
  std::string text;
  for (const std::string& set : trial.sets) text += fmt::format("    --set '{}'\n", set);
  return text;
}

}  // namespace

ImprovementStory story_of(const Improvement& found, const Finals& finals, const ImproveRequest& request,
                          double off, const StudyPlaces& places, const MakeRows& make_rows) {
  ImprovementStory story;
  story.name = found.name;
  for (std::size_t k = 0; k < found.trials.size(); ++k) {
    const Outcome& worst = found.trials[k].worst;
    story.looks.push_back(
        {static_cast<int>(k), worst.failure.empty(), worst.feasible(), worst.hours, worst.words()});
  }
  const bool by_length = request.second == SecondAim::hose_length;
  story.second_title = by_length ? "free length [m]" : "cycle time [s]";
  for (std::size_t k = 0; request.second != SecondAim::none && k < found.front.size(); ++k) {
    const Trial& trial = found.trials[found.front[k]];
    story.front.emplace_back(by_length ? trial.hose_length : trial.cycle_seconds, trial.worst.hours);
  }
  if (found.trials.front().worst.failure.empty())
    story.before = lives_of(finals, finals.of.front(), found.trials.front().worst, places);
  const Final* best = finals.best();
  if (!best) return story;
  const Trial& trial = found.trials[best->trial];
  story.after = lives_of(finals, *best, trial.worst, places);
  story.longer_in = share_longer(finals, *best, places);
  for (std::size_t k = 0; k < trial.sets.size(); ++k)
    story.changes.push_back(
        {found.freed[k], found.own[k], trial.sets[k].substr(trial.sets[k].find('=') + 1)});
  story.nudges = nudged(found, best->trial, request, off, places, make_rows);
  return story;
}

std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, double off, const StudyPlaces& places) {
  const Outcome& was = found.trials.front().worst;
  std::string text = fmt::format(
      "As it is: {}{}\n", was.failure.empty() ? hours_text(finals.of.front().hours) : "it does not run",
      was.feasible()        ? ", all limits kept"
      : was.failure.empty() ? ", " + was.words()
                            : ": " + was.failure);
  if (finals.of.size() == 1) {
    text += fmt::format("No feasible job was found in {} trials and {} short runs.\n", found.trials.size(),
                        found.rehearsals);
    for (const std::string& line : found.obstacle) text += line + "\n";
    return text;
  }
  if (found.front.size() > 1) {
    text += fmt::format("Longest lives for their {}:\n", word(second));
    for (const std::size_t k : found.front) {
      const Trial& trial = found.trials[k];
      const auto of =
          std::find_if(finals.of.begin(), finals.of.end(), [&](const Final& one) { return one.trial == k; });
      text += fmt::format("  {:>10}  {:>12}  {:.3f} m  {:.1f} s\n",
                          k == 0 ? "as it is" : fmt::format("trial {:4}", k), hours_text(of->hours),
                          trial.hose_length, trial.cycle_seconds);
    }
    return text;
  }
  const Final& best = *finals.best();
  text += fmt::format("Trial {} of {}: {}, all limits kept", best.trial, found.trials.size(),
                      hours_text(best.hours));
  if (story.longer_in) text += fmt::format("; it lives longer in {:.0f} of 100 samples", 100 * *story.longer_in);
  text += "\n";
  if (const RankingRow* const row = finals.worst_row(best))
    for (const std::string& words : {action_words(*row), uncertainty_words(*row), failure_words(*row), hose_words(*row)})
      text += words + (words.empty() ? "" : "\n");
  text += change_lines(found.trials[best.trial]) + forgives_words(story.nudges, off);
  if (best.hours <= finals.of.front().hours && was.feasible())
    text += "Nothing that was tried lives longer.\n";
  for (const std::string& job : best.jobs)
    text += fmt::format("Job: {}\n", (places.job(job) / "job.yaml").string());
  return text;
}

}  // namespace dresslife::pipeline
