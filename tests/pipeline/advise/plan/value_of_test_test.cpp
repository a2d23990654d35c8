// The value of a test against costs calculated by hand, and its bounds.
#include "pipeline/advise/plan/value_of_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/advise/plan/plan_words.h"
#include "pipeline/base/statistics.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double week = 70;  // [h of operation]: 10 per day
const Day start = *day_from("2026-11-23");

std::vector<Window> windows_in(const std::vector<int>& weeks) {
  std::vector<Window> windows;
  for (const int of : weeks) windows.push_back({start + std::chrono::days(7 * of), start + std::chrono::days(7 * of)});
  return windows;
}

Fleet new_dresspacks(std::size_t count, double planned, double unplanned) {
  Fleet fleet;
  for (std::size_t i = 0; i < count; ++i)
    fleet.rows.push_back({{}, "r" + std::to_string(i), "d", start, {}, planned, unplanned});
  fleet.has_costs = true;
  return fleet;
}

}  // namespace

TEST_CASE("a perfect test of two equally likely worlds saves what each costs less by itself") {
  // In one world every dresspack fails at 2,000 h, in the other none ever fails.
  constexpr double life = 2000, robot = 40000, planned = 1, unplanned = 10;
  const float endless = std::numeric_limits<float>::infinity();
  const std::map<std::string, LifeTable> tables{
      {"d", LifeTable{2, 1, {static_cast<float>(life), endless}, robot, week}}};
  const Fleet fleet = new_dresspacks(3, planned, unplanned);
  const Plan plan = plan_of(fleet, tables, windows_in({10, 20}), start, {0.1, true});
  constexpr double last = 1400, end = 2100;  // [h]: the windows are at 700 and 1,400
  // Before the test: replaced at the last window before 2,000 h, later always just before this age, because of the first world.
  const double before = planned + planned / life * (end - last);
  // After the test: the same in the first world. In the second it is replaced as late as possible: the latest time is 700 h times
  // 1.5^10 after the window. The hours beyond the plan are worth the cost of one dresspack per robot's life.
  const double latest = last + 700 * std::pow(1.5, 10), never = planned - planned / robot * (latest - end);
  const double expected = 3 * (before - (before + never) / 2);
  // Ages of (D6) are 2 % apart: 2 % of the 0.35 that successors cost.
  CHECK(value_of_test({0, "", {-1, 1}}, 1e-6, fleet, tables, plan) == Approx(expected).margin(3 * 0.02 * 0.35));
  CHECK(value_of_test({0, "", {4, 4.5}}, 1e-6, fleet, tables, plan) ==
        Approx(value_of_test({0, "", {-1, 1}}, 1e-6, fleet, tables, plan)).epsilon(1e-12));  // a calibrated one
  // A test without information saves nothing. A better test never saves less.
  CHECK(value_of_test({0, "", {-1, 1}}, 1e6, fleet, tables, plan) == Approx(0).margin(1e-4));
  constexpr double rounding = 1e-12;  // of sums of about ten terms
  double least = 0;
  for (const double error : {1e6, 4.0, 1.0, 0.5, 0.25, 1e-6}) {
    const double saves = value_of_test({0, "", {-1, 1}}, error, fleet, tables, plan);
    CHECK(saves > least - rounding);
    least = saves;
  }
  const std::string words = test_words(
      {{{index_of(Uncertain::friction_inside), "hose", {}}, 1234}, {{index_of(Uncertain::model), "", {}}, 1e-4}}, plan);
  CHECK(words.find("1,230  One bending test of a cable (one hour): friction_inside of 'hose'\n") != std::string::npos);
  CHECK(words.find("model") == std::string::npos);  // less than a thousandth of the plan's cost
  CHECK(test_words({}, plan).find("No test") != std::string::npos);
  // A parameter that is equal in both worlds.
  CHECK(value_of_test({0, "", {0.3, 0.3}}, 0.1, fleet, tables, plan) == Approx(0).margin(rounding));
}

