// Scatter of life: closed forms, enumeration of every outcome, and sampling against the closed form.
#include "fatigue/scatter.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "fatigue/conductors.h"
#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/fatigue/wire_lives.h"

using namespace dresslife;
using namespace dresslife::fatigue;

namespace {

constexpr double rounding = 1e-12;  // relative: some hundred sums and products of doubles
constexpr double bisected = 1e-8;   // relative: lives are found to 1e-10; the slope of a share is at most 100
constexpr double one_deviation = 0.8413447460685429;  // Phi(1)

/// Returns a bundle of wires with these median lives.
ConductorWires wires(const std::vector<double>& lives, std::vector<double> rate = {}) {
  ConductorWires bundle;
  for (const double life : lives) bundle.damage.push_back(1 / life);
  bundle.rate = std::move(rate);
  return bundle;
}

/// Returns P(at least `count` events) by enumeration of all 2^n outcomes.
double enumerated(const std::vector<double>& p, int count) {
  double sum = 0;
  for (unsigned outcome = 0; outcome < 1u << p.size(); ++outcome) {
    double probability = 1;
    int happened = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const bool yes = outcome >> i & 1;
      probability *= yes ? p[i] : 1 - p[i];
      happened += yes;
    }
    if (happened >= count) sum += probability;
  }
  return sum;
}

}  // namespace

TEST_CASE("scatter: half have broken at the median, 84 % one standard deviation later") {
  CHECK(broken_share(500, 500, 0.2) == 0.5);
  CHECK(broken_share(500 * std::pow(10, 0.2), 500, 0.2) == Approx(one_deviation).epsilon(rounding));
  CHECK(broken_share(500 / std::pow(10, 0.2), 500, 0.2) == Approx(1 - one_deviation).epsilon(rounding));
  CHECK(broken_share(499, 500, 0) == 0);
  CHECK(broken_share(500, 500, 0) == 1);
  CHECK(broken_share(1e9, infinity, 0.2) == 0);
}

TEST_CASE("scatter: at least k of n against every outcome") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> p;
  for (int i = 0; i < 11; ++i) p.push_back(uniform(random));
  for (int count = 0; count <= 12; ++count)
    CHECK(at_least(p, count) == Approx(enumerated(p, count)).epsilon(rounding).margin(1e-300));
  CHECK(at_least(std::vector<double>(3, 0.5), 2) == 0.5);
}

TEST_CASE("scatter: percentiles of one wire, of the first and of the last of equal wires") {
  constexpr double z90 = 1.2815515655446004;
  const double s = 0.25;
  CHECK(life_until(std::vector{1 / 800.0}, 1, s, 0.5) == Approx(800).epsilon(bisected));
  CHECK(life_until(std::vector{1 / 800.0}, 1, s, 0.9) == Approx(800 * std::pow(10, s * z90)).epsilon(bisected));
  const std::vector<double> equal(40, 1 / 800.0);
  for (const double share : percentiles) {
    // 1 - (1-p)^n = share, p^n = share
    const double first = life_until(equal, 1, s, share), last = life_until(equal, 40, s, share);
    CHECK(broken_share(first, 800, s) == Approx(1 - std::pow(1 - share, 1 / 40.0)).epsilon(bisected));
    CHECK(broken_share(last, 800, s) == Approx(std::pow(share, 1 / 40.0)).epsilon(bisected));
  }
  const std::vector<double> four{1 / 300.0, 0, 1 / 100.0, 1 / 200.0};
  CHECK(life_until(four, 2, 0, 0.1) == 200);
  CHECK(life_until(four, 4, s, 0.5) == infinity);
  CHECK(life_until(four, 3, s, 0.5) < infinity);
}

TEST_CASE("scatter: the first conductor of single wires is the first wire, and the worst leads") {
  const std::vector<double> lives{100, 150, 400, 90};
  std::vector<ConductorWires> single;
  std::vector<double> damage;
  for (const double life : lives) single.push_back(wires({life})), damage.push_back(1 / life);
  const Percentiles first = first_conductor_lives(single, 10, 0.2);
  for (std::size_t i = 0; i < first.size(); ++i)
    CHECK(first[i] == Approx(life_until(damage, 1, 0.2, percentiles[i])).epsilon(bisected));
  CHECK(first_conductor_lives(std::vector{wires({50, 60, 70}), wires({55, 56, 57})}, 100, 0)[0] == 57);
  CHECK(first_conductor_lives(std::vector{wires({infinity})}, 100, 0.2)[0] == infinity);
  const FailureLives own = conductor_lives(wires({100, 200, 300}), 50, 0);
  CHECK((own[0][1] == 100 && own[1][1] == 200 && own[2][1] == 300));
}

