#include "pipeline/advise/plan/duty_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/screen.h"
#include "pipeline/life/planning.h"
#include "pipeline/settings/units.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

std::string indented_lines(const std::string& text) { return wrapped(text, screen_columns() - 2, "  "); }

/// Returns the remaining life of the robot, which also ran during the history.
double robot_life_left(const DutyResult& duty) { return std::max(0.0, duty.robot_life_hours - duty.past_hours); }

/// Returns the age at which the dresspack is replaced, at most the robot's. Hours that are not to be planned with replace nothing.
double replacement_age(const DutyResult& duty) {
  const double p10 = duty.past_hours > 0 ? duty.past_hours + duty.lives.remaining[0] : duty.lives.percentiles[0];
  return duty.doubtful.empty() ? std::min(p10, duty.robot_life_hours) : duty.robot_life_hours;
}

/// Returns the possible failure by the first unvalidated mode before the replacement, with the action.
std::string inspection(const DutyResult& duty) {
  const auto first = std::ranges::min_element(duty.others, {}, &DutyMode::hours);
  if (first == duty.others.end() || !(first->hours < replacement_age(duty))) return "";
  // The hours of these modes count from a new dresspack, those of the wires from now.
  const std::string after =
      hours_text(first->hours) +
      (duty.past_hours > 0 ? fmt::format(" from new (not validated; {} are past)", hours_text(duty.past_hours))
                           : " (not validated)");
  if (first->mode == UnvalidatedMode::rating)
    return fmt::format(" The maker's rating of {} covers only {}: test or replace it by then.", first->place, after);
  const std::string of = first->dresspack.empty() ? "" : " of " + first->dresspack;
  if (first->mode == UnvalidatedMode::jacket)
    return fmt::format(" A cable's jacket{} may wear through in the hose after {}: open the hose.", of, after);
  if (first->mode == UnvalidatedMode::corkscrew)
    return fmt::format(" Cables{} may wind into a corkscrew after {}: open the hose.", of, after);
  if (first->mode == UnvalidatedMode::kink)
    return fmt::format(" A tube in the hose{} may kink (not validated): see the job's page.", of);
  return fmt::format(" The hose{} may {} after {}: inspect it.", of,
                     first->mode == UnvalidatedMode::wall ? "crack" : "wear through", after);
}

/// Returns "by abrasion 1 of 10 is worn through after 3,000 h".
std::string other_words(const DutyMode& mode) {
  const std::string hours = hours_text(mode.hours), of = mode.dresspack.empty() ? "" : " of " + mode.dresspack;
  if (mode.mode == UnvalidatedMode::rating)
    return fmt::format("the maker's rating of {}{} covers {}", mode.place, of, hours);
  if (mode.mode == UnvalidatedMode::wall) return fmt::format("1 of 10 hoses{} has cracked after {}", of, hours);
  if (mode.mode == UnvalidatedMode::jacket)
    return fmt::format("1 of 10 dresspacks{} has a jacket worn through in the hose after {}", of, hours);
  if (mode.mode == UnvalidatedMode::corkscrew)
    return fmt::format("1 of 10 dresspacks{} has a corkscrew after {}", of, hours);
  if (mode.mode == UnvalidatedMode::kink)
    return std::isinf(mode.hours) ? fmt::format("no tube{} kinks in 9 of 10 dresspacks", of)
                                  : fmt::format("in 1 of 10 dresspacks or more a tube{} kinks", of);
  return fmt::format("1 of 10 hoses{} is worn through after {}", of, hours);
}

}  // namespace

std::string shown_hours(double robot_life, double hours) {
  return hours > robot_life ? "over " + readable(robot_life) : life_text(hours);
}

