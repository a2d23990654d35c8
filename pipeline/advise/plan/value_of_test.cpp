#include "pipeline/advise/plan/value_of_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/threads.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/life/first_failure.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index bins = 16;  // of the result: half of the bins are narrower than a fifth of its deviation

/// Returns P(j | w), (world, bin). The bins have equal probabilities if z is normal over the weighted worlds.
MatrixXd results_of(const std::vector<double>& z, double error, const std::vector<double>& weights) {
  double mean = 0, variance = 0;
  for (std::size_t w = 0; w < z.size(); ++w) mean += weights[w] * z[w];
  for (std::size_t w = 0; w < z.size(); ++w) variance += weights[w] * (z[w] - mean) * (z[w] - mean);
  const double deviation = std::sqrt(variance + error * error);
  MatrixXd share(static_cast<Index>(z.size()), bins);
  for (Index w = 0; w < share.rows(); ++w) {
    double below = 0;
    for (Index j = 0; j < bins; ++j) {
      const double edge = j + 1 < bins ? mean + deviation * normal_quantile(double(j + 1) / double(bins)) : infinity;
      const double until = normal_share((edge - z[std::size_t(w)]) / error);
      share(w, j) = until - below;
      below = until;
    }
  }
  return share;
}

/// (D7) for one dresspack: the part that does not depend on A, and the hours that are multiplied by g_w(A).
struct Costs {
  MatrixXd fixed, hours;  ///< (time, world)
  VectorXd weights;       ///< (world) weights of the worlds in which it can live; their sum is 1
};

Costs costs_of(const Installed& row, const LifeTable& table, double age, double hours_per_day,
               const std::vector<double>& times, const std::vector<double>& world_weights, const VectorXd& best) {
  std::vector<double> until;  // [h]
  for (std::size_t k = 0; k + 1 < times.size(); ++k) until.push_back(times[k] * hours_per_day);
  constexpr double growth = 1.5;  // ratio of successive later times, as in (D5)
  const double end = times.back() * hours_per_day, interval = end - until.back(), last = until.back();
  for (double hours = interval; hours < growth * std::max(interval, table.horizon()); hours *= growth)
    until.push_back(last + hours);
  const auto count = static_cast<Index>(until.size()), worlds = static_cast<Index>(table.worlds);
  Costs costs{MatrixXd::Zero(count, worlds), MatrixXd::Zero(count, worlds), VectorXd::Zero(worlds)};
  for (Index w = 0; w < worlds; ++w) {
    const auto world = static_cast<std::size_t>(w);
    const double lives = table.alive(world, age);
    if (!(lives > 0)) continue;
    costs.weights[w] = world_weights[world];
    const double begun = table.running(world, 0, age), ended = table.running(world, 0, age + end);
    // Times and lives are rising, so one pass through both is enough.
    const float *life = table.hours.data() + world * table.draws, *const last_life = life + table.draws;
    double lived = 0;  // [h] sum of the lives until this time
    for (Index t = 0; t < count; ++t) {
      const double at = age + until[std::size_t(t)];
      for (; life != last_life && *life <= at; ++life) lived += *life;
      const double running =
          (lived + double(last_life - life) * at) / double(table.draws);  // integral from 0 to this time
      const double left = end - (std::min(running, ended) - begun) / lives,
                   beyond = std::max(0.0, running - ended) / lives;
      costs.fixed(t, w) = row.planned_cost +
                          (row.unplanned_cost - row.planned_cost) * (1 - table.alive(world, at) / lives) -
                          best[w] * beyond;
      costs.hours(t, w) = left;
    }
  }
  if (const double sum = costs.weights.sum(); sum > 0) costs.weights /= sum;
  return costs;
}

/// Computes the values of several tests together.
class Values {
 public:
  Values(const Fleet& fleet, const std::map<std::string, LifeTable>& tables, const Plan& plan)
      : fleet_(fleet), tables_(tables), plan_(plan) {}

  /// Returns the values, (test). results: (test) results_of().
  std::vector<double> of(const std::vector<MatrixXd>& results) const {
    const std::vector<double> times = times_of(plan_.windows, plan_.today);
    const std::vector<std::vector<std::size_t>> alike = rows_of_policies(fleet_);
    std::vector<std::vector<double>> of_row(fleet_.rows.size());  // (row, test)
    const std::size_t threads = std::min(thread_count(), alike.size());
    in_parallel(threads, [&](std::size_t part) {
      for (std::size_t k = part; k < alike.size(); k += threads) {
        const Installed& row = fleet_.rows[alike[k].front()];
        const Policies policies = policies_of(row, tables_.at(row.duty), results);
        for (const std::size_t i : alike[k]) of_row[i] = of(i, policies, times, results);
      }
    });
    std::vector<double> saves(results.size(), 0.0);
    for (const std::vector<double>& one : of_row)
      for (std::size_t k = 0; k < saves.size(); ++k) saves[k] += one[k];
    return saves;
  }

