// The planner's life: the first conductor that has lost its share of wires at one place. Tested between bounds, by sampling
// and in its limits.
#include "fatigue/places.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "fatigue/conductors.h"
#include "pipeline/base/constants.h"
#include "pipeline/life/planning.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::fatigue;

namespace {

constexpr double left_out = 1e-3;  // of a life: error from the neglected places and from piecewise linear curves
constexpr double straight_pieces = 3e-3;

/// Conductors with this number of wires. damage(conductor, segment, wire).
struct Pack {
  std::vector<PlacesOfConductor> places;
  std::vector<ConductorWires> bundles;
  std::size_t segments = 0;
};

template <class Damage>
Pack pack_of(std::size_t conductors, std::size_t segments, std::size_t wires, const Damage& damage) {
  Pack pack{{}, {}, segments};
  for (std::size_t c = 0; c < conductors; ++c) {
    pack.places.emplace_back();
    pack.bundles.emplace_back();
    pack.bundles.back().damage.assign(wires, 0.0);
    for (std::size_t g = 0; g < segments; ++g)
      for (std::size_t w = 0; w < wires; ++w) {
        const double d = damage(c, g, w);
        pack.places.back().damage.push_back(d);
        pack.bundles.back().damage[w] = std::max(pack.bundles.back().damage[w], d);
      }
  }
  return pack;
}

FirstPlace lives_of(const Pack& pack, double percent, Scatter scatter, int draws = 1000) {
  return first_place_lives(pack.places, pack.bundles, pack.segments, percent, scatter, draws);
}

/// Damage that varies from wire to wire along the dresspack, as in a bent helix.
double turning(std::size_t conductor, std::size_t segment, std::size_t wire) {
  const double bend = 1 - 0.02 * std::fabs(double(segment) - 7) - 0.03 * double(conductor);
  return 1e-3 * std::pow(bend * (1 + 0.3 * std::cos(0.7 * double(wire) + 1.1 * double(segment))), 9);
}

}  // namespace

TEST_CASE("places: one segment is the conductors' own share, in one place or anywhere") {
  const Pack pack = pack_of(3, 1, 20, [](auto c, auto, auto w) { return 1e-3 / double(1 + c + w); });
  for (const double shared : {0.0, 0.5}) {
    const Scatter scatter{0.2, shared};
    const FirstPlace first = lives_of(pack, 25, scatter);
    const Percentiles anywhere = first_conductor_lives(pack.bundles, 25, scatter);
    for (std::size_t i = 0; i < first.lives.size(); ++i) CHECK(first.lives[i] == Approx(anywhere[i]).epsilon(left_out));
    CHECK(first.soonest.at(0).conductor == 0);
    CHECK(first.soonest.at(0).segment == 0);
  }
}

TEST_CASE("places: a break in each of several segments is none of a share at one place") {
  // Ten wires, each damaged only in its own segment: one breaks anywhere, never two at one place.
  const Pack pack = pack_of(1, 10, 10, [](auto, auto g, auto w) { return g == w ? 1e-3 : 0.0; });
  CHECK(lives_of(pack, 20, 0.2).lives[0] == infinity);
  CHECK(lives_of(pack, 20, 0.2).soonest.empty());
  CHECK(first_conductor_lives(pack.bundles, 20, 0.2)[0] < 1000);
  // 10 % are one wire, so a break anywhere is a break at one place.
  for (std::size_t i = 0; i < percentiles.size(); ++i)
    CHECK(lives_of(pack, 10, {0.2, 0.5}).lives[i] ==
          Approx(first_conductor_lives(pack.bundles, 10, {0.2, 0.5})[i]).epsilon(straight_pieces));
}

