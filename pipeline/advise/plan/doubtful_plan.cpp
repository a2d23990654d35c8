#include "pipeline/advise/plan/doubtful_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/job/job.h"
#include "pipeline/life/likely_age.h"
#include "pipeline/life/planning.h"

namespace dresslife::pipeline {
namespace {

constexpr double least_percent = 1;  // of the time: 48 minutes of a week of 80 hours
// sum of the percent of repeats of all programs, if shares were written instead of per cent
constexpr double shares_at_most = 1.5;
constexpr double least_shift = 2, most_shift = 24;  // [h]
constexpr double longest_history = 175'000;         // [h]: 20 years day and night
constexpr double most_times_cost = 100;             // between the largest and the smallest cost of one kind
constexpr double rounded_percent = 1.5;             // rounding error of three programs of 33 % each

class Doubts {
 public:
  void of(const Duty& duty) {
    double repeats = 0;
    bool per_shift = false, by_repeats = false;
    for (const DutyProgram& program : duty.programs) {
      of(program);
      repeats += program.percent_of_repeats.value_or(0);
      per_shift = per_shift || program.repeats_per_shift;
      by_repeats = by_repeats || program.percent_of_repeats;
    }
    if (by_repeats && repeats <= shares_at_most)
      add(duty.where,
          fmt::format("percent_of_repeats of duty '{}' add up to {:g} % (limit more than {:g})", duty.name, repeats,
                      shares_at_most),
          "shares instead of percentages",
          fmt::format("percent_of_repeats: {:g} instead of {:g}, and so on",
                      100 * duty.programs.front().percent_of_repeats.value_or(0.5),
                      duty.programs.front().percent_of_repeats.value_or(0.5)));
    else if (by_repeats && repeats < 100 - rounded_percent)
      add(duty.where, fmt::format("percent_of_repeats of duty '{}' add up to {:g} % (limit 100)", duty.name, repeats),
          "a program that is missing; the other repeats do no damage", "percent_of_repeats of all programs");
    if (duty.repeats_per_hour && !by_repeats)
      add(duty.where,
          fmt::format("repeats_per_hour of duty '{}' is {:g} and has no effect: no program has percent_of_repeats",
                      duty.name, *duty.repeats_per_hour),
          "a number that belongs to a program",
          fmt::format("repeats_per_hour: {:g} in an entry of programs", *duty.repeats_per_hour));
    const std::string name = fmt::format(" of duty '{}'", duty.name);
    add.week(duty.where, "hours_per_week", name, duty.hours_per_week);
    if (per_shift)
      add.number(duty.where, "shift_hours", name, duty.shift_hours, {least_shift, most_shift}, {},
                 {duty.shift_hours > most_shift ? "hours of a week" : "a share of a day", "shift_hours: 8"});
    for (const PastDuty& past : duty.history)
      if (past.hours.value_or(0) > longest_history)
        add(past.where,
            fmt::format("hours of the history are {:g} (limit {:g}: 20 years day and night)", *past.hours,
                        longest_history),
            past.from.empty() ? "minutes or seconds instead of hours" : "a wrong year",
            past.from.empty() ? fmt::format("hours: {:.6g} if that was minutes", *past.hours / 60)
                              : "from: the year as it was");
  }
  void of(const Fleet& fleet, Day today) {
    std::map<std::string, const Installed*> names;
    const Installed *new_today = nullptr, *thousands = nullptr, *short_week = nullptr;
    int new_ones = 0, of_thousands = 0, short_weeks = 0;
    const auto [low_planned, high_planned] = std::ranges::minmax_element(fleet.rows, {}, &Installed::planned_cost);
    for (const Installed& row : fleet.rows) {
      if (row.hours_per_week && *row.hours_per_week <= WarningsOfKind::hours_of_day && short_weeks++ == 0)
        short_week = &row;
      if (today - row.since > oldest_likely)
        add(row.where,
            fmt::format("'{}' was installed {} days ago (limit {}: 20 years)", row.name, (today - row.since).count(),
                        oldest_likely.count()),
            "the date of the robot, or a wrong year", "installed: the date of the dresspack");
      const auto [same, is_new] = names.try_emplace(plain(row.name), &row);
      if (!is_new)
        add(row.where,
            fmt::format("'{}' and '{}' differ only in blanks, signs or capitals", row.name, same->second->name),
            "one dresspack in two rows", "one of the two rows, or names that differ more");
      if (fleet.has_costs && row.planned_cost == 0)
        add(row.where, fmt::format("planned_cost of '{}' is 0 (limit more than 0)", row.name),
            "a cost that is not known", "planned_cost with parts, labour and standstill");
      if (fleet.has_costs && row.planned_cost > 0 && row.unplanned_cost > most_times_cost * row.planned_cost &&
          of_thousands++ == 0)
        thousands = &row;
      if (row.undated && new_ones++ == 0) new_today = &row;
    }
    const auto more = [](int count) { return count > 1 ? fmt::format(" (and {} more)", count - 1) : std::string(); };
    if (short_week)
      add.week(short_week->where, "hours_per_week", fmt::format(" of '{}'{}", short_week->name, more(short_weeks)),
               *short_week->hours_per_week);
    if (thousands)
      add(thousands->where,
          fmt::format("unplanned_cost of '{}' is {:.4g} times its planned_cost (limit {:g}){}", thousands->name,
                      thousands->unplanned_cost / thousands->planned_cost, most_times_cost, more(of_thousands)),
          "thousands in one of the two columns",
          fmt::format("planned_cost: {:.0f} if that was thousands", 1e3 * thousands->planned_cost));
    if (new_today)
      add(new_today->where, fmt::format("'{}' counts as installed today{}", new_today->name, more(new_ones)),
          "an empty cell of the column 'installed'", "the date on which it was installed; leave it if it is new");
    if (fleet.has_costs && low_planned->planned_cost > 0 &&
        high_planned->planned_cost > most_times_cost * low_planned->planned_cost)
      add(low_planned->where,
          fmt::format("planned_cost of '{}' is {:g}, and of '{}' {:g} (limit {:g} times)", low_planned->name,
                      low_planned->planned_cost, high_planned->name, high_planned->planned_cost, most_times_cost),
          "different units", fmt::format("planned_cost: {:g} if that was thousands", 1e3 * low_planned->planned_cost));
  }