 private:
  struct Policies {
    VectorXd now;                 ///< (world) g_w at the age with the least mean now
    VectorXd best;                ///< (world) g_w at the best age of this world
    std::vector<MatrixXd> after;  ///< (test) (world, bin) g_w at the age with the least mean after the result
  };
  /// Returns the values for one dresspack, (test).
  std::vector<double> of(std::size_t i, const Policies& policies, const std::vector<double>& times,
                         const std::vector<MatrixXd>& results) const {
    const Installed& row = fleet_.rows[i];
    const double hours_per_day = row.hours_per_week.value_or(tables_.at(row.duty).hours_per_week) / 7;
    const Costs costs = costs_of(row, *plan_.rows[i].lives, plan_.rows[i].age_hours, hours_per_day, times,
                                 plan_.weights, policies.best);
    const VectorXd& now = policies.now;
    const double before = (costs.fixed * costs.weights + costs.hours * now.cwiseProduct(costs.weights)).minCoeff();
    return mapped(indices_of(results.size()), [&](std::size_t k) {
      const MatrixXd weights = costs.weights.asDiagonal() * results[k];
      const MatrixXd fixed = costs.fixed * weights;
      const MatrixXd same = fixed + costs.hours * (now.asDiagonal() * weights);
      const MatrixXd other = fixed + costs.hours * policies.after[k].cwiseProduct(weights);
      double after = 0;
      for (Index j = 0; j < bins; ++j) after += std::min(same.col(j).minCoeff(), other.col(j).minCoeff());
      return before - after;
    });
  }
  Policies policies_of(const Installed& row, const LifeTable& table, const std::vector<MatrixXd>& results) const {
    Policies policies;
    const AgeRates rates = age_rates(table, row.planned_cost, row.unplanned_cost);
    const VectorXd weights = VectorXd::Map(plan_.weights.data(), static_cast<Index>(plan_.weights.size()));
    policies.now = rates.least(weights);
    policies.best = rates.rate.colwise().minCoeff().transpose();
    MatrixXd all(weights.size(), static_cast<Index>(results.size()) * bins);
    for (std::size_t k = 0; k < results.size(); ++k)
      all.middleCols(static_cast<Index>(k) * bins, bins) = weights.asDiagonal() * results[k];
    // Minimum of a mean over the ages, as in least(): first every 4th age, then the ages near the minimum. The mean over many
    // worlds has no narrower minimum.
    constexpr Index stride = 4;
    const MatrixXd some = rates.rate(Eigen::seq(0, Eigen::last, stride), Eigen::all),
                   mean = some * all;  // (age, result and bin)
    for (std::size_t k = 0; k < results.size(); ++k) {
      MatrixXd& after = policies.after.emplace_back(weights.size(), bins);
      for (Index j = 0; j < bins; ++j) {
        const Index column = static_cast<Index>(k) * bins + j;
        Index best = 0;
        mean.col(column).minCoeff(&best);
        const Index first = std::max<Index>(0, (best - 1) * stride),
                    end = std::min(rates.rate.rows(), (best + 1) * stride + 1);
        (rates.rate.middleRows(first, end - first) * all.col(column)).minCoeff(&best);
        after.col(j) = rates.rate.row(first + best).transpose();
      }
    }
    return policies;
  }

  const Fleet& fleet_;
  const std::map<std::string, LifeTable>& tables_;
  const Plan& plan_;
};

}  // namespace

double value_of_test(const SharedValue& what, double error, const Fleet& fleet,
                     const std::map<std::string, LifeTable>& tables, const Plan& plan) {
  return Values(fleet, tables, plan).of({results_of(what.z, error, plan.weights)}).front();
}

std::vector<TestValue> values_of_tests(const Fleet& fleet, const std::map<std::string, LifeTable>& tables,
                                       const Plan& plan) {
  std::vector<TestValue> values;
  std::vector<MatrixXd> results;
  for (const auto& [name, table] : tables)
    for (const SharedValue& shared : table.shared) {
      if (std::ranges::any_of(values, [&](const TestValue& known) {
            return known.what.parameter == shared.parameter && known.what.of == shared.of;
          }))
        continue;
      const UncertainParameter& parameter = uncertain_parameters()[shared.parameter];
      values.push_back({shared});
      results.push_back(results_of(shared.z, parameter.test_deviation / parameter.deviation(), plan.weights));
    }
  const std::vector<double> saves = Values(fleet, tables, plan).of(results);
  for (std::size_t k = 0; k < values.size(); ++k) values[k].saves = saves[k];
  // In a random order only chance is left. Only for tests with a value, because each order takes as long as a test.
  constexpr std::size_t orders = 8;
  std::vector<std::size_t> of;
  std::vector<MatrixXd> by_chance;
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::size_t order = 0; order < orders && saves[k] > least_saving * plan.cost; ++order) {
      const SharedValue& what = values[k].what;
      const UncertainParameter& parameter = uncertain_parameters()[what.parameter];
      of.push_back(k);
      by_chance.push_back(
          results_of(in_order_of(fmt::format("{} of {}, order {}", parameter.name, what.of, order), what.z),
                     parameter.test_deviation / parameter.deviation(), plan.weights));
    }
  const std::vector<double> chances = Values(fleet, tables, plan).of(by_chance);
  for (std::size_t first = 0; first < of.size(); first += orders) {
    double mean = 0, variance = 0;
    for (std::size_t k = first; k < first + orders; ++k) mean += chances[k] / orders;
    for (std::size_t k = first; k < first + orders; ++k)
      variance += (chances[k] - mean) * (chances[k] - mean) / (orders - 1);
    values[of[first]].by_chance = mean + 3 * std::sqrt(variance);
  }
  std::ranges::stable_sort(values, [](const TestValue& a, const TestValue& b) { return a.saves > b.saves; });
  return values;
}

}  // namespace dresslife::pipeline
