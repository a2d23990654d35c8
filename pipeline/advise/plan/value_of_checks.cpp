#include "pipeline/advise/plan/value_of_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/statistics.h"
#include "pipeline/life/visual_checks.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t values_of_z = 1000;  // of equal probability: the resolution of a share is 0.001
constexpr double fewest_plants = 1e-3;

double log10_spread(const AbrasionLife& life) { return std::log10(life.median / life.early) / -normal_quantile(0.1); }

/// Failures by abrasion of one dresspack and its successors for the life T at one z, without failures of wires. planned: hours
/// until the planned replacement; end: hours until the end of the plan.
struct Failures {
  double first_found = 0;  ///< 0: the first one does not fail before its replacement
  bool first_fails = false;
  double others = 0, others_found = 0;
};

Failures failures_of(double life, double age, std::optional<double> planned, double end, double visible_from,
                     double interval, double found_share) {
  const auto found = [&](double visible) { return interval > 0 ? found_before(visible, interval, found_share) : 0; };
  Failures failures;
  const double until = planned.value_or(end), left = life - age;
  failures.first_fails = left < until;
  if (failures.first_fails) failures.first_found = found(std::min((1 - visible_from) * life, left));
  const double begun = failures.first_fails ? left : until;  // begin of the next dresspack
  failures.others = std::floor((end - begun) / life);
  failures.others_found = failures.others * found((1 - visible_from) * life);
  return failures;
}

}  // namespace

double wires_live(const RowPlan& row, double hours, double hours_per_week) {
  double lives = 1;
  const auto weeks = static_cast<std::size_t>(hours / hours_per_week);
  for (std::size_t week = 0; week < std::min(weeks, row.fails_in_week.size()); ++week) lives -= row.fails_in_week[week];
  return std::max(lives, 0.0);
}

std::optional<std::vector<CheckValue>> values_of_checks(const Fleet& fleet,
                                                        const std::map<std::string, LifeTable>& tables,
                                                        const std::map<std::string, AbrasionLife>& lives,
                                                        const Plan& plan) {
  const std::vector<double> times = times_of(plan.windows, plan.today);
  const auto life_of = [&](const Installed& row) -> const AbrasionLife* {
    const auto found = lives.find(row.duty);
    return found == lives.end() || !std::isfinite(found->second.median) ? nullptr : &found->second;
  };
  std::vector<double> ages;  // (row) under its present duty, for the same wear
  for (std::size_t i = 0; i < fleet.rows.size(); ++i)
    ages.push_back(worn_hours(fleet.rows[i], plan.rows[i].age_hours, [&](const std::string& duty) {
      const auto found = lives.find(duty);
      return found == lives.end() ? std::numeric_limits<double>::infinity() : found->second.median;
    }));
  double survived = 0;  // share of z below the value at which all dresspacks live today
  for (std::size_t i = 0; i < fleet.rows.size(); ++i)
    if (const AbrasionLife* const life = life_of(fleet.rows[i]); life && ages[i] > 0)
      survived = std::max(survived, normal_share(std::log10(ages[i] / life->median) / log10_spread(*life)));
  if (1 - survived < fewest_plants) return std::nullopt;
  std::vector<double> z;
  for (std::size_t k = 0; k < values_of_z; ++k)
    z.push_back(normal_quantile(survived + (1 - survived) * (double(k) + 0.5) / double(values_of_z)));
  std::vector<CheckValue> values;
  for (std::size_t i = 0; i < fleet.rows.size(); ++i) {
    CheckValue& value = values.emplace_back();
    const Installed& row = fleet.rows[i];
    const AbrasionLife* const abrasion = life_of(row);
    if (!abrasion) continue;
    const RowPlan& planned = plan.rows[i];
    const double week = row.hours_per_week.value_or(tables.at(row.duty).hours_per_week), age = ages[i];
    const double end = times.back() / 7 * week, spread = log10_spread(*abrasion),
                 saves = row.unplanned_cost - row.planned_cost;
    std::optional<double> replaced;
    if (planned.window) replaced = times[*planned.window] / 7 * week;
    const double found = abrasion->inspection.found_percent / 100, wasted = replaced ? 0 : row.planned_cost;
    for (const double of_plant : z) {
      const double life = abrasion->median * std::pow(10, spread * of_plant);
      const double alive = wires_live(planned, life - age, week);
      const Failures failures = failures_of(life, age, replaced, end, abrasion->visible_from,
                                            abrasion->inspection.interval_weeks * week, found);
      if (age >= abrasion->visible_from * life) value.today += failures.first_fails ? saves * alive : -wasted;
      value.fails += alive * failures.first_fails + failures.others;
      value.found += alive * failures.first_found + failures.others_found;
    }
    value.today = found * std::max(0.0, value.today) / values_of_z;
    value.fails /= values_of_z, value.found /= values_of_z;
    value.regular = saves * value.found;
  }
  return values;
}

}  // namespace dresslife::pipeline
