#include "pipeline/advise/improve/story.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/screen.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/job/beyond_limit.h"
#include "pipeline/study/mode_table.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

ImprovementStory::Lives lives_of(const Finals& finals, const Final& of, const Outcome& outcome,
                                 const StudyPlaces& places) {
  const std::string modes = mode_words(outcome);
  ImprovementStory::Lives lives{"", outcome.feasible() ? "all kept" : outcome.words(),
                                modes.empty() ? "none in the robot's life" : modes};
  if (const RankingRow* row = finals.worst_row(of)) {
    if (kind_of(places.job(row->job) / "page.html") != FileKind::absent) lives.page = row->job + "/page.html";
    const std::array<double, 3> hours =
        row->planned() ? row->planned_hours : std::array{row->life_hours, row->life_hours, row->life_hours};
    lives.p10 = hours[0], lives.p50 = hours[1], lives.p90 = hours[2];
  }
  return lives;
}

/// Returns "449,000 h, all limits kept; not validated: jacket wear from 5,890 h".
std::string outcome_words(const Outcome& outcome, double hours) {
  if (!outcome.failure.empty()) return "it does not run: " + outcome.failure;
  const std::string modes = mode_words(outcome);
  return fmt::format("{}, {}{}", hours_text(hours), outcome.feasible() ? "all limits kept" : outcome.words(),
                     modes.empty() ? "" : "; not validated: " + modes);
}

/// Returns a note that another trial is better without offsets, but not within the mounting tolerance; empty: none is.
std::string other_words(const Improvement& found, const Finals& finals) {
  const Final &best = *finals.best(), &drawn = *finals.best_drawn();
  if (best.trial == drawn.trial || !drawn.tolerance) return "";
  const Outcome& worst = drawn.tolerance->worst_outcome;
  return fmt::format("Trial {} is better as drawn ({}), but worse within that tolerance ({})\n", drawn.trial,
                     outcome_words(found.trials[drawn.trial].worst, drawn.hours), outcome_words(worst, worst.hours));
}

/// Returns a note that the wires of another trial live longer, but a mode without a validated law or a limit at other values gets
/// worse; empty: none do.
std::string refused_words(const Improvement& found, const Outcome& best) {
  const Outcome& as_it_is = found.trials.front().worst;
  std::optional<std::size_t> longest;
  for (std::size_t k = 1; k < found.trials.size(); ++k)
    if (found.merit(k).kept == Kept::limits &&
        found.trials[k].worst.hours > (longest ? found.trials[*longest].worst.hours : best.hours))
      longest = k;
  if (!longest || merit_of(best, as_it_is).kept <= Kept::limits) return "";
  const Outcome& of = found.trials[*longest].worst;
  std::string modes;
  for (const ModeLife& mode : worse_modes(of, as_it_is)) {
    const double own = life_by(as_it_is, mode.mode);
    modes += fmt::format("{}{} comes after {} (as it is: {})", modes.empty() ? "" : ", ", mode.mode,
                         hours_text(mode.hours), std::isinf(own) ? "never" : "after " + hours_text(own));
  }
  if (exceeds_more(of, as_it_is))
    modes += fmt::format("{}{} exceed a limit at other values (as it is: {})", modes.empty() ? "" : ", ",
                         percent_words(of.exceeding) + " of such dresspacks", percent_words(as_it_is.exceeding));
  return fmt::format("Trial {} was not chosen: its wires live longer ({}), but {}.\n", *longest, hours_text(of.hours),
                     modes);
}

/// Returns a note on bend reliefs that keep all limits, but make something fail earlier.
std::string relief_words(const Improvement& found) {
  std::string text;
  for (std::size_t k = 0; k < found.trials.size(); ++k)
    if (const Trial& trial = found.trials[k]; !trial.relief_refusal.empty() && trial.worst.violation() == 0)
      text +=
          fmt::format("Trial {} keeps all limits by a bend relief, but was refused: {}.\n", k, trial.relief_refusal);
  return text;
}

/// Returns the reason to keep the original jobs; empty: the best trial is a gain.
std::string keep_words(const Finals& finals) {
  const Final& best = *finals.best();
  if (finals.is_gain(best)) return "";
  if (finals.fails_earlier(best))
    return "Nothing that was tried is recommended: what keeps all limits fails earlier than the job as it is.";
  return clearly_better(best.merit, finals.of.front().merit)
             ? "Keep the job as it is. Nothing that was tried is clearly better within the mounting tolerance."
             : "Keep the job as it is. Nothing that was tried is clearly better.";
}