namespace {

/// Returns the value (D7) of a test for one dresspack, from each life by itself and a search through all ages.
double searched(const Installed& row, const LifeTable& table, double age, double hours_per_day,
                const std::vector<double>& times, const std::vector<double>& weights, const std::vector<double>& z,
                double error) {
  const std::size_t worlds = weights.size();
  const AgeRates rates = age_rates(table, row.planned_cost, row.unplanned_cost);
  const auto ages = static_cast<std::size_t>(rates.rate.rows());
  const auto rate = [&](std::size_t a, std::size_t w) {
    return rates.rate(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(w));
  };
  const auto best_age = [&](const std::vector<double>& of_world) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < ages; ++a) {
      double mean = 0;
      for (std::size_t w = 0; w < worlds; ++w) mean += of_world[w] * rate(a, w);
      if (mean < least) least = mean, best = a;
    }
    return best;
  };
  const double end = times.back() * hours_per_day, last = times[times.size() - 2] * hours_per_day;
  std::vector<double> until;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) until.push_back(times[k] * hours_per_day);
  for (double hours = end - last; hours < 1.5 * table.robot_life_hours; hours *= 1.5) until.push_back(last + hours);
  const auto mean_cost = [&](std::size_t w, double at, std::size_t a) {
    double least = std::numeric_limits<double>::infinity(), sum = 0;
    for (std::size_t of = 0; of < ages; ++of) least = std::min(least, rate(of, w));
    std::size_t count = 0;
    for (std::size_t d = 0; d < table.draws; ++d) {
      const double left = table.life(w, d) - age;
      if (!(left > 0)) continue;
      const double runs = std::min(left, at);
      sum += (left <= at ? row.unplanned_cost : row.planned_cost) + rate(a, w) * (end - std::min(runs, end)) -
             least * std::max(0.0, runs - end);
      ++count;
    }
    return sum / double(count);
  };
  double mean = 0, variance = 0;
  for (std::size_t w = 0; w < worlds; ++w) mean += weights[w] * z[w];
  for (std::size_t w = 0; w < worlds; ++w) variance += weights[w] * std::pow(z[w] - mean, 2);
  const double deviation = std::sqrt(variance + error * error);
  const auto least_of = [&](const std::vector<double>& share, std::initializer_list<std::size_t> policies) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t a : policies)
      for (const double at : until) {
        double cost = 0;
        for (std::size_t w = 0; w < worlds; ++w) cost += share[w] * mean_cost(w, at, a);
        least = std::min(least, cost);
      }
    return least;
  };
  const std::size_t now = best_age(weights);
  double after = 0;
  constexpr int bins = 16;
  for (int j = 0; j < bins; ++j) {
    std::vector<double> share;
    for (std::size_t w = 0; w < worlds; ++w) {
      const auto below = [&](int edge) {
        return edge == 0      ? 0
               : edge == bins ? 1
                              : normal_share((mean + deviation * normal_quantile(double(edge) / bins) - z[w]) / error);
      };
      share.push_back(weights[w] * (below(j + 1) - below(j)));
    }
    after += least_of(share, {now, best_age(share)});
  }
  return least_of(weights, {now}) - after;
}

}  // namespace