namespace {

/// Returns duty_action() without doubtful input.
std::string replacement_words(const DutyResult& duty) {
  const bool remains = duty.past_hours > 0;
  const double hours = remains ? duty.lives.remaining[0] : duty.lives.percentiles[0];
  const std::string when = remains ? fmt::format("in {} of operation from now on", hours_text(hours))
                                   : "after " + hours_text(hours) + " of operation";
  if (duty.doubtful.empty() && std::isinf(hours))
    return "No replacement is foreseen: in more than 90 % of the samples no wire fails." + inspection(duty);
  if (!duty.doubtful.empty())
    return fmt::format("Do not plan with {}: {} (see the warnings).",
                       hours > robot_life_left(duty) ? "this result" : hours_text(hours),
                       fmt::join(duty.doubtful, ", "));
  if (hours > robot_life_left(duty))
    return fmt::format("The wires last longer than the robot ({}).{}", hours_text(duty.robot_life_hours),
                       inspection(duty));
  return fmt::format("Plan a replacement {} ({} at {:g} h per week).{}", when,
                     calendar_text(months(hours, duty.hours_per_week)), duty.hours_per_week, inspection(duty));
}

}  // namespace

std::string duty_action(const DutyResult& duty) {
  const bool confirm = duty.doubtful.empty() && !duty.unconfirmed.empty();
  return (confirm ? fmt::format("Do not use this result before you have confirmed or corrected {} (see the warnings). ",
                                fmt::join(duty.unconfirmed, ", "))
                  : "") +
         replacement_words(duty);
}

std::string percentile_words(const DutyResult& duty) {
  const auto& [tenth, half, most] = duty.past_hours > 0 ? duty.lives.remaining : duty.lives.percentiles;
  if (std::isinf(tenth)) return "";
  const double robot_life = robot_life_left(duty);
  const auto calendar = [&](double hours) {
    const double shown = std::min(hours, robot_life);
    return fmt::format("{}{}", hours > shown ? "over " : "", calendar_text(months(shown, duty.hours_per_week)));
  };
  std::string words = fmt::format(
      "Hours of operation, with standstill, until 1 of 10, half and 90 % have failed: {}, {}, {}. By the calendar, at {:g} h per "
      "week: {}, {}, {}.",
      shown_hours(robot_life, tenth), shown_hours(robot_life, half), shown_hours(robot_life, most), duty.hours_per_week,
      calendar(tenth), calendar(half), calendar(most));
  if (duty.past_hours > 0)
    words += fmt::format(
        " These hours begin now, after {} of operation. By the model {:.0f} % of such dresspacks live until now. The hours are only for these: an "
        "old dresspack that lives is more likely a strong one, so its remaining life may be longer than the life of a new one.",
        hours_text(duty.past_hours), 100 * duty.lives.survived);
  return words;
}

std::string caution_words(const DutyResult& duty) {
  std::string text;
  std::vector<std::string> soon;
  for (const DutyMode& mode : duty.others)
    if (mode.hours < replacement_age(duty)) soon.push_back(other_words(mode));
  if (!soon.empty())
    text += indented_lines(fmt::format("Not validated and not in these hours, at the soonest{}: {}.",
                                       duty.past_hours > 0 ? " (from new, by these programs only)" : "",
                                       fmt::join(soon, "; ")));
  if (!duty.not_evaluated.empty()) text += indented_lines(fmt::format("Not evaluated: {}.", duty.not_evaluated));
  return text;
}

