// The chance of few lives of a world, against the law from which the lives are drawn.
#include "pipeline/advise/plan/pooled_lives.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "pipeline/base/order.h"
#include "pipeline/base/statistics.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double median = 7500, of_worlds = 0.7,
                 within = 0.74;  // ln of a life is normal over the worlds, and in a world

LifeTable drawn(std::size_t worlds, std::size_t draws, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  LifeTable table{worlds, draws, {}, 40000, 70};
  for (std::size_t w = 0; w < worlds; ++w) {
    const double z = normal_quantile((double(w) + 0.5) / double(worlds));  // one world in each stratum, as in plans
    for (std::size_t d = 0; d < draws; ++d)
      table.hours.push_back(static_cast<float>(median * std::exp(of_worlds * z + within * normal(random))));
    std::sort(table.hours.end() - std::ptrdiff_t(draws), table.hours.end());
  }
  return table;
}

struct Spread {
  double of_worlds = 0, within = 0;  // variances
};
Spread spread_of(const LifeTable& table) {
  Spread spread;
  double mean = 0;
  std::vector<double> means;
  for (std::size_t w = 0; w < table.worlds; ++w) {
    double sum = 0, squares = 0;
    for (std::size_t d = 0; d < table.draws; ++d) {
      const double x = std::log(table.life(w, d));
      sum += x / double(table.draws), squares += x * x / double(table.draws);
    }
    spread.within += (squares - sum * sum) / double(table.worlds), mean += sum / double(table.worlds);
    means.push_back(sum);
  }
  for (const double of : means) spread.of_worlds += (of - mean) * (of - mean) / double(table.worlds);
  return spread;
}

}  // namespace

TEST_CASE("with few lives of each world, worlds and dresspacks differ as much as by the law") {
  constexpr std::size_t worlds = 4000, draws = 8;
  LifeTable table = drawn(worlds, draws, 1);
  const double by_chance = within * within / double(draws);
  REQUIRE(spread_of(table).of_worlds == Approx(of_worlds * of_worlds + by_chance).epsilon(0.07));
  remove_chance(table);
  for (std::size_t w = 0; w < worlds; ++w)
    REQUIRE(std::is_sorted(table.hours.begin() + std::ptrdiff_t(w * draws),
                           table.hours.begin() + std::ptrdiff_t((w + 1) * draws)));
  const Spread found = spread_of(table);
  // The variance of 4,000 means has an error of 2.2 %: three errors. By chance it would be larger by 14 %.
  CHECK(found.of_worlds == Approx(of_worlds * of_worlds).epsilon(0.07));
  // Within a world: an error of 0.8 % from 32,000 lives, and 1.3 % that 8 strata of a normal distribution lack.
  CHECK(found.within == Approx(within * within).epsilon(0.04));
}

TEST_CASE("many survivors do not select worlds whose few lives are long by chance") {
  constexpr double age = 2100, later = 3500;
  constexpr int dresspacks = 400;
  const auto alive = [](double hours, double z) {
    return normal_share(-(std::log(hours / median) - of_worlds * z) / within);
  };
  double fails = 0, all = 0;  // sums over z, by the law
  for (double z = -6; z < 8; z += 0.01) {
    const double weight = std::exp(-z * z / 2) * std::pow(alive(age, z), dresspacks);
    fails += weight * (1 - alive(later, z) / alive(age, z)), all += weight;
  }
  // Returns the forecast over that of the law, with the weights of (D3).
  const auto forecast = [&](const LifeTable& table) {
    const PooledLives lives(table);
    double sum = 0, weights = 0;
    for (std::size_t w = 0; w < table.worlds; ++w) {
      const double share = table.alive(w, age), weight = std::pow(lives.alive(w, age), dresspacks);
      if (share > 0) sum += weight * (1 - table.alive(w, later) / share), weights += weight;
    }
    return sum / weights / (fails / all);
  };
  // With few lives an early life is a large part of the mean of its world. Weights by this mean prefer worlds whose earliest life has
  // not ended, but ends before `later`. So the weights need the means of (D11).
  constexpr int tables = 6;
  double with_chance = 0, without = 0, by_own_means = 0;
  for (std::uint32_t seed = 2; seed < 2 + tables; ++seed) {
    LifeTable table = drawn(20000, 8, seed);
    with_chance += forecast(table) / tables;
    remove_chance(table);
    without += forecast(table) / tables;
    table.mean_ln.clear();
    by_own_means += forecast(table) / tables;
  }
  // Forecasts of single tables deviate by 4.5 %, so the mean of six has an error of 2 %.
  CHECK(without == Approx(1).margin(0.05));
  CHECK(with_chance < 0.97);
  CHECK(by_own_means > 1.15);
}

TEST_CASE("without chance nothing changes: many lives of a world, the draws that live longest, lives without end") {
  const LifeTable many = drawn(3, 20000, 3);
  LifeTable same = many;
  remove_chance(same);
  // The chance of a mean of 20,000 lives is 0.5 %, and 3 means are farther apart by 1 part in 1e4 of their variance.
  for (std::size_t k = 0; k < many.hours.size(); ++k) REQUIRE(same.hours[k] == Approx(many.hours[k]).epsilon(1e-3));
  const PooledLives lives(many);
  for (const double age : {500.0, 5000.0, 50000.0})
    for (std::size_t w = 0; w < 3; ++w) CHECK(lives.alive(w, age) == Approx(many.alive(w, age)).margin(1e-4));

  LifeTable mixed = drawn(600, 64, 4);
  for (std::size_t w = 0; w < mixed.worlds; ++w)
    for (std::size_t d = 48; d < 64; ++d) mixed.hours[w * 64 + d] = std::numeric_limits<float>::infinity();
  mixed.of_draw.resize(mixed.hours.size());
  for (std::size_t w = 0; w < mixed.worlds; ++w)
    for (std::size_t d = 0; d < 64; ++d) mixed.of_draw[(d * 37 % 64) * mixed.worlds + w] = mixed.hours[w * 64 + d];
  const std::vector<float> before = mixed.of_draw;
  remove_chance(mixed);
  for (std::size_t w = 0; w < mixed.worlds; w += 50) {
    const auto rank = [&](const std::vector<float>& of) {
      return smallest_first(64, [&](std::size_t d) { return of[d * mixed.worlds + w]; });
    };
    CHECK(rank(before) == rank(mixed.of_draw));
    CHECK(mixed.alive(w, 1e30) == Approx(0.25).margin(0.5 / 64));  // one quantile more or less
  }
}