TEST_CASE("tests of a plant of unlike dresspacks are worth what a search through all lives and ages finds for each") {
  // Quantiles of Weibull lives: their mean cost has one minimum over the ages, which no coarse search passes over.
  const auto table = [&](double shape, const std::vector<double>& scales) {
    constexpr std::size_t draws = 300;
    LifeTable lives{scales.size(), draws, {}, 20000, week};
    for (const double scale : scales)
      for (std::size_t d = 0; d < draws; ++d)
        lives.hours.push_back(
            static_cast<float>(scale * std::pow(-std::log1p(-(double(d) + 0.5) / double(draws)), 1 / shape)));
    return lives;
  };
  std::map<std::string, LifeTable> tables{{"a", table(4, {2000, 3000, 5000, 9000})},
                                          {"b", table(6, {6000, 2500, 4000, 1500})}};
  tables.at("b").hours_per_week = 110;
  tables.at("a").shared = {{index_of(Uncertain::friction_inside), "hose", {-1.2, -0.3, 0.4, 1.5}}};
  tables.at("b").shared = {{index_of(Uncertain::friction_inside), "hose", {-1.2, -0.3, 0.4, 1.5}},
                           {index_of(Uncertain::strength), "copper", {0.9, -0.8, 0.2, -1.1}}};
  Fleet fleet = new_dresspacks(3, 1, 8);
  fleet.rows[1].duty = "b", fleet.rows[1].since = start - std::chrono::days(70), fleet.rows[1].planned_cost = 2,
  fleet.rows[1].unplanned_cost = 30;
  fleet.rows[2].duty = "b", fleet.rows[2].hours_per_week = 40, fleet.rows[2].since = start - std::chrono::days(150);
  fleet.rows[0].duty = "a";
  PlanRule rule{0.1, true};
  rule.weights = {0.1, 0.4, 0.2, 0.3};
  const Plan plan = plan_of(fleet, tables, windows_in({6, 11, 20}), start, rule);
  const std::vector<double> times = times_of(plan.windows, plan.today);
  const std::vector<TestValue> values = values_of_tests(fleet, tables, plan);
  REQUIRE(values.size() == 2);
  CHECK(values[0].saves > values[1].saves);
  for (const TestValue& of : values) {
    const UncertainParameter& parameter = uncertain_parameters()[of.what.parameter];
    const double error = parameter.test_deviation / parameter.deviation();
    double sum = 0;
    for (std::size_t i = 0; i < fleet.rows.size(); ++i) {
      const Installed& row = fleet.rows[i];
      const LifeTable& lives = tables.at(row.duty);
      sum += searched(row, lives, plan.rows[i].age_hours, row.hours_per_week.value_or(lives.hours_per_week) / 7, times,
                      rule.weights, of.what.z, error);
    }
    CHECK(sum > 0.01);
    constexpr double single = 1e-5;  // relative: lives are in single precision
    CHECK(of.saves == Approx(sum).epsilon(single));
    CHECK(value_of_test(of.what, error, fleet, tables, plan) == Approx(of.saves).epsilon(1e-12));
  }
}

TEST_CASE("tests of parameters on which no life depends are worth no more than chance, and are not offered") {
  // Few worlds, in which the strength sets the life. The friction of each of many hoses has the same values in another order.
  constexpr std::size_t worlds = 60, draws = 100, hoses = 40;
  const std::vector<double> strength = standard_normals("strength", worlds);
  LifeTable table{worlds, draws, {}, 40000, week};
  for (std::size_t w = 0; w < worlds; ++w)
    for (std::size_t d = 0; d < draws; ++d)
      table.hours.push_back(static_cast<float>(3000 * std::exp(0.7 * strength[w]) *
                                               std::pow(-std::log1p(-(double(d) + 0.5) / double(draws)), 0.25)));
  table.shared = {{index_of(Uncertain::strength), "copper", strength}};
  for (std::size_t k = 0; k < hoses; ++k)
    table.shared.push_back({index_of(Uncertain::friction_hose), "hose " + std::to_string(k),
                            standard_normals("hose " + std::to_string(k), worlds)});
  const Fleet fleet = new_dresspacks(4, 1, 10);
  const std::map<std::string, LifeTable> tables{{"d", table}};
  const Plan plan = plan_of(fleet, tables, windows_in({10, 20, 30}), start, {0.1, true});
  const std::vector<TestValue> values = values_of_tests(fleet, tables, plan);
  REQUIRE(values.size() == 1 + hoses);
  CHECK(values[0].what.parameter == index_of(Uncertain::strength));
  CHECK(values[0].saves > 2 * values[0].by_chance);
  std::size_t worth = 0, offered = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (!(values[k].saves > 1e-3 * plan.cost)) continue;
    ++worth;  // by itself it would be offered
    offered += values[k].saves > values[k].by_chance;
  }
  CHECK(worth > hoses / 2);
  CHECK(offered <= hoses / 20);  // three deviations of a skewed distribution: a few per cent
  const std::string words = test_words({values[0], {values[1].what, 1, 1.1}}, plan);
  CHECK(words.find("strength of 'copper'") != std::string::npos);
  CHECK(words.find("friction_hose") == std::string::npos);
}