namespace {

std::string recording_words(const DutyResult& duty) {
  constexpr double worth_a_word = 0.01;  // share of the duty's damage
  std::map<std::string, std::vector<std::size_t>> cycles;
  for (std::size_t k = 0; k < duty.parts.size(); ++k)
    if (!duty.parts[k].recording_of.empty() && duty.parts[k].repeats_per_hour > 0)
      cycles[duty.parts[k].recording_of].push_back(k);
  std::string text;
  bool leaves_out_rests = false;
  for (const auto& [name, of] : cycles) {
    double repeats = 0, damage = 0, squares = 0;
    for (const std::size_t k : of) repeats += duty.parts[k].repeats_per_hour, damage += duty.lives.share[k];
    if (of.size() < 2 || !(damage > worth_a_word)) continue;
    double least = INFINITY, most = 0, before = 0;
    std::array<double, 2> at_other_rests{};
    for (const std::size_t k : of) {
      const double times = duty.lives.share[k] / duty.parts[k].repeats_per_hour / (damage / repeats);
      least = std::min(least, times), most = std::max(most, times);
      if (k != of.front())
        squares += (times - before) * (times - before) / 2;  // they are in the order of their expected damage
      before = times;
      for (const std::size_t side : {0, 1})
        at_other_rests[side] += duty.lives.share[k] / damage * duty.parts[k].at_other_rests[side];
    }
    const double count = static_cast<double>(of.size()), error = std::sqrt(squares / (count - 1) / count);
    std::string words = fmt::format(
        "The {} recordings of {} do {:.2f} to {:.2f} times its mean damage: the standard error of the mean is {} %.",
        of.size(), name, least, most, readable(100 * error, 2));
    const auto [low, high] = std::minmax(at_other_rests[0], at_other_rests[1]);
    if (!(low > 0)) {
      leaves_out_rests = true;
    } else if (high > low) {
      const double of_rest = std::max(std::abs(std::log(low)), std::abs(std::log(high)));
      words += fmt::format(
          " With the loose cables at other places of rest (one standard deviation) it is {} to {} times as large. Together the mean is known "
          "within a factor of {}.",
          readable(low, 2), readable(high, 2), readable(std::exp(std::hypot(of_rest, std::log1p(error))), 2));
    }
    text += indented_lines(words);
  }
  if (leaves_out_rests)
    text += indented_lines(
        "Where cables lie loose in the hose, the damage of a cycle also depends on the places at which they rest before it. With "
        "uncertainty.rest: 0 the standard error leaves that out: it may be several times too small.");
  return text;
}

}  // namespace

std::string mixture_words(const DutyResult& duty) {
  constexpr double worth_a_word = 0.01, worth_a_place = 0.05;
  std::string text = recording_words(duty);
  if (const std::string factors = factor_words(duty.errors); !factors.empty())
    text += indented_lines(fmt::format(
        "The hours of a new dresspack have the numerical error of the programs' lives: {}. With loose cables one motion of the whole "
        "log or of the whole order may differ from the duty by about as much, because friction holds the cables at other places.",
        factors));
  std::vector<std::string> larger;
  for (std::size_t m = 0; m < duty.modes.size(); ++m) {
    const double apart = duty.damage.same_place[m] / duty.changes[m];
    if (1 / apart > 1 + worth_a_place)
      larger.push_back(fmt::format("{} by {:.0f} %", duty.modes[m], 100 / apart - 100));
    if (std::abs(duty.changes[m] - 1) > worth_a_word)
      text += indented_lines(fmt::format("Changes between the programs make the damage of {} {:.2f} times as large.",
                                         duty.modes[m], duty.changes[m]));
  }
  if (!larger.empty())
    text += indented_lines(fmt::format(
        "The programs damage different places. If all damaged the same place, the damage would be larger: {}.",
        fmt::join(larger, ", ")));
  // Measured pairs: README. Strain: damage is proportional to strain to the power 1/0.112 (copper.yaml).
  if (duty.has_order)
    text += indented_lines(fmt::format(
        "The order runs {} times per hour. Abrasion between the programs is not counted.{}",
        readable(duty.rounds_per_hour),
        duty.outside.empty()
            ? ""
            : fmt::format(
                  " The order has room for fewer repeats than the duty: these shares of them count without changes "
                  "to another program: {}.",
                  fmt::join(duty.outside, ", "))));
  else if (std::ranges::count_if(duty.parts, [](const DutyPart& part) { return part.repeats_per_hour > 0; }) > 1)
    text += indented_lines(
        "Cycles that begin in one program and end in another are not counted. With `order` or `batch_size` they are. For one measured pair "
        "they were 11 % of the damage, or 1.2 % of strain. Where two programs bend a cable to opposite sides they can be most of the damage.");
  return text;
}

