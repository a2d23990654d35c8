#include "pipeline/study/row_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/text.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

bool outlives_robot(const RankingRow& row, double hours) {
  return std::isfinite(hours) && hours > row.robot_life_hours;
}

bool is_damaged(const RankingRow& row) { return !row.worst_component.empty() && row.damage_per_repeat > 0; }

/// Returns "strength x 1.33": the change of the job by makers' ratings; empty: none.
std::string ratings_of(const RankingRow& row) {
  constexpr std::string_view before = "uncertainty.ratings typical (";
  const std::size_t at = row.estimates.find(before), first = at + before.size();
  return at == std::string::npos ? "" : row.estimates.substr(first, row.estimates.find(')', first) - first);
}

/// Returns a remark on a ranking in which makers' ratings change some jobs more than others; empty: none.
std::string ratings_words(const std::vector<RankingRow>& rows) {
  std::vector<std::string> ratings, job;  // (group) the change, and the first of its jobs
  for (const RankingRow& row : rows)
    if (row.done() && !row.life_response.empty() && std::ranges::find(ratings, ratings_of(row)) == ratings.end())
      ratings.push_back(ratings_of(row)), job.push_back(row.job);
  if (ratings.size() < 2) return "";
  const auto words = [&](std::size_t k) {
    return fmt::format("{} ({})", job[k], ratings[k].empty() ? "no change" : ratings[k]);
  };
  return fmt::format(
      "Makers' ratings do not change all jobs in the same way: {}, {}. Do not compare these jobs. Set uncertainty.ratings: none in "
      "all, or remove the rated parameters and the fatigue settings from the jobs that state them.",
      words(0), words(1));
}

std::string cause_words(const RankingRow& row) {
  if (!(row.measure_next_share > 0)) return "";
  const UncertainParameter* const cause = find_in(uncertain_parameters(), &UncertainParameter::name, row.measure_next);
  // Prefer the number in life_shares, which is rounded so that all shares add up to 100 %.
  const std::size_t listed = ("; " + row.life_shares).find("; " + row.measure_next + " ");
  const double percent = listed == std::string::npos
                             ? 100 * row.measure_next_share
                             : std::strtod(row.life_shares.c_str() + listed + row.measure_next.size() + 1, nullptr);
  return fmt::format("{:.0f} % of the uncertainty is {}.", percent,
                     cause ? cause->cause : "the scatter from wire to wire");
}

/// Returns a remark on lays that data sheets leave out. They are no uncertain parameter: no scaling of strains gives their effect, which
/// changes its sign with the motion (config/defaults.md).
std::string lay_words(const RankingRow& row) {
  if (row.estimates.find("lay_length_mm") == std::string::npos) return "";
  return fmt::format(
      "Not in the range: the lay lengths that data sheets leave out (ESTIMATE), which are 0.67 to 1.33 times as long in other cables. "
      "In three tests of one cable this changed the 10 % value by factors of 0.42 to 2.1. For this job compare: dresslife run {} -o lay "
      "--set {}.estimated_lay_factor=0.67 (and 1.33).",
      job_file(row), row.worst_dresspack.empty() ? "dresspack" : "dresspacks.NUMBER.dresspack");
}

std::string test_words(const RankingRow& row) {
  if (row.life_response.empty() || std::isinf(row.planned_hours[0])) return "";
  const UncertainParameter* const test = find_in(uncertain_parameters(), &UncertainParameter::name, row.best_test);
  if (!test) return "No single measurement narrows the range much.";
  std::string measurement(test->test);
  measurement.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(measurement.front())));
  return fmt::format(
      "The measurement that narrows the range most: {}. If it confirms the estimate, {} (now {}).", measurement,
      std::isinf(row.tested_p10) ? "fewer than 1 of 10 such dresspacks fail"
                                 : "the range becomes about " + range_text(row.tested_p10, row.tested_p90),
      range_text(row.planned_hours[0], row.planned_hours[2]));
}

std::string error_words(const RankingRow& row) {
  std::string words = factor_words(row.planned_errors);
  if (words.empty()) return "";
  words = fmt::format(
      "These hours also have a numerical error, because lives change abruptly with stiffness, slack and friction, and only some values of these are "
      "computed: {}.",
      words);
  if (row.moving_places > 0)
    words += fmt::format(
        " The factors do not contain that loose cables do not come to a cycle at {:.0f} of the computed values of stiffness, slack and "
        "starts, so that a repeat there includes a change of their places.",
        row.moving_places);
  return words;
}