/// Returns lines: the worst results within the mounting tolerance, by which the best was chosen, and the reasons against others;
/// empty: none.
std::string choice_words(const Improvement& found, const Finals& finals) {
  const Final& best = *finals.best();
  std::string text;
  const auto add_worst = [&](const std::string& of, const Final& judged) {
    if (judged.tolerance)
      text += fmt::format("{}, within the mounting tolerance, at worst: {}\n", of,
                          outcome_words(judged.tolerance->worst_outcome, judged.tolerance->worst_outcome.hours));
  };
  if (finals.of.front().tolerance && best.trial != 0)
    add_worst(finals.is_gain(best) ? "The proposed job" : fmt::format("Trial {}", best.trial), best);
  add_worst("The job as it is", finals.of.front());
  return text + other_words(found, finals) +
         refused_words(found, finals.is_gain(best) ? found.trials[best.trial].worst : found.trials.front().worst) +
         relief_words(found);
}

std::string change_lines(const Trial& trial) {
  std::string text;
  for (const std::string& set : trial.sets) text += fmt::format("    --set '{}'\n", set);
  return text;
}

std::string front_words(const Improvement& found, const Finals& finals, const ImprovementStory& story, SecondAim second,
                        const MountingTolerance& tolerance) {
  std::string text = fmt::format("Longest lives for their {}:\n", word(second));
  for (const std::size_t k : found.front) {
    const Trial& trial = found.trials[k];
    const Final* const of = find_in(finals.of, &Final::trial, k);
    const std::string modes = mode_words(trial.worst);
    text += fmt::format("  {:>10}  {:>12}  {:.3f} m  {:.1f} s{}\n", k == 0 ? "as it is" : fmt::format("trial {:4}", k),
                        hours_text(of->hours), trial.hose_length, trial.cycle_seconds,
                        modes.empty() ? "" : "  not validated: " + modes);
  }
  const Final* const best = finals.best();
  if (!best || !best->tolerance) return text;
  return text + fmt::format("Trial {}: {}", best->trial, tolerance_words(story.nudges, tolerance));
}

/// Returns a line with the freed keys whose errors were not evaluated; empty: none.
std::string unjudged_words(const Improvement& found, const Trial& best) {
  const std::vector<std::string> keys = filtered(found.freed, [&](const std::string& key) {
    return !value_in(best, key).empty() && !has_mounting_tolerance(key);
  });
  return keys.empty() ? "" : fmt::format("Without a mounting tolerance: {}\n", joined(keys, ", "));
}

/// Returns left_at_other_values() of the worst of these jobs.
std::string left_of(const Finals& finals, const Final& of) {
  const RankingRow* const row = finals.worst_row(of);
  return row ? left_at_other_values(*row) : "";
}

}  // namespace