  std::vector<Warning> warnings;

 private:
  const WarningsOfKind add{warnings, WarningKind::motion};

  void of(const DutyProgram& program) {
    const auto share = [&](const char* key, double value) {
      if (value > 0)
        add.number(program.where, key, fmt::format(" of '{}'", program.job), value, {least_percent},
                   {{100, "a share instead of a percentage", "a share"}});
    };
    share("percent_of_time", program.percent_of_time.value_or(0));
    share("deviation_percent", program.deviation_percent);
    const double number = program.repeats_per_hour    ? *program.repeats_per_hour
                          : program.repeats_per_shift ? *program.repeats_per_shift
                          : program.percent_of_time   ? *program.percent_of_time
                                                      : program.percent_of_repeats.value_or(1);
    if (number == 0)
      add(program.where, fmt::format("'{}' never runs in its duty: its number of repeats is 0", program.job),
          "a number that is not known", "the number of repeats, or no entry of this program");
  }
  /// Returns the letters in lower case and the digits of a name.
  static std::string plain(const std::string& name) {
    std::string letters;
    for (const unsigned char letter : name)
      if (std::isalnum(letter) || letter > 127) letters += static_cast<char>(std::tolower(letter));
    return letters;
  }
};

}  // namespace

std::vector<Warning> doubtful_duties(const DutyFile& file) {
  Doubts doubts;
  for (const Duty& duty : file.duties) doubts.of(duty);
  return doubts.warnings;
}

std::vector<Warning> doubtful_fleet(const Fleet& fleet, Day today) {
  Doubts doubts;
  doubts.of(fleet, today);
  return doubts.warnings;
}

std::vector<Warning> doubtful_hours(const Fleet& fleet, const Plan& plan,
                                    const std::map<std::string, LifeTable>& tables) {
  std::optional<AgeDoubt> first;
  const Installed* of = nullptr;
  std::size_t more = 0;
  for (std::size_t i = 0; i < fleet.rows.size(); ++i) {
    const Installed& row = fleet.rows[i];
    if (plan.today - row.since > oldest_likely) continue;  // of doubtful_fleet()
    const double robot_life = tables.at(row.duty).robot_life_hours;
    if (!(robot_life > 0)) continue;  // a test rig
    const auto doubt = doubt_about_age(row.name, row.since, plan.today, plan.rows[i].age_hours, robot_life, false);
    if (!doubt) continue;
    if (!first)
      first = doubt, of = &row;
    else
      ++more;
  }
  if (!first) return {};
  return {warning_of(WarningKind::motion, of->where.text(),
                     first->problem + (more > 0 ? fmt::format(" (and {} more)", more) : ""), first->cause,
                     first->remedy)};
}

std::vector<Warning> doubtful_ages(const Fleet& fleet, const Plan& plan) {
  if (plan.reach_their_age >= usual_reach) {
    // The oldest of many dresspacks is older than most new ones become, so P(one of so many reaches its age) is compared.
    const auto oldest = std::ranges::min_element(plan.rows, {}, &RowPlan::reach_its_age);
    const double limit = 1 - std::pow(1 - usual_reach, 1 / double(plan.rows.size()));
    if (oldest->reach_its_age >= limit) return {};
    const Installed& row = fleet.rows[static_cast<std::size_t>(oldest - plan.rows.begin())];
    return {warning_of(
        WarningKind::motion, row.where.text(),
        fmt::format(
            "'{}' has run {}, which by the model {} of new dresspacks reach (limit {}, with which one of {} is so old with a probability of {})",
            row.name, hours_text(oldest->age_hours), percent_text(oldest->reach_its_age), percent_text(limit),
            plan.rows.size(), percent_text(usual_reach)),
        "a wrong date or year, a replacement that is not in the table, or a duty or hours per week that are not its own",
        "the date on which the dresspack of today was installed")};
  }
  return {warning_of(
      WarningKind::motion, fleet.rows.front().where.file,
      fmt::format("by the model {} of new dresspacks reach the ages of these {} (limit {})",
                  percent_text(plan.reach_their_age), fleet.rows.size(), percent_text(usual_reach)),
      "a job or hours per week that are not theirs, or a calibration with records that begin after most of their life",
      "dresslife calibrate with an earlier day (--records-since), from which the table has every removal")};
}

std::vector<Warning> doubtful_evidence(const Study& study, const std::string& fleet) {
  for (const StudyJob& one : study.jobs) {
    if (!one.job || !one.job.with(Piece::rest).calibration) continue;
    for (const LearnedFrom& from : one.job.with(Piece::rest).calibration->observations)
      if (from.observed.starts_with("at least ") && from.observed.ends_with(" h"))  // observed_text() of run_out
        return {warning_of(
            WarningKind::calibration, fleet,
            fmt::format(
                "the calibration contains '{}' with {}, and the plan counts the hours of each dresspack in this table",
                from.observation, from.observed),
            "a run_out row of a dresspack that is in this table, too: then its hours count twice",
            "calibrate without this row, or with the table of the maintenance system instead of it")};
  }
  return {};
}

}  // namespace dresslife::pipeline