std::string joined_words(const std::vector<std::string>& sentences) {
  return joined(filtered(sentences, [](const std::string& sentence) { return !sentence.empty(); }), " ");
}

/// Returns "2,000 .. 90,000 h (10 .. 90 %, not validated)". Old files contain only the median.
std::string wall_life(const UnvalidatedMode& mode) {
  if (!std::isfinite(mode.hours[0])) return hours_text(mode.hours[1]) + " (not validated)";
  return fmt::format("{} (10 .. 90 %, not validated)", range_text(mode.hours[0], mode.hours[2]));
}

/// Returns the modes after earlier_unvalidated() that also come before replacement_hours(), the
/// earliest first: ", abrasion: from 25,000 h". Empty: none.
std::string further_unvalidated(const RankingRow& row) {
  const double end = replacement_hours(row);
  std::map<std::string, double> hours;  // of several parts the earliest hours
  for (const UnvalidatedMode& mode : row.unvalidated)
    if (mode.early_hours() < end && is_credible(mode))
      hours[mode.mode] =
          hours.contains(mode.mode) ? std::min(hours[mode.mode], mode.early_hours()) : mode.early_hours();
  if (const UnvalidatedMode* const first = earlier_unvalidated(row)) hours.erase(first->mode);
  std::vector<std::pair<double, std::string>> by_time;
  for (const auto& [mode, from] : hours) by_time.emplace_back(from, mode);
  std::ranges::sort(by_time);
  std::string text;
  for (const auto& [from, mode] : by_time) text += fmt::format(", {}: from {}", mode, hours_text(from));
  return text;
}

/// Returns the possible failure by the first unvalidated mode before the row's headline, and the action. Empty: none.
std::string first_inspection_words(const RankingRow& row) {
  const UnvalidatedMode* const mode = earlier_unvalidated(row);
  if (!mode) return "";
  const std::string of = mode->dresspack.empty() ? "The hose" : "The hose of " + mode->dresspack;
  const std::string place = fmt::format("{:.2f} m from the tool", mode->position_from_tool);
  if (mode->mode == UnvalidatedMode::wall)
    return fmt::format("{} may crack {} after {}: inspect it there.", of, place, wall_life(*mode));
  if (mode->mode == UnvalidatedMode::abrasion)
    return fmt::format(
        "{} may wear through on {}, {}, after {} (10 .. 90 %, not validated): inspect it there from {} on.", of,
        mode->place, place, range_text(mode->hours[0], mode->hours[2]), hours_text(mode->hours[0]));
  if (mode->mode == UnvalidatedMode::jacket)
    return fmt::format(
        "The jacket of {} may wear through in the hose, {}, after {} (10 .. 90 %, not validated): open the hose there from {} on.",
        mode->place, place, range_text(mode->hours[0], mode->hours[2]), hours_text(mode->hours[0]));
  if (mode->mode == UnvalidatedMode::rating)
    return fmt::format(
        "The maker's rating of {} covers only {} (10 .. 90 %, not validated): test or replace it by then.", mode->place,
        range_text(mode->hours[0], mode->hours[2]));
  if (mode->mode == UnvalidatedMode::corkscrew)
    return fmt::format(
        "Twist may wind {} into a corkscrew in the hose, {}, {}: open the hose there.", mode->place, place,
        std::isfinite(mode->hours[2])
            ? fmt::format("after {} (10 .. 90 %, not validated)", range_text(mode->hours[0], mode->hours[2]))
            : fmt::format("in 1 of 10 dresspacks after {}, and in some never (not validated)",
                          hours_text(mode->hours[0])));
  if (mode->mode == UnvalidatedMode::kink)
    return fmt::format("{}, {}. {} Enlarge the bend radius there, or take a tube with a thicker wall.",
                       mode->place == "the hose" ? std::string("The hose may kink")
                                                 : fmt::format("The {} may kink in the hose", mode->place),
                       place, mode->note);
  return fmt::format("{} may come before, {}, after {} (not validated): inspect it there.", mode->mode, place,
                     hours_text(mode->early_hours()));
}

/// Returns the hint at warnings that do not apply to the job's own values, and so do not stop a plan.
std::string other_values_words(const RankingRow& row) {
  return std::ranges::count(warnings_of(row), WarningKind::other_values, &Warning::kind) > 0
             ? "With other stiffness, slack or friction some dresspacks exceed a limit (see the warnings)."
             : "";
}

