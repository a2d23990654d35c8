// The spread between dresspacks, learned in simulated plants.
#include "pipeline/advise/calibrate/own_spread.h"

#include <map>
#include <random>

#include "pipeline/advise/calibrate/likelihood.h"
#include "pipeline/advise/calibrate/service_records.h"
#include "pipeline/base/halving.h"
#include "pipeline/base/statistics.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

/// ln life: median + shift z + f (own deviation) + scatter. A bin joins ages within 5 %.
struct Plant {
  static constexpr double median = 9, shift = 0.9, own = 1.9, scatter = 0.3, bin = 0.05;
  /// More records of one robot would make the error of the bins exceed the range of f.
  static constexpr int most_of_robot = 6;
};

/// z: shift, then the spread between dresspacks.
ObservedLife life_of(const std::vector<ServiceRecord>& records) {
  ObservedLife life;
  std::map<std::pair<long, bool>, int> counts;
  for (const ServiceRecord& one : records) {
    ++counts[{std::lround(std::log(one.hours) / Plant::bin), one.failed}];
    if (one.entry_hours > 0) --counts[{std::lround(std::log(one.entry_hours) / Plant::bin), false}];
  }
  for (const auto& [of, count] : counts) life.service.push_back({Plant::bin * double(of.first), of.second, count});
  for (const double own : standard_normals("own", 64))
    life.variants.push_back([own](const VectorXd& z) {
      return LifeAt{Plant::median + Plant::shift * z[0] + own_spread_at(z[1]) * Plant::own * own, Plant::scatter};
    });
  return life;
}

struct Predicted {
  OwnSpread own;
  std::array<double, 3> log_deciles{};  ///< ln hours of a new dresspack
};

/// Posterior at nodes of a grid of shift and spread.
struct Nodes {
  std::vector<double> shift, spread, log_weight;
};
/// Returns the equidistant numbers of an interval.
std::vector<double> numbers_of(double low, double high) {
  constexpr int count = 17;
  std::vector<double> numbers;
  for (int k = 0; k < (low < high ? count : 1); ++k) numbers.push_back(low + k * (high - low) / (count - 1));
  return numbers;
}
Nodes posterior_at(const ObservedLife& life, std::array<double, 2> shifts, std::array<double, 2> spreads) {
  Nodes nodes;
  for (const double shift : numbers_of(shifts[0], shifts[1]))
    for (const double spread : numbers_of(spreads[0], spreads[1])) {
      const VectorXd z = Eigen::Vector2d(shift, spread);
      nodes.shift.push_back(shift), nodes.spread.push_back(spread);
      nodes.log_weight.push_back(log_likelihood(life, z) - z.squaredNorm() / 2);
    }
  return nodes;
}
/// Returns the interval that contains all but 1e-4 of the posterior, one node wider on each side.
std::array<double, 2> likely(const std::vector<double>& at, const std::vector<double>& log_weight) {
  const double most = *std::ranges::max_element(log_weight), width = numbers_of(at.front(), at.back())[1] - at.front();
  double low = at.back(), high = at.front();
  for (std::size_t k = 0; k < at.size(); ++k)
    if (log_weight[k] > most - 9) low = std::min(low, at[k] - width), high = std::max(high, at[k] + width);
  return {low, high};
}

/// learns: whether the spread is learned; else it is 1.
Predicted predicted_from(const std::vector<ServiceRecord>& records, bool learns) {
  const ObservedLife life = life_of(records);
  std::array<double, 2> shifts{-4, 4}, spreads{-4, 4};
  if (!learns) spreads = {own_spread_as_is, own_spread_as_is};
  Nodes nodes = posterior_at(life, shifts, spreads);
  for (int refined = 0; refined < 2; ++refined) {
    shifts = likely(nodes.shift, nodes.log_weight);
    if (learns) spreads = likely(nodes.spread, nodes.log_weight);
    nodes = posterior_at(life, shifts, spreads);
  }
  const auto& [shift, spread, log_weight] = nodes;
  std::mt19937 random(1);
  const double most = *std::ranges::max_element(log_weight);
  std::vector<double> weight;
  for (const double one : log_weight) weight.push_back(std::exp(one - most));
  std::discrete_distribution<std::size_t> of_posterior(weight.begin(), weight.end());
  constexpr int draws = 2000;
  VectorXd of_shift(draws), of_spread(draws);
  for (int k = 0; k < draws; ++k) {
    const std::size_t drawn = of_posterior(random);
    of_shift[k] = shift[drawn], of_spread[k] = spread[drawn];
  }
  Predicted predicted{own_spread_of(of_spread)};
  const double deviation = std::hypot(predicted.own.factor * Plant::own, Plant::scatter);
  const auto failed_until = [&](double log_age) {
    return of_shift
        .unaryExpr([&](double z) { return normal_share((log_age - Plant::median - Plant::shift * z) / deviation); })
        .mean();
  };
  const std::array<double, 3> shares{0.1, 0.5, 0.9};
  for (std::size_t i = 0; i < shares.size(); ++i)
    predicted.log_deciles[i] =
        halved(-10, 30, 40, [&](double log_age) { return failed_until(log_age) < shares[i]; }).middle();
  return predicted;
}