TEST_CASE("scatter: drawn numbers are standard normal and independent") {
  constexpr int count = 100000;
  const double deviation = 1 / std::sqrt(double(count)), bound = 4.5;  // of 4 means: one seed in 30000 fails
  double sum = 0, squares = 0, between = 0, next = 0;
  for (int i = 0; i < count; ++i) {
    const double x = normal_of(7, i);
    sum += x, squares += x * x, between += x * normal_of(8, i), next += x * normal_of(7, i + 1);
  }
  CHECK(std::fabs(sum / count) < bound * deviation);
  CHECK(std::fabs(squares / count - 1) < bound * deviation * std::sqrt(2));
  CHECK(std::fabs(between / count) < bound * deviation);
  CHECK(std::fabs(next / count) < bound * deviation);
}

TEST_CASE("scatter: drawing agrees with the closed form where nothing is shared") {
  constexpr int draws = 4000;
  const std::vector<ConductorWires> bundles{wires({100, 120, 150, 200, 400}), wires({90, 300, 310, 320})};
  const SharedLives drawn = shared_lives(bundles, 40, 0.2, draws);
  for (std::size_t i = 0; i < percentiles.size(); ++i) {
    const double q = percentiles[i],
                 place = 4.5 * std::sqrt(q * (1 - q) / draws);  // 4.5 deviations of a count
    for (std::size_t k = 0; k < bundles.size(); ++k) {
      const std::size_t n = bundles[k].damage.size();
      const std::size_t counts[]{1, 2, n};
      for (std::size_t failure = 0; failure < failures; ++failure) {
        std::vector<double> p;
        for (const double d : bundles[k].damage) p.push_back(broken_share(drawn.conductor[k][failure][i], 1 / d, 0.2));
        CHECK(std::fabs(at_least(p, counts[failure]) - q) < place);
      }
    }
    const Percentiles first = first_conductor_lives(bundles, 40, 0.2);
    CHECK(std::fabs(std::log10(drawn.first_conductor[i] / first[i])) < 0.2 * place / 0.1);  // density >= 0.1 / s
  }
}

TEST_CASE("scatter: wires left with more load break sooner by as much as the rates say") {
  // Without scatter: of medians 1 and 3 the second breaks at 1 + (3 - 1)/2, the third (7) at 2 + (7 - 3)/4.
  const SharedLives shared = shared_lives(std::vector{wires({7, 1, 3}, {1, 2, 4})}, 60, 0, 3);
  CHECK(shared.conductor[0][0][1] == 1);
  CHECK(shared.conductor[0][1][1] == 2);
  CHECK(shared.conductor[0][2][1] == 3);
  const SharedLives never = shared_lives(std::vector{wires({1, infinity}, {1, 2})}, 100, 0.1, 3);
  CHECK(never.conductor[0][2][2] == infinity);
  // Three wires, life ~ strain^-5: the last of three has 3 times the strain.
  const auto rates = sharing_rates(3, [](double factor) { return 1e-4 * std::pow(factor, 5); });
  CHECK(rates[0] == 1);
  CHECK(rates[1] == Approx(std::pow(1.5, 5)));
  CHECK(rates[2] == Approx(std::pow(3, 5)));
}

TEST_CASE("conductors: which wires lie in which part") {
  const std::vector<std::string> layers{"layer 1", "layer 2"};
  CHECK(conductor_of("cable 3/conductor 2/layer 1/wire 17", layers) == "cable 3/conductor 2");
  CHECK(conductor_of("cable 3/wire 17", layers) == "cable 3");
  CHECK(conductor_of("layer 2/wire 17", layers) == "");
  CHECK(conductor_of("wire 17", layers) == "");
  SiteDamage all;
  all.damage = {0.1, 0.5, 0.3, 0.2, 0.4};
  all.range = {1, 1, 1, 1, 1};
  TextColumn component;
  component.values = {"a/layer 1/w 1", "a/layer 2/w 1", "b/w 1"};
  component.index = {0, 1, 2, 0, 1};
  const Conductors found = conductors_of(all, component, layers);
  CHECK(found.path == std::vector<std::string>{"a", "b"});
  CHECK(found.bundle[0].damage == std::vector<double>{0.2, 0.5});  // the worst place of each wire
  CHECK(found.bundle[1].damage == std::vector<double>{0.3});
  CHECK(found.worst == std::vector<std::size_t>{1, 2});
}