std::string inspection_words(const RankingRow& row) {
  const std::string further = further_unvalidated(row);
  return joined_words(
      {first_inspection_words(row), further.empty() ? "" : fmt::format("Inspect also for: {}.", further.substr(2))});
}

/// Returns whether a wire is one of a conductor. A cable that is the only one of its part has no number in the conductor's name.
bool is_in(const std::string& conductor, std::string wire) {
  if (wire.starts_with(conductor + "/")) return true;
  if (const std::size_t only = wire.find(" 1/"); only != std::string::npos) wire.erase(only, 2);
  return wire.starts_with(conductor + "/");
}

}  // namespace

double replacement_hours(const RankingRow& row) { return std::fmin(row.headline_hours(), row.robot_life_hours); }

const UnvalidatedMode* earlier_unvalidated(const RankingRow& row) {
  const UnvalidatedMode* first = nullptr;
  double before = replacement_hours(row);
  for (const UnvalidatedMode& mode : row.unvalidated)
    if (mode.early_hours() < before && is_credible(mode)) before = mode.early_hours(), first = &mode;
  return first;
}

std::string unvalidated_legend(const std::vector<RankingRow>& rows) {
  std::vector<std::string> modes;
  std::map<std::string, int> first;  // (mode) number of jobs in which the mode may come first
  for (const RankingRow& row : rows) {
    if (!row.has_result()) continue;
    if (plan_mark(row) == "*") ++first[earlier_unvalidated(row)->mode];
    for (const UnvalidatedMode& mode : row.unvalidated)
      if (std::ranges::find(modes, mode.mode) == modes.end()) modes.push_back(mode.mode);
  }
  if (modes.empty()) return "";
  std::vector<std::string> counts;
  for (const auto& [mode, jobs] : first)
    counts.push_back(fmt::format("{} in {} job{}", mode, jobs, jobs == 1 ? "" : "s"));
  return fmt::format("Not in these hours, because no test confirms their laws: {}.{}", joined(modes, ", "),
                     counts.empty()
                         ? ""
                         : fmt::format(" * marks jobs in which one of them may come first: {}.", joined(counts, ", ")));
}

std::string earlier_words(const RankingRow& row) {
  const UnvalidatedMode* const mode = earlier_unvalidated(row);
  return mode ? fmt::format("{}: from {}{}", mode->mode, hours_text(mode->early_hours()), further_unvalidated(row))
              : "";
}

std::string plan_mark(const RankingRow& row) {
  if (!row.has_result()) return "";
  return !is_believable(row) ? "!" : earlier_unvalidated(row) ? "*" : "";
}

std::string marks_note(const std::vector<RankingRow>& rows) {
  std::map<std::string, std::vector<std::string>> jobs;  // (mark) jobs with this mark
  for (const RankingRow& row : rows)
    if (const std::string mark = plan_mark(row); !mark.empty())
      jobs[mark].push_back((rows.size() > 1 ? row.job + ", " : "") +
                           (mark == "!" ? warning_kinds(row) : earlier_words(row)));
  return joined_words(
      {jobs["*"].empty() ? ""
                         : fmt::format("* Plan with this number, and inspect for modes that are not validated. {}.",
                                       joined(jobs["*"], "; ")),
       jobs["!"].empty() ? ""
                         : fmt::format("! Do not plan with this number before its warnings are cured. {}.",
                                       joined(jobs["!"], "; "))});
}

bool is_believable(const RankingRow& row) {
  const std::vector<Warning> warnings = warnings_of(row);
  return std::ranges::none_of(warnings, [](const Warning& warning) { return spoils_plan(warning); });
}

std::string range_text(double low_hours, double high_hours) {
  if (std::isinf(low_hours)) return "no damage";
  if (std::isinf(high_hours)) return hours_text(low_hours) + " .. no damage";
  return fmt::format("{} .. {}", readable(low_hours), hours_text(high_hours));
}

std::string shown_life(const RankingRow& row, double hours) {
  if (std::isnan(hours)) return row.has_wires() ? "-" : "no wires";
  // If some samples fail, a life without damage means a life longer than the robot's.
  const bool longer = std::isfinite(row.headline_hours()) && hours > row.robot_life_hours;
  return longer || outlives_robot(row, hours) ? "over " + readable(row.robot_life_hours) : life_text(hours);
}