std::string without_text(const DutyResult& duty, const DutyPart& part) {
  return std::isnan(part.without[0]) ? "not known" : shown_hours(duty.robot_life_hours, part.without[0]);
}

std::string as_twice_text(const DutyResult& duty, const DutyPart& part) {
  return std::isnan(part.as_twice[0]) ? "no time for it" : shown_hours(duty.robot_life_hours, part.as_twice[0]);
}

std::string duty_words(const std::vector<DutyResult>& results) {
  std::string text;
  for (const DutyResult& duty : results) {
    double time = 0;
    std::size_t wide = 7;
    for (const DutyPart& part : duty.parts) time += part.share_of_time, wide = std::max(wide, columns_of(part.job));
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", duty.name);
    text += indented_lines(duty_action(duty)) + indented_lines(percentile_words(duty));
    const std::string of = duty.past_hours > 0 ? "new: " : "";  // the action states the remaining life
    const std::string without = of + "p10 without it [h]", as_twice = of + "p10 if twice as often [h]";
    text += fmt::format("  {:<{}}  {:>14}  {:>8}  {:>8}  {}  {}\n", "program", wide, "repeats per h", "time", "damage",
                        without, as_twice);
    for (std::size_t k = 0; k < duty.parts.size(); ++k)
      text += fmt::format("  {:<{}}  {:>14}  {:>6.1f} %  {:>6.1f} %  {:>{}}  {:>{}}\n", duty.parts[k].job, wide,
                          readable(duty.parts[k].repeats_per_hour), 100 * duty.parts[k].share_of_time,
                          100 * duty.lives.share[k], without_text(duty, duty.parts[k]), columns_of(without),
                          as_twice_text(duty, duty.parts[k]), columns_of(as_twice));
    if (duty.past_hours > 0) text += "  new: of a new dresspack, which has no history.\n";
    text += fmt::format("  The robot stands still in {:.1f} % of the time.\n", std::max(0.0, 100 * (1 - time)));
    text += caution_words(duty);
    text += mixture_words(duty);
  }
  return text;
}

CsvTable duty_table(const std::vector<DutyResult>& results) {
  CsvTable table{{{"duty", true}, {"job", true}}};
  for (const char* title :
       {"repeats_per_hour", "share_of_time", "share_of_damage", "life_hours_p10", "life_hours_p50", "life_hours_p90",
        "past_hours", "survived", "remaining_hours_p10", "remaining_hours_p50", "remaining_hours_p90",
        "life_hours_p10_without", "life_hours_p10_twice", "life_error_p10", "life_error_p50", "life_error_p90"})
    table.columns.push_back({title});
  for (const DutyResult& duty : results)
    for (std::size_t k = 0; k < duty.parts.size(); ++k) {
      const DutyLives& lives = duty.lives;
      const bool remains = duty.past_hours > 0;
      std::vector<std::string>& cells = table.rows.emplace_back(std::vector{duty.name, duty.parts[k].job});
      for (const double value :
           {duty.parts[k].repeats_per_hour, duty.parts[k].share_of_time, lives.share[k], lives.percentiles[0],
            lives.percentiles[1], lives.percentiles[2], duty.past_hours, lives.survived})
        cells.push_back(shortest_text(value));
      for (const double value : lives.remaining) cells.push_back(remains ? shortest_text(value) : "");
      for (const double value : {duty.parts[k].without[0], duty.parts[k].as_twice[0]})
        cells.push_back(std::isnan(value) ? "" : shortest_text(value));
      for (const double factor : duty.errors) cells.push_back(std::isfinite(factor) ? shortest_text(factor) : "");
    }
  return table;
}

}  // namespace dresslife::pipeline