TEST_CASE("scatter: one wire scatters the same whatever share of it is common") {
  constexpr double straight_pieces =
      3e-3;  // of a life: pieces of a seventh of a deviation h add h^2/6 to the variance, 0.35 %
  for (const double shared : {0.0, 1e-9, 0.2, 0.5, 0.9, 1 - 1e-9, 1.0})
    for (const double share : percentiles) {
      INFO(shared << " " << share);
      CHECK(life_until(std::vector{1 / 800.0}, 1, {0.25, shared}, share) ==
            Approx(life_until(std::vector{1 / 800.0}, 1, 0.25, share)).epsilon(straight_pieces));
    }
}

TEST_CASE("scatter: all of it in common makes equal wires break together") {
  const std::vector<double> damage{1 / 100.0, 1 / 200.0, 1 / 300.0};
  constexpr double z90 = 1.2815515655446004;
  CHECK(life_until(damage, 2, {0.2, 1}, 0.9) == Approx(200 * std::pow(10, 0.2 * z90)).epsilon(bisected));
  CHECK(life_until(damage, 2, {0.2, 1}, 0.5) == Approx(200).epsilon(bisected));
  CHECK(life_until(damage, 4, {0.2, 1}, 0.5) == infinity);
  CHECK(life_until(damage, 2, {0, 0.5}, 0.1) == 200);
}

TEST_CASE("scatter: a common part against drawing") {
  constexpr int draws = 20000;
  for (const double shared : {0.1, 0.5, 0.95}) {
    const Scatter scatter{0.3, shared};
    std::vector<double> lives, damage;
    for (int wire = 0; wire < 200; ++wire) damage.push_back(1 / (1000 * std::pow(10, 0.002 * wire)));
    for (int draw = 0; draw < draws; ++draw) {
      double first = infinity;
      for (int wire = 0; wire < 200; ++wire)
        first = std::min(first, std::pow(10, scatter.own() * normal_of(wire, draw)) / damage[wire]);
      lives.push_back(first * std::pow(10, scatter.common() * normal_of(1000, draw)));
    }
    for (const double share : percentiles) {
      const double predicted = life_until(damage, 1, scatter, share);
      const auto sooner = std::count_if(lives.begin(), lives.end(), [&](double life) { return life < predicted; });
      INFO(shared << " " << share << " " << predicted);
      CHECK(std::fabs(double(sooner) / draws - share) < 4.5 * std::sqrt(share * (1 - share) / draws));
    }
  }
}

TEST_CASE("scatter: percentiles are continuous in the common share, and spread with it") {
  const std::vector<double> damage(500, 1e-3);
  Percentiles before{};
  for (double shared = 0; shared <= 1; shared += 0.02) {
    Percentiles now;
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = life_until(damage, 1, {0.2, shared}, percentiles[i]);
    if (shared > 0) {
      CHECK(now[2] / now[0] > before[2] / before[0]);
      for (std::size_t i = 0; i < now.size(); ++i) CHECK(now[i] == Approx(before[i]).epsilon(0.25));
    }
    before = now;
  }
}

TEST_CASE("scatter: dresspacks have no factor in common") {
  const Scatter scatter{0.2, 1};
  const std::vector<std::vector<double>> two{{1e-3, 1e-3}, {}, {1e-3}};
  // The first of two independent lives: 1 - (1 - p)^2 = 1/2.
  CHECK(broken_share(first_wire_lives(two, scatter)[1], 1000, 0.2) == Approx(1 - std::sqrt(0.5)).epsilon(1e-6));
  std::vector<ConductorWires> bundles{wires({1000, 2000}), wires({1000})};
  bundles[1].dresspack = 2;
  CHECK(first_conductor_lives(bundles, 10, scatter)[1] == Approx(first_wire_lives(two, scatter)[1]).epsilon(1e-6));
  CHECK(first_wire_lives(std::vector<std::vector<double>>{{0, 0}}, scatter)[0] == infinity);
}

TEST_CASE("scatter: drawing with a common part agrees with the closed form") {
  constexpr int draws = 4000;
  const Scatter scatter{0.2, 0.6};
  const std::vector<ConductorWires> bundles{wires({100, 120, 150, 200, 400}), wires({90, 300, 310, 320})};
  const SharedLives drawn = shared_lives(bundles, 40, scatter, draws);
  const Percentiles first = first_conductor_lives(bundles, 40, scatter);
  for (std::size_t i = 0; i < percentiles.size(); ++i) {
    const double q = percentiles[i], place = 4.5 * std::sqrt(q * (1 - q) / draws);
    CHECK(std::fabs(std::log10(drawn.first_conductor[i] / first[i])) < 0.2 * place / 0.1);  // density >= 0.1 / s
  }
}