std::string shown_range(const RankingRow& row, double low_hours, double high_hours) {
  const bool never = row.planned() && std::isinf(row.headline_hours());  // some dresspacks may still be damaged
  const auto end = [&](double hours) { return never && std::isinf(hours) ? "never" : shown_life(row, hours); };
  return std::isnan(low_hours) ? "-" : end(low_hours) + " .. " + end(high_hours);
}

std::string shown_calendar(const RankingRow& row) {
  if (!outlives_robot(row, row.headline_hours())) return calendar_text(row.headline_months());
  return "over " + calendar_text(row.headline_months() / row.headline_hours() * row.robot_life_hours);
}

std::string uncapped_words(const RankingRow& row) {
  const auto& [tenth, half, most] = row.planned_hours;
  if (!row.planned() || !std::isfinite(tenth) || !(most > row.robot_life_hours)) return "";
  std::string text = fmt::format("By the model 1 of 10 such dresspacks has failed after {} of motion ({})",
                                 hours_text(tenth), calendar_text(row.planned_months));
  if (std::isfinite(half)) text += ", half after " + hours_text(half);
  if (std::isfinite(most)) text += ", 90 % after " + hours_text(most);
  const auto after = [](double hours) { return std::isinf(hours) ? "never" : "after " + hours_text(hours); };
  if (!std::isnan(row.glued_hours[0]))
    text += fmt::format("; 1 of 10 {} with everything in the cables glued, {} with everything free",
                        after(row.glued_hours[0]), after(row.free_hours[0]));
  return text +
         fmt::format(". Hours beyond the robot's life ({} h) only compare jobs.", readable(row.robot_life_hours));
}

/// Returns a sentence if a life equals one of its bounds, for example with strain.slip free or stick. Empty: it lies between.
std::string bound_words(const RankingRow& row) {
  constexpr double bounds_apart = 1.1;  // closer bounds give the user no choice
  constexpr double same =
      0.01;  // a job with everything free differs from the bound by at most 0.8 % (strain/measurements.md)
  const double life = row.life_repeats, glued = row.life_repeats_all_stick, free = row.life_repeats_all_free;
  if (!(glued > 0) || !(free > bounds_apart * glued) || !std::isfinite(life)) return "";
  const bool is_free = life > free * (1 - same);
  if (!is_free && life > glued * (1 + same)) return "";
  // Ratings were compared with tests under friction, so other jobs do not include them (pipeline/resolve/apply_calibration.h).
  const bool has_ratings = !ratings_of(row).empty();
  const std::string rest =
      has_ratings
          ? "best estimate."
          : "best estimate. It includes the ratings of cable makers, which this life does not: it may be longer than this life.";
  return fmt::format(
      "The job's life equals its {} bound{}, at which nothing {} inside the cables. If the job sets strain.slip, leave "
      "it out for the {}",
      is_free ? "upper" : "lower", has_ratings ? "" : " without the ratings of cable makers",
      is_free ? "rubs" : "slips", rest);
}

namespace {

/// Returns action_words() without doubtful input.
std::string plan_words(const RankingRow& row) {
  const double hours = row.headline_hours();
  if (!is_believable(row))
    return fmt::format("Do not plan with {}: {} (see the warnings).",
                       !std::isfinite(hours) || outlives_robot(row, hours) ? "this result" : hours_text(hours),
                       warning_kinds(row));
  const std::string inspection = inspection_words(row), bound = bound_words(row), others = other_values_words(row);
  const bool may_fail_before = earlier_unvalidated(row);
  const std::string left_out = row.not_evaluated.empty() ? "" : fmt::format("Not evaluated: {}.", row.not_evaluated);
  if (!row.has_wires())
    return joined_words(
        {inspection,
         row.unvalidated.empty() ? "No part was evaluated."
                                 : "No wire was evaluated, so the table's hours are not validated.",
         row.unvalidated.empty() || may_fail_before
             ? ""
             : fmt::format("No evaluated mode comes within the robot's life ({} h) in 10 % of such dresspacks.",
                           readable(row.robot_life_hours)),
         others, left_out});
  if (std::isinf(hours))
    return joined_words(
        {inspection, !may_fail_before ? "No replacement is foreseen:" : "For the wires no replacement is foreseen:",
         row.planned() ? "in more than 90 % of the samples no wire fails." : "no wire is damaged.", bound, others});
  if (outlives_robot(row, hours))
    return joined_words({inspection,
                         fmt::format("The {} last longer than the robot ({} h).",
                                     may_fail_before ? "wires" : "evaluated parts", readable(row.robot_life_hours)),
                         bound, others, left_out});
  return joined_words({fmt::format("Plan a replacement after {} of motion ({}).", hours_text(hours),
                                   calendar_text(row.headline_months())),
                       inspection, bound, others});
}

}  // namespace