TEST_CASE("places: limits of scatter, of its common part and of damage") {
  const Pack pack = pack_of(4, 12, 30, turning);
  double soonest = infinity;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t g = 0; g < 12; ++g) {
      std::vector<double> damage;
      for (std::size_t w = 0; w < 30; ++w) damage.push_back(turning(c, g, w));
      std::sort(damage.rbegin(), damage.rend());
      soonest = std::min(soonest, 1 / damage[2]);
    }
  for (const double life : lives_of(pack, 10, 0).lives) CHECK(life == Approx(soonest));
  for (const double life : lives_of(pack, 10, {0, 0.5}).lives) CHECK(life == Approx(soonest));
  constexpr double z90 = 1.2815515655446004;
  CHECK(lives_of(pack, 10, {0.2, 1}).lives[0] == Approx(soonest * std::pow(10, -0.2 * z90)).epsilon(1e-6));
  for (const Scatter scatter : {Scatter{1e-6}, Scatter{1e-6, 0.5}})
    for (const double life : lives_of(pack, 10, scatter).lives) CHECK(life == Approx(soonest).epsilon(1e-4));
  const Pack sound = pack_of(2, 5, 8, [](auto, auto, auto) { return 0.0; });
  CHECK(lives_of(sound, 10, {0.2, 0.5}).lives[0] == infinity);
  CHECK(lives_of(Pack{}, 10, {0.2, 0.5}).lives[2] == infinity);
  const Pack single = pack_of(3, 4, 1, turning);  // one wire each
  CHECK(lives_of(single, 0, 0.2).lives[1] == Approx(lives_of(single, 100, 0.2).lives[1]));
  CHECK(lives_of(pack, 100, {0.2, 0.5}).lives[0] > lives_of(pack, 10, {0.2, 0.5}).lives[0]);
}

TEST_CASE("places: reported lives are shorter than sampled ones, and near them") {
  constexpr int draws = 4000;
  std::mt19937 random(11);
  for (const double percent : {4.0, 10.0, 40.0})
    for (const double shared : {0.0, 0.5}) {
      const Pack pack = pack_of(5, 15, 30, turning);
      const Scatter scatter{0.2, shared};
      const std::size_t count = pipeline::wires_of_share(percent, 30);
      std::vector<double> lives, breaks;
      std::normal_distribution<double> normal;
      for (int draw = 0; draw < draws; ++draw) {
        const double common = scatter.common() * normal(random);
        double first = infinity;
        for (std::size_t c = 0; c < 5; ++c) {
          std::vector<double> factors;
          for (int w = 0; w < 30; ++w) factors.push_back(std::pow(10, common + scatter.own() * normal(random)));
          for (std::size_t g = 0; g < 15; ++g) {
            breaks.clear();
            for (std::size_t w = 0; w < 30; ++w) breaks.push_back(factors[w] / turning(c, g, w));
            std::nth_element(breaks.begin(), breaks.begin() + static_cast<std::ptrdiff_t>(count - 1), breaks.end());
            first = std::min(first, breaks[count - 1]);
          }
        }
        lives.push_back(first);
      }
      const FirstPlace told = lives_of(pack, percent, scatter);
      for (std::size_t i = 0; i < percentiles.size(); ++i) {
        const double share = percentiles[i], sampling = 4.5 * std::sqrt(share * (1 - share) / draws);
        const auto sooner = [&](double life) {
          return double(std::count_if(lives.begin(), lives.end(), [&](double drawn) { return drawn < life; })) / draws;
        };
        INFO(percent << " " << shared << " " << share << " " << told.lives[i]);
        CHECK(sooner(told.lives[i]) < share + sampling);        // the predicted life is not longer than the sampled one
        CHECK(sooner(told.lives[i] * 1.1) > share - sampling);  // and less than a tenth shorter
      }
      // Sampling needs no bounds: rates of 1 do not redistribute load.
      Pack drawn = pack;
      for (ConductorWires& bundle : drawn.bundles) bundle.rate.assign(30, 1.0);
      const FirstPlace by_draws = lives_of(drawn, percent, scatter, draws);
      for (std::size_t i = 0; i < percentiles.size(); ++i) {
        CHECK(by_draws.lives[i] > told.lives[i] * 0.95);
        CHECK(by_draws.lives[i] < told.lives[i] * 1.15);
      }
    }
}

