// Learning from dresspacks in service: against integrals, and in simulated plants.
#include <cmath>
#include <random>

#include "pipeline/advise/calibrate/life_over_parameters.h"
#include "pipeline/advise/calibrate/posterior.h"
#include "pipeline/base/statistics.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

constexpr double log_median = 8, shift = 0.7, own_spread = 0.5,
                 spread = 0.4;  // ln life: 8 + 0.7 z + 0.5 own + 0.4 scatter

/// ln hours of a dresspack; entry: at the begin of the records, minus infinite if it was installed later.
struct Lived {
  double end, entry;
  bool failed;
};
/// Mixture over the parameters that each dresspack has independently.
ObservedLife in_service(const std::vector<Lived>& records) {
  ObservedLife life;
  for (const Lived& one : records) {
    life.service.push_back({one.end, one.failed});
    if (!std::isinf(one.entry)) life.service.push_back({one.entry, false, -1});
  }
  for (const double own : standard_normals("own", 64))
    life.variants.push_back([own](const VectorXd& z) {
      return LifeAt{log_median + shift * z[0] + own_spread * own, spread};
    });
  return life;
}

struct Grid {
  double mean = 0, deviation = 0, low = 0, high = 0;  ///< low, high: 10 and 90 %
};
/// Sums over z in steps of a twentieth of a deviation.
template <class LogLikelihoodAt>
Grid posterior_on_grid(const LogLikelihoodAt& log_likelihood_at) {
  constexpr double reach = 5, width = 0.05;
  std::vector<double> at, weight;
  for (double z = -reach; z <= reach; z += width) at.push_back(z), weight.push_back(log_likelihood_at(z) - z * z / 2);
  const double most = *std::max_element(weight.begin(), weight.end());
  Grid grid;
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    weight[k] = std::exp(weight[k] - most);
    sum += weight[k], grid.mean += weight[k] * at[k], squares += weight[k] * at[k] * at[k];
  }
  grid.mean /= sum;
  grid.deviation = std::sqrt(squares / sum - grid.mean * grid.mean);
  double below = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (below < 0.1 * sum) grid.low = at[k];
    if (below < 0.9 * sum) grid.high = at[k];
    below += weight[k];
  }
  return grid;
}
Grid learned_from(const std::vector<Lived>& records) {
  const ObservedLife life = in_service(records);
  return posterior_on_grid([&](double z) { return log_likelihood(life, VectorXd::Constant(1, z)); });
}

/// Robots until `end`: dresspacks are replaced at failure, or before it. The records begin at `begin`.
struct Plant {
  double begin, end;
  std::vector<Lived> records;
};
Plant simulated(double truth, double begin, double end, std::mt19937& random) {
  std::normal_distribution<double> number;
  std::uniform_real_distribution<double> uniform;
  Plant plant{begin, end, {}};
  constexpr int robots = 8;
  constexpr double some = 4000;  // [h]: planned replacements, for a third of the dresspacks
  for (int robot = 0; robot < robots; ++robot)
    for (double from = 0; from < end;) {
      const double life = std::exp(log_median + shift * truth + own_spread * number(random) + spread * number(random));
      const double planned = uniform(random) < 1.0 / 3 ? some * uniform(random) : HUGE_VAL;
      const double to = std::min({from + life, from + planned, end});
      if (to > begin)
        plant.records.push_back(
            {std::log(to - from), from < begin ? std::log(begin - from) : -HUGE_VAL, to == from + life});
      from = to;
    }
  return plant;
}

}  // namespace

TEST_CASE("in service: the posterior of one shared parameter is that of an independent integral") {
  // A lognormal life: own and scatter add to one normal deviation.
  const double deviation = std::hypot(own_spread, spread);
  const std::vector<Lived> records{
      {7.2, -HUGE_VAL, true}, {8.1, 7.5, true}, {8.6, 8.5, false}, {7.9, -HUGE_VAL, false}, {7.9, -HUGE_VAL, false}};
  const Grid expected = posterior_on_grid([&](double z) {
    const auto u = [&](double x) { return (x - log_median - shift * z) / deviation; };
    const auto lives = [&](double x) { return 0.5 * std::erfc(u(x) / std::sqrt(2.0)); };
    const auto density = [&](double x) { return std::exp(-u(x) * u(x) / 2); };
    return std::log(density(7.2) * density(8.1) / lives(7.5) * lives(8.6) / lives(8.5) * std::pow(lives(7.9), 2));
  });
  // 64 strata instead of a normal distribution: their variance is 1.5 % too small.
  constexpr double strata = 0.02;
  const Grid found = learned_from(records);
  CHECK(found.mean == Approx(expected.mean).margin(strata * expected.deviation));
  CHECK(found.deviation == Approx(expected.deviation).epsilon(strata));
  const ObservedLife life = in_service(records);
  const Posterior posterior =
      posterior_of({[&](const VectorXd& z) { return log_likelihood(life, z); }}, VectorXd::Zero(1));
  constexpr double of_mean = 0.09, of_spread = 0.06;  // of samples worth 1,500 (posterior_test.cpp)
  CHECK(posterior.mean[0] == Approx(found.mean).margin(of_mean * found.deviation));
  CHECK(std::sqrt(posterior.covariance(0, 0)) == Approx(found.deviation).epsilon(of_spread));
}