std::string action_words(const RankingRow& row) {
  if (!row.has_result()) return "";
  const std::string doubtful = doubtful_input(row);
  if (is_believable(row) && !doubtful.empty())
    return joined_words(
        {fmt::format("Do not use this result before you have confirmed or corrected its {} (see the warnings).",
                     doubtful),
         plan_words(row)});
  return plan_words(row);
}

std::string factor_words(const std::array<double, 3>& errors) {
  constexpr std::array shares{10, 50, 90};
  constexpr double none = 1.05;  // a smaller factor would be printed as 1
  std::string words;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (std::isfinite(errors[i]) && errors[i] >= none)
      words += fmt::format("{}the {} % value by a factor of {}", words.empty() ? "" : ", ", shares[i],
                           readable(errors[i], 2));
  return words;
}

std::string uncertainty_words(const RankingRow& row) {
  const std::string cause = cause_words(row);
  return joined_words({cause, cause.empty() ? "" : lay_words(row), test_words(row), error_words(row)});
}

std::string failing_place_words(const RankingRow& row) {
  return row.failing_conductor.empty()
             ? ""
             : fmt::format("{}, {:.2f} m from the tool", row.failing_conductor, row.failing_position_from_tool);
}

std::string failure_words(const RankingRow& row) {
  if (!row.has_wires()) return "";
  const std::string first =
      row.failing_mode.empty()
          ? ""
          : fmt::format("Fails first{}: {}, in {:.0f} % of the samples that fail{}{}.",
                        row.unvalidated.empty() ? "" : " of the validated modes", row.failing_mode,
                        100 * row.failing_mode_share, row.failing_conductor.empty() ? "" : ", likeliest ",
                        failing_place_words(row));
  if (!is_damaged(row))
    return first.empty() ? "No wire is damaged." : first + " With the job's own values no wire is damaged.";
  const std::string during = row.worst_step.empty() ? "" : ", during '" + row.worst_step + "'";
  const bool elsewhere = !row.failing_conductor.empty() && !is_in(row.failing_conductor, row.worst_component);
  return joined_words(
      {first,
       fmt::format("{} {}, {:.2f} m from the tool. Its most damaging cycle ends at {:.1f} s{}.",
                   elsewhere ? "With the job's own values another wire is the worst:" : "The worst wire is",
                   row.worst_component, row.worst_position_from_tool, row.worst_time, during),
       joint_words(row)});
}

std::string held_words(const RankingRow& row) {
  if (row.held_joint.empty()) return "";
  return fmt::format(
      "{} is held (motion.hold_joint): the tool does not follow its program. This life shows what the axis costs. Compare it with the "
      "same job without hold_joint only, not with other jobs.",
      row.held_joint);
}

void name_file(RankingRow& row, const std::filesystem::path& file, const std::vector<std::string>& sets) {
  const auto typed = [](const std::string& text) {  // in quotes only if it needs them
    const bool plain = std::ranges::all_of(text, [](unsigned char letter) {
      return std::isalnum(letter) ||
             std::string_view("_./=+-,:@%").find(static_cast<char>(letter)) != std::string_view::npos;
    });
    return plain ? text : shell_word(text);
  };
  row.file = typed(file.string());
  for (const std::string& set : sets) row.file += " --set " + typed(set);
}

std::string job_file(const RankingRow& row) { return row.file.empty() ? "JOB" : row.file; }

std::string joint_words(const RankingRow& row) {
  if (!row.held_joint.empty()) return "";
  if (!is_damaged(row) || row.worst_joint.empty()) return "";
  const std::string moved = row.worst_joint == "carrying"
                                ? "The damage follows the swing of the hose more than the position of any axis."
                                : fmt::format("The strain of this wire follows {} most.", row.worst_joint);
  return moved + " That is a correlation, no cause. This job without the axis shows what it costs: dresslife run " +
         job_file(row) +
         " -o held --set motion.hold_joint=" + (row.worst_joint == "carrying" ? "AXIS" : row.worst_joint);
}