TEST_CASE("places: those left out do not move the life") {
  // Weak places among a thousand strong ones. The strong ones alone would last ten times as long.
  const auto damage = [](std::size_t c, std::size_t g, std::size_t w) {
    return (g == 3 ? 1e-3 : g % 5 ? 1e-4 : 6e-4) * (1 + 0.1 * double(w)) / (1 + 0.05 * double(c));
  };
  const Pack pack = pack_of(20, 50, 10, damage);
  const FirstPlace some = lives_of(pack, 20, {0.2, 0.5});
  CHECK(some.judged < 400);
  CHECK(some.judged >= 20);
  CHECK(some.soonest.at(0).segment == 3);
  // The same probability from all places, one by one: 1 - product over conductors and segments, integrated over the common
  // factor.
  std::vector<LifeDistribution> all;
  const Scatter scatter{0.2, 0.5};
  const double own = scatter.own() * std::log(10);
  std::vector<Wires> wires;
  for (std::size_t c = 0; c < 20; ++c)
    for (std::size_t g = 0; g < 50; ++g) wires.emplace_back(std::span(pack.places[c].damage).subspan(g * 10, 10));
  std::vector<Wires> anywhere;
  for (const ConductorWires& bundle : pack.bundles) anywhere.emplace_back(bundle.damage);
  all.emplace_back(
      [&, memory = std::vector<double>()](double log_time) mutable {
        double none = 1;
        for (std::size_t c = 0; c < 20; ++c) {
          double of_it = 1;
          for (std::size_t g = 0; g < 50; ++g) of_it *= 1 - wires[c * 50 + g].failed(log_time, 2, own, memory);
          none *= std::max(of_it, 1 - anywhere[c].failed(log_time, 2, own, memory));
        }
        return 1 - none;
      },
      std::log(1e3) - 9, std::log(1e3) + 9, scatter.common() * std::log(10));
  const Percentiles whole = first_of(all);
  for (std::size_t i = 0; i < whole.size(); ++i) CHECK(some.lives[i] == Approx(whole[i]).epsilon(straight_pieces));
}

TEST_CASE("places: dresspacks scatter apart, and broken wires that leave their load shorten lives") {
  Pack pack = pack_of(2, 6, 20, turning);
  const Scatter scatter{0.2, 1};
  const Percentiles together = lives_of(pack, 10, scatter).lives;
  pack.bundles[1].dresspack = 1;
  CHECK(lives_of(pack, 10, scatter).lives[0] < together[0]);
  Pack loaded = pack;
  for (ConductorWires& bundle : loaded.bundles)
    for (int broken = 0; broken < 20; ++broken) bundle.rate.push_back(std::pow(20.0 / (20 - broken), 9));
  const FirstPlace shared = lives_of(loaded, 10, {0.2, 0.5}), alone = lives_of(pack, 10, {0.2, 0.5});
  CHECK(shared.lives[1] < alone.lives[1] * 1.05);
  CHECK(lives_of(loaded, 40, {0.2, 0.5}).lives[1] < 0.8 * lives_of(pack, 40, {0.2, 0.5}).lives[1]);
}

TEST_CASE("places: damage of all wires everywhere, by conductor, segment and wire") {
  const std::vector<std::string> layers{"layer 1", "layer 2"};
  SiteDamage all;
  all.damage = {0.1, 0.5, 0.3, 0.2, 0.4, 0.7, 0.9};
  all.range.assign(7, 1.0f);
  all.wall = {0, 0, 0, 0, 0, 0, 1};
  TextColumn component;
  component.values = {"a/layer 1/w 1", "a/layer 2/w 1", "b/w 1", "hose 1"};
  component.index = {0, 1, 2, 0, 1, 0, 3};
  const std::vector<std::size_t> segment{0, 0, 0, 1, 1, 1, 1};  // a wire with two fibres counts by its worse fibre
  const Conductors conductors = conductors_of(all, component, layers);
  const auto places = places_of(all, component, conductors, 2, [&](std::size_t site) { return segment[site]; });
  REQUIRE(places.size() == 2);
  CHECK(places[0].damage == std::vector<double>{0.1, 0.5, 0.7, 0.4});
  CHECK(places[1].damage == std::vector<double>{0.3, 0.0});
}

TEST_CASE(
    "places: by medians a conductor fails with its k-th wire in its worst segment, broken ones elsewhere do "
    "not count") {
  // Failure is the second break of five wires: 40 % is 2. In conductor 1 no place has two damaged wires.
  const Pack pack = pack_of(2, 3, 5, [](auto c, auto g, auto w) {
    if (c == 1) return w == g ? 1.0 : 0.0;
    return std::vector<std::vector<double>>{{8, 1, 1, 1, 1}, {4, 5, 0, 0, 0}, {0, 0, 2, 2, 2}}[g][w] * 1e-3;
  });
  const std::vector<double> lives = median_place_lives(pack.places, pack.bundles, pack.segments, 40);
  REQUIRE(lives.size() == 2);
  CHECK(lives[0] == Approx(1 / 4e-3).epsilon(1e-14));
  CHECK(lives[1] == infinity);
}