std::vector<ServiceRecord> plant(double truth, double factor, int robots, double begin, double end,
                                 std::mt19937& random) {
  std::normal_distribution<double> number;
  std::uniform_real_distribution<double> uniform;
  std::vector<ServiceRecord> records;
  for (int robot = 0; robot < robots; ++robot) {
    double from = 0;
    for (int count = 0; from < end && count < Plant::most_of_robot; ++count) {
      const double life =
          std::max(6.0, std::exp(Plant::median + Plant::shift * truth + factor * Plant::own * number(random) +
                                 Plant::scatter * number(random)));
      const double planned = uniform(random) < 0.3 ? end * uniform(random) : HUGE_VAL;
      const double to = std::min({from + life, from + planned, end});
      if (to > begin) records.push_back({to - from, std::max(0.0, begin - from), to == from + life});
      from = to;
    }
  }
  return records;
}

}  // namespace

TEST_CASE("own spread: the prior keeps the variance of a job, and z is exact both ways") {
  const std::vector<double> normals = standard_normals("spread", 4000);
  const OwnSpread prior = own_spread_of(Eigen::Map<const VectorXd>(normals.data(), 4000));
  CHECK(prior.factor == Approx(1).epsilon(0.03));
  CHECK(prior.low == Approx(std::exp(-0.49 - normal_decile * 0.7)).epsilon(0.01));
  CHECK(prior.high == Approx(std::exp(-0.49 + normal_decile * 0.7)).epsilon(0.01));
  CHECK(own_spread_at(own_spread_as_is) == 1);
  for (const double f : {0.01, 0.3, 1.0, 4.0}) CHECK(own_spread_at(own_spread_z(f)) == Approx(f).epsilon(1e-12));
}

TEST_CASE("own spread: in simulated plants predicted shares of failures occur, also if the records begin late") {
  std::mt19937 random(5);
  std::normal_distribution<double> number;
  constexpr int plants = 100;
  for (const auto& [robots, begin] : {std::pair{8, 0.0}, {40, 0.0}, {30, 9000.0}}) {
    std::array<double, 3> share{};
    double within = 0, off = 0, off_fixed = 0;
    for (int p = 0; p < plants; ++p) {
      const double truth = number(random), factor = own_spread_at(number(random));
      const auto records = plant(truth, factor, robots, begin, 15000, random);
      const Predicted learned = predicted_from(records, true), fixed = predicted_from(records, false);
      within += (learned.own.low <= factor && factor <= learned.own.high) / double(plants);
      const double deviation = std::hypot(factor * Plant::own, Plant::scatter);
      const double median = Plant::median + Plant::shift * truth, tenth = median - normal_decile * deviation;
      for (std::size_t i = 0; i < 3; ++i)
        share[i] += normal_share((learned.log_deciles[i] - median) / deviation) / plants;
      off += std::pow(learned.log_deciles[0] - tenth, 2) / plants;
      off_fixed += std::pow(fixed.log_deciles[0] - tenth, 2) / plants;
    }
    INFO(robots << " robots from " << begin << " h: failed " << share[0] << ", " << share[1] << ", " << share[2]
                << "; within " << within << "; error of ln p10 " << std::sqrt(off) << ", with the spread 1 "
                << std::sqrt(off_fixed));
    // Standard deviations of these means over 100 plants: 0.01, 0.015, 0.01 and 0.04. Limits are three times as wide.
    CHECK(share[0] == Approx(0.1).margin(0.03));
    CHECK(share[1] == Approx(0.5).margin(0.05));
    CHECK(share[2] == Approx(0.9).margin(0.03));
    CHECK(within == Approx(0.8).margin(0.12));
    CHECK(off < off_fixed);
  }
}

}  // namespace dresslife::pipeline