std::string repeat_words(const RankingRow& row) {
  if (!row.planned() || !std::isfinite(row.planned_hours[0]) || outlives_robot(row, row.planned_hours[0])) return "";
  return fmt::format("One repeat of the motion takes {} s: 1 of 10 has failed after {} repeats.",
                     readable(row.repeat_seconds), readable(row.planned_hours[0] * 3600 / row.repeat_seconds));
}

std::string comparison_words(const std::vector<RankingRow>& rows) {
  std::size_t done = 0;
  bool uncertain = true;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const RankingRow& row : rows) {
    if (!row.done()) continue;
    ++done;
    uncertain = uncertain && !(is_damaged(row) && row.life_response.empty());
    shortest = std::min(shortest, row.repeat_seconds);
    longest = std::max(longest, row.repeat_seconds);
  }
  constexpr double alike = 1.02;  // below this ratio hours and repeats give the same order within the uncertainty
  return joined_words(
      {longest > alike * shortest
           ? fmt::format(
                 "Repeats take {} .. {} s. Compare jobs that do the same work by repeats (life_repeats_p10 in ranking.csv), not by hours.",
                 readable(shortest), readable(longest))
           : "",
       done > 1 && !uncertain
           ? "The ranks compare the jobs' own values only (uncertainty.enabled: false). Other values, and the numerical error "
             "of cables that move in their hose, may reverse them: run the study with uncertainty before you decide."
           : "",
       ratings_words(rows)});
}

std::string own_values_words(const RankingRow& row) {
  if (!row.planned() || !std::isfinite(row.first_wire_hours[0])) return "";
  const std::string words = fmt::format(
      "With the job's own values, by the scatter of wires alone, a first wire breaks after {} (10 .. 90 %).",
      range_text(row.first_wire_hours[0], row.first_wire_hours[2]));
  constexpr double decade = 10;
  // infinite: a tenth of a conductor's wires has no damage, so no life to compare with
  if (std::isinf(row.scatter_hours[1])) return words;
  const double times = row.planned_hours[1] / row.scatter_hours[1];
  if (std::isinf(times))
    return words + " Half of the samples are not damaged: most other values damage the wires less.";
  if (times > decade)
    return fmt::format(
        "{} Half of the samples live {} times longer than with these values: most other values damage the wires less.",
        words, readable(times, 2));
  if (times < 1 / decade)
    return fmt::format(
        "{} Half of the samples fail {} times sooner than with these values: most other values damage the wires more.",
        words, readable(1 / times, 2));
  return words;
}

std::string order_words(const RankingRow& row) {
  if (!row.outlives_next) return "";
  // A sample in which neither job fails counts half. If fewer than 10 % of the samples of this job fail and the share is so near
  // to a half, at most 30 % of those of the next one do.
  constexpr double near_half = 0.05;
  if (std::isinf(row.planned_hours[0]) && std::abs(*row.outlives_next - 0.5) <= near_half)
    return "In most samples neither this job nor the next one fails: no clear difference.";
  const double of_100 = 100 * *row.outlives_next;
  const bool clear = *row.outlives_next >= separated_share;
  if (*row.outlives_next <= 1 - separated_share)
    return fmt::format(
        "The next job lives longer in {:.0f} of 100 samples, but 1 of 10 of its dresspacks fails earlier.",
        100 - of_100);
  return fmt::format("Lives longer than the next job in {:.0f} of 100 samples{}.", of_100,
                     clear ? "" : ": no clear difference");
}

std::vector<std::string> estimate_words(const std::vector<RankingRow>& rows) {
  std::vector<std::pair<std::string, std::size_t>> all;
  for (const RankingRow& row : rows) {
    if (!row.done() || row.estimates.empty()) continue;
    if (auto* const same = find_in(all, &std::pair<std::string, std::size_t>::first, row.estimates))
      ++same->second;
    else
      all.emplace_back(row.estimates, 1);
  }
  std::vector<std::string> lines;
  for (const auto& [estimates, jobs] : all)
    lines.push_back(fmt::format("ESTIMATE, not in the dresspack{}: {}",
                                jobs == rows.size() ? "" : fmt::format(" of {} of {} jobs", jobs, rows.size()),
                                estimates));
  return lines;
}

}  // namespace dresslife::pipeline
