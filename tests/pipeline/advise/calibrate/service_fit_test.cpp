// Kaplan-Meier estimates against hand computation, and the check of a prediction in simulated plants.
#include "pipeline/advise/calibrate/service_fit.h"

#include <cmath>
#include <random>

#include "pipeline/advise/calibrate/learned.h"
#include "pipeline/base/statistics.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

/// ln life: median + shift z + own deviation + scatter.
struct LnLife {
  static constexpr double median = 9, shift = 0.7, own = 1.2, scatter = 0.4;
};

ObservedLife predicted_life(const std::vector<ServiceRecord>& records) {
  ObservedLife life;
  for (const ServiceRecord& one : records) {
    life.service.push_back({std::log(one.hours), one.failed});
    if (one.entry_hours > 0) life.service.push_back({std::log(one.entry_hours), false, -1});
  }
  for (const double own : standard_normals("own", 64))
    life.variants.push_back([own](const VectorXd& z) {
      return LifeAt{LnLife::median + LnLife::shift * z[0] + LnLife::own * own, LnLife::scatter};
    });
  return life;
}

/// Samples of the posterior of z, by inversion on a grid.
Eigen::MatrixXd posterior_draws_of(const ObservedLife& life) {
  constexpr int nodes = 81, draws = 40;
  constexpr double reach = 4;
  std::vector<double> at, log_weight;
  for (int k = 0; k < nodes; ++k) {
    at.push_back(reach * (2.0 * k / (nodes - 1) - 1));
    log_weight.push_back(log_likelihood(life, VectorXd::Constant(1, at.back())) - at.back() * at.back() / 2);
  }
  const double most = *std::max_element(log_weight.begin(), log_weight.end());
  double sum = 0;
  for (double& one : log_weight) sum += one = std::exp(one - most);
  Eigen::MatrixXd made(draws, 1);
  double below = log_weight[0];
  for (int d = 0, k = 0; d < draws; ++d) {
    while (below < (d + 0.5) / draws * sum) below += log_weight[std::size_t(++k)];
    made(d, 0) = at[std::size_t(k)];
  }
  return made;
}

ServiceFit fit_of(const std::vector<ServiceRecord>& records) {
  const ObservedLife life = predicted_life(records);
  return service_fit(life, records, posterior_draws_of(life));
}

/// Robots with dresspacks that are replaced at failure or before it, until `end` [h]; the records begin at `begin`.
/// deviation: of ln life between dresspacks.
std::vector<ServiceRecord> plant(double truth, double deviation, int robots, double begin, double end,
                                 std::mt19937& random) {
  std::normal_distribution<double> number;
  std::uniform_real_distribution<double> uniform;
  std::vector<ServiceRecord> records;
  for (int robot = 0; robot < robots; ++robot)
    for (double from = 0; from < end;) {
      const double life = std::exp(LnLife::median + LnLife::shift * truth + deviation * number(random));
      const double planned = uniform(random) < 0.3 ? 2 * end * uniform(random) : HUGE_VAL;
      const double to = std::min({from + life, from + planned, end});
      if (to > begin) records.push_back({to - from, std::max(0.0, begin - from), to == from + life});
      from = to;
    }
  return records;
}

}  // namespace