TEST_CASE(
    "in service: of simulated plants the true parameter is learned, and too long lives where truncation is ignored") {
  std::mt19937 random(23);
  std::normal_distribution<double> number;
  constexpr int plants = 300;
  double within = 0, off = 0, off_ignored = 0, records = 0, truncated = 0, chance = 0;
  for (int p = 0; p < plants; ++p) {
    const double truth = number(random);
    const Plant plant =
        simulated(truth, 6000, 9000, random);  // two mean lives before the records begin, one within them
    std::vector<Lived> ignored = plant.records;
    for (Lived& one : ignored) truncated += !std::isinf(one.entry), one.entry = -HUGE_VAL;
    records += double(ignored.size());
    const Grid learned = learned_from(plant.records);
    within += learned.low <= truth && truth <= learned.high;
    off += (learned.mean - truth) / plants, chance += learned.deviation * learned.deviation / (double(plants) * plants);
    off_ignored += (learned_from(ignored).mean - truth) / plants;
  }
  CAPTURE(records / plants, truncated / plants, within / plants, off, off_ignored, std::sqrt(chance));
  // 80 % of 300 with a deviation of 2.3 %; bounds of 2.5 deviations.
  CHECK(within / plants > 0.742);
  CHECK(within / plants < 0.858);
  CHECK(std::abs(off) < 2.5 * std::sqrt(chance));
  CHECK(off_ignored > 5 * std::sqrt(chance));
}

TEST_CASE("in service: dresspacks with values of their own live as long as the samples of a run") {
  constexpr std::size_t slack = index_of(Uncertain::slack), strength = index_of(Uncertain::strength);
  const auto mode = [&](const std::string& name, double median) {
    LifeResponse response;
    response.mode = name, response.construction = "hose", response.material = "copper";
    response.knowledge = prior_of({});
    response.knowledge.covariance.setZero();
    response.knowledge.covariance(slack, slack) = 1;
    response.planned = {{median - 0.25, median, median + 0.25}};
    response.scatter_shared = 0.5;
    response.points.clear(), response.inside.clear(), response.worst_life.clear();
    for (const double s : {0.0, -1.5, 1.5}) {
      response.points.push_back({});
      response.points.back()[slack] = s;
      response.inside.push_back(Inside::as_is);
      response.worst_life.push_back(median - 0.4 * s);
    }
    return response;
  };
  const FailureModes modes{mode("wires of a", 5), mode("wires of b", 5.1)};
  std::array<bool, uncertain_count> shared{}, own{};
  shared[strength] = own[slack] = true;
  const LifeOverParameters life(modes, shared);
  const std::vector<OwnValues> values = own_values(modes, own, Eigen::VectorXd::Ones(uncertain_count), 64);
  const std::vector<double> samples = first_failures(modes, "a run");
  std::vector<double> sorted = samples;
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.1, 0.25, 0.5, 0.75, 0.9}) {
    const double log_age = number_at(sorted, share * double(sorted.size()) - 0.5) * std::log(10.0);
    double failed = 0;
    for (const OwnValues& of : values) {
      const LifeAt at = life.at(VectorXd::Zero(uncertain_count), &of);
      failed += normal_share((log_age - at.log_median) / at.spread) / double(values.size());
    }
    // 64 values in three dimensions, of which one dominates: the error of the share is about half of sqrt(0.25/64).
    CHECK(failed == Approx(share).margin(0.03));
  }
}

TEST_CASE(
    "in service: the damage of several programs adds up in each mode, and a program mixed with itself is itself") {
  const auto mode = [](const std::string& name, double log10_life) {
    LifeResponse response;
    response.mode = name, response.construction = "hose", response.material = "copper";
    response.knowledge = prior_of({});
    response.planned = {{log10_life - 0.1, log10_life, log10_life + 0.1}};
    response.worst_life = {log10_life};
    return response;
  };
  const std::array<bool, uncertain_count> none{};
  const VectorXd zero = VectorXd::Zero(uncertain_count);
  const FailureModes one{mode("a", 5), mode("b", 6)}, other{mode("a", 7), mode("b", 5.2)};
  constexpr double rounding = 1e-12;
  const double alone = LifeOverParameters(one, none).log_median_at(zero);
  CHECK(alone == Approx(5 * std::log(10.0)).epsilon(rounding));
  CHECK(LifeOverParameters({{one, 12}, {one, 18}}, none).log_median_at(zero) ==
        Approx(alone - std::log(30.0)).epsilon(rounding));
  // Mode b fails first under both programs together. Under each program alone another mode would fail first.
  const double a = 20e-5 + 200e-7, b = 20e-6 + 200 * std::pow(10, -5.2);
  REQUIRE(b > a);
  CHECK(LifeOverParameters({{one, 20}, {other, 200}}, none).log_median_at(zero) ==
        Approx(-std::log(b)).epsilon(rounding));
}

}  // namespace dresslife::pipeline