ImprovementStory story_of(const Improvement& found, const Finals& finals, SecondAim second, const StudyPlaces& places) {
  ImprovementStory story;
  story.name = found.name;
  for (std::size_t k = 0; k < found.trials.size(); ++k) {
    const Outcome& worst = found.trials[k].worst;
    story.points.push_back({static_cast<int>(k), worst.failure.empty(), worst.feasible(), worst.hours, worst.words()});
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
  for (std::size_t k = 0; k < found.freed.size(); ++k)
    if (const std::string value = value_in(trial, found.freed[k]); !value.empty())
      story.changes.push_back({found.freed[k], found.own[k], value});
  if (best->tolerance) story.nudges = best->tolerance->nudges;
  story.keep = keep_words(finals);
  story.choice = choice_words(found, finals);
  story.gain =
      gain_words(best->merit, trial.worst, finals.of.front().merit, found.trials.front().worst, story.longer_in);
  return story;
}

std::string gain_words(const Merit& best, const Outcome& after, const Merit& original, const Outcome& before,
                       const std::optional<double>& longer_in) {
  if (!before.failure.empty()) return "";
  const double robot = std::min(before.robot_life, after.robot_life);
  const auto first = [](const Outcome& of) {
    const ModeLife mode = first_mode(of);
    return mode.mode.empty() ? std::string("none in the robot's life")
                             : fmt::format("{} after {}", mode.mode, hours_text(mode.hours));
  };
  const std::string modes =
      fmt::format("First of the modes that are not validated: {} (as it is: {}).", first(after), first(before));
  if (before.hours >= robot && after.hours >= robot)
    return fmt::format("In both the wires outlive the robot ({}). A longer life of the wires is no gain. {}",
                       hours_text(robot), modes);
  const double ratio = std::min(after.hours, robot) / std::min(before.hours, robot);
  const bool longer = best.counted_hours > original.counted_hours && ratio > 1;
  std::string text =
      fmt::format("The wires live {:.2g} times as long{}.", ratio,
                  longer && after.hours > robot ? fmt::format(", up to the robot's life ({})", hours_text(robot)) : "");
  if (longer && longer_in)
    text += fmt::format(" They live longer in {:.0f} of 100 samples{}.", 100 * *longer_in,
                        *longer_in >= separated_share ? "" : ": no clear difference");
  return text + " " + modes;
}

std::string improvement_words(const Improvement& found, const Finals& finals, const ImprovementStory& story,
                              SecondAim second, const MountingTolerance& tolerance, const StudyPlaces& places) {
  const Outcome& was = found.trials.front().worst;
  std::string text = fmt::format("As it is: {}\n", outcome_words(was, finals.of.front().hours));
  if (finals.of.size() == 1) {
    text += fmt::format("No other job that keeps all limits was found in {} trial{} and {} short runs.\n",
                        found.trials.size(), found.trials.size() == 1 ? "" : "s", found.short_runs);
    for (const std::string& line : found.obstacle) text += line + "\n";
    return wrapped_lines(text + relief_words(found) + left_of(finals, finals.of.front()), screen_columns());
  }
  if (found.front.size() > 1) return text + front_words(found, finals, story, second, tolerance);
  const Final& best = *finals.best();
  const Trial& trial = found.trials[best.trial];
  const std::string judged =
      best.tolerance ? tolerance_words(story.nudges, tolerance) + unjudged_words(found, trial) : "";
  const bool gain = finals.is_gain(best);
  text += fmt::format("{}{} {} of {}: {}\n{}{}{}{}", story.keep, gain ? "Trial" : " The best of it is trial",
                      best.trial, found.trials.size(), outcome_words(trial.worst, best.hours), story.gain,
                      story.gain.empty() ? "" : "\n", judged, story.choice);
  text += beyond_words(trial.worst, was);
  if (!gain) return wrapped_lines(text + left_of(finals, finals.of.front()), screen_columns());
  if (const RankingRow* const found_row = finals.worst_row(best)) {
    RankingRow row = *found_row;
    name_file(row, places.job(row.job) / "job.yaml");
    for (const std::string& words : {action_words(row), uncertainty_words(row), failure_words(row)})
      text += words + (words.empty() ? "" : "\n");
    text += left_at_other_values(row);
    text = wrapped_lines(text, screen_columns()) + mode_table(row, screen_columns(), "") +
           mode_legend({row}, screen_columns(), "");
  }
  text += change_lines(trial);
  for (const std::string& job : best.jobs) text += fmt::format("Job: {}\n", (places.job(job) / "job.yaml").string());
  return text;
}

std::string remedy_after_search(const std::string& remedy) {
  if (!remedy.starts_with("other clamps")) return remedy;
  int depth = 0;
  for (std::size_t k = 0; k < remedy.size(); ++k) {
    depth += (remedy[k] == '(') - (remedy[k] == ')');
    if (depth > 0 || !remedy.substr(k).starts_with("; ")) continue;
    std::string rest = remedy.substr(k + 2);
    constexpr std::string_view searched = ", which dresslife improve tries";
    if (const std::size_t at = rest.find(searched); at != std::string::npos) rest.erase(at, searched.size());
    return rest.starts_with("or ") ? rest.substr(3) : rest;
  }
  return "";
}

std::string beyond_words(const Outcome& proposed, const Outcome& original) {
  const double now = std::round(100 * proposed.exceeding), before = std::round(100 * original.exceeding);
  if (now == 0 || !original.feasible()) return "";
  return fmt::format(
      "{}The limit that most dresspacks exceed at other values: {:.0f} % of them (as it is: {:.0f} %).\n",
      now > before ? "Worse at other values than the job as it is. " : "", now, before);
}

std::string left_at_other_values(const RankingRow& row) {
  std::string text;
  for (const Warning& warning : warnings_of(row)) {
    const WarningParts parts = parts_of(warning.words);
    if (warning.kind == WarningKind::side) text += parts.problem + ". Remedy: " + parts.remedy + "\n";
    if (warning.kind != WarningKind::other_values) continue;
    const std::string rest = remedy_after_search(parts.remedy);
    text += "Not kept at other values: " + parts.problem + ". ";
    text += rest == parts.remedy
                ? "Remedy: " + rest + "\n"
                : "The best clamps of this search do not keep it. Remedies that are left: " + rest +
                      (rest.empty() ? "" : "; ") +
                      "a guide ring between the clamps (routing.rings); or a program that reaches less far\n";
  }
  return text;
}

}  // namespace dresslife::pipeline