TEST_CASE("service fit: Kaplan-Meier with censored records, records that begin late, and few dresspacks") {
  std::vector<ServiceRecord> records;
  for (int k = 1; k <= 20; ++k) records.push_back({100.0 * k, 0, k % 2 == 0});  // odd ages are in use
  const auto ages = observed_ages(records);
  REQUIRE(ages);
  CHECK(ages->from == 0);
  CHECK(ages->until == 1600);  // then four remain
  // 18/19, 16/17 .. : 0.947, 0.892, 0.832, 0.768, 0.699, 0.621, 0.532, 0.426
  CHECK(ages->tenth.value_or(0) == 400);
  CHECK(ages->half.value_or(0) == 1600);
  double alive = 1;
  for (int n = 19; n >= 5; n -= 2) alive *= 1 - 1.0 / n;
  CHECK(ages->failed_until == Approx(1 - alive));
  // Dresspacks that were 1,000 h old when the records began contain nothing about earlier ages.
  for (ServiceRecord& one : records) one.hours += 1000, one.entry_hours = 1000;
  const auto late = observed_ages(records);
  REQUIRE(late);
  CHECK(late->from == 1000);
  CHECK(late->tenth.value_or(0) == 1400);
  // Ten young ones beside them: of 30 at the first failures, of 20 later.
  for (int k = 0; k < 10; ++k) records.push_back({500, 0, k == 0});
  const auto both = observed_ages(records);
  REQUIRE(both);
  CHECK(both->from == 0);
  CHECK(both->tenth.value_or(0) == 500);
  CHECK_FALSE(observed_ages({{100, 0, true}, {200, 0, true}, {300, 0, false}, {400, 0, false}}));
  CHECK_FALSE(observed_ages({}));
  const auto none_failed = observed_ages(std::vector<ServiceRecord>(6, {100, 0, false}));
  REQUIRE(none_failed);
  CHECK(none_failed->failed_until == 0);
  CHECK_FALSE(none_failed->tenth);
}

TEST_CASE("service fit: plants of the model itself are rarely doubted, plants of another scatter usually are") {
  std::mt19937 random(31);
  std::normal_distribution<double> number;
  constexpr int true_ones = 100, others = 30;
  const double deviation = std::hypot(LnLife::own, LnLife::scatter);
  const auto warned = [&](int plants, double scatter, int robots, double begin) {
    int count = 0;
    for (int p = 0; p < plants; ++p)
      count += fit_of(plant(number(random), scatter, robots, begin, 20000, random)).chance < least_service_chance;
    return count / double(plants);
  };
  const double small = warned(true_ones, deviation, 10, 0), large = warned(true_ones, deviation, 60, 0),
               late = warned(true_ones, deviation, 40, 12000);
  const double narrow = warned(others, 0.4, 40, 0), wide = warned(others, 2.5, 60, 0),
               narrow_late = warned(others, 0.3, 40, 12000);
  CAPTURE(small, large, late, narrow, wide, narrow_late);
  // Of 1,000 plants each 0.5 %, 0.4 % and 0.6 %. The bound of Meng is 2 %.
  CHECK(small <= 0.03);
  CHECK(large <= 0.03);
  CHECK(late <= 0.03);
  CHECK(narrow > 0.7);
  CHECK(wide > 0.5);
  CHECK(narrow_late > 0.5);
}

TEST_CASE("service fit: the warning has the observed hours, the direction and a remedy, few failures give none") {
  std::vector<ServiceRecord> narrow;
  for (int k = 0; k < 40; ++k) narrow.push_back({4000.0 + 25 * k, 0, true});
  for (int k = 0; k < 20; ++k) narrow.push_back({500.0 + 100 * k, 0, false});
  LearnedTest test;
  test.observation.name = "cell", test.observation.service = narrow;
  test.fit = fit_of(narrow);
  CHECK(test.fit.shape > 2);
  const auto warning = contradiction_of(test);
  REQUIRE(warning);
  CHECK_THAT(warning->words,
             Catch::Contains("'cell': the records contradict the prediction") && Catch::Contains("limit 1 %") &&
                 Catch::Contains("10 % had failed by 4,080 h") &&
                 Catch::Contains("Likely cause: dresspacks that were replaced by plan") &&
                 Catch::Contains("Remedy: do not plan with this calibration. Plan with the observed hours"));
  std::vector<ServiceRecord> wide;
  for (int k = 0; k < 12; ++k) wide.push_back({1.0 + k, 0, true});
  for (int k = 0; k < 40; ++k) wide.push_back({30000.0 + 100 * k, 0, k % 3 == 0});
  test.fit = fit_of(wide);
  CHECK(test.fit.shape < 0.8);
  REQUIRE(contradiction_of(test));
  CHECK_THAT(contradiction_of(test)->words, Catch::Contains("failures by another cause than wear"));
  test.fit = fit_of({{4000, 0, true}, {4010, 0, true}, {4020, 0, true}, {4030, 0, true}, {3000, 0, false}});
  CHECK(test.fit.chance == 1);
  CHECK_FALSE(contradiction_of(test));
}

}  // namespace dresslife::pipeline
