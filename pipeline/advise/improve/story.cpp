#include "pipeline/advise/improve/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "pipeline/base/readable.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

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

/// That another trial lives longer, but not as people mount it; empty: none does.
std::string other_words(const Finals& finals) {
  const Final &best = *finals.best(), &longest = *finals.longest();
  if (best.trial == longest.trial || !longest.tolerance) return "";
  return fmt::format("Trial {} lives longer without mounting errors ({}), but at most {} within that tolerance\n", longest.trial,
                     hours_text(longest.hours), hours_text(longest.tolerance->least_hours));
}

std::string change_lines(const Trial& trial) {
  std::string text;
  for (const std::string& set : trial.sets) text += fmt::format("    --set '{}'\n", set);
  return text;
}

}  // namespace

ImprovementStory story_of(const Improvement& found, const Finals& finals, SecondAim second, const StudyPlaces& places) {
  ImprovementStory story;
  story.name = found.name;
  for (std::size_t k = 0; k < found.trials.size(); ++k) {
    const Outcome& worst = found.trials[k].worst;
    story.looks.push_back(
        {static_cast<int>(k), worst.failure.empty(), worst.feasible(), worst.hours, worst.words()});
  }
  const bool by_length = second == SecondAim::hose_length;
  story.second_title = by_length ? "free length [m]" : "cycle time [s]";
  for (std::size_t k = 0; second != SecondAim::none && k < found.front.size(); ++k) {
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
  if (best->tolerance) story.nudges = best->tolerance->nudges;
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
    text += fmt::format("No feasible job was found in {} trial{} and {} short runs.\n", found.trials.size(),
                        found.trials.size() == 1 ? "" : "s",
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
  if (was.feasible() && best.hours <= finals.of.front().hours)
    return text + fmt::format("Nothing that was tried lives longer. Keep the job as it is. The best of {} trials, trial {}: {}{}.\n",
                              found.trials.size(), best.trial, hours_text(best.hours),
                              story.longer_in ? fmt::format("; it lives longer in {:.0f} of 100 samples", 100 * *story.longer_in) : "");
  text += fmt::format("Trial {} of {}: {}, all limits kept", best.trial, found.trials.size(),
                      hours_text(best.hours));
  if (story.longer_in) text += fmt::format("; it lives longer in {:.0f} of 100 samples", 100 * *story.longer_in);
  text += "\n";
  if (const RankingRow* const row = finals.worst_row(best))
    for (const std::string& words : {action_words(*row), uncertainty_words(*row), failure_words(*row), unvalidated_words(*row)})
      text += words + (words.empty() ? "" : "\n");
  text += change_lines(found.trials[best.trial]) + tolerance_words(story.nudges, off) + other_words(finals);
  for (const std::string& job : best.jobs)
    text += fmt::format("Job: {}\n", (places.job(job) / "job.yaml").string());
  return text;
}

}  // namespace dresslife::pipeline
