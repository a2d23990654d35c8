// Dry friction across the hose (W36) against closed forms.
#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/constants.h"
#include "strain/loose/rings.h"
#include "tests/catch.h"
#include "tests/strain/loose/hoses.h"

using namespace dresslife;
using namespace dresslife::strain;
using dresslife::strain::test::arm;
using dresslife::strain::test::hose;
using dresslife::strain::test::signal_cable;

namespace {

constexpr std::size_t elements = 32;
constexpr double length = 2, friction = 0.3;
// Elastic displacement before friction slides [m], for a force of mu times N.
double elastic(double force) { return force / LooseCable::stick_stiffness; }

/// Returns a cable on the axis of a hose that lies freely up to a wall, `room` from the axis. It hardly resists bending.
LooseCable lying(double room) {
  LooseCable cable = signal_cable(0);
  cable.bending_stiffness = 1e-5;
  cable.farthest = room;
  cable.friction = friction;
  return cable;
}

/// Angle of the middle of the cable about the axis [rad].
double angle(const LooseCables& cables) {
  const std::vector<double>& offset = cables.state(0).offset;
  return std::atan2(offset[elements + 1], offset[elements]);
}

/// A straight hose in which gravity has a direction [rad].
std::vector<HoseNode> leaning(double gravity, double direction) {
  return hose(elements, [&](double) {
    return HoseNode{.pull = {gravity * std::cos(direction), gravity * std::sin(direction)}};
  });
}

/// A cable in a straight hose while gravity swings to both sides. Its middle is a block in a round gutter.
struct Swing {
  double farthest = 0;  ///< angle of the cable [rad]
  double work = 0,
         lost = 0;             ///< work of gravity in the last cycle, and that of friction by the closed form [J/m]
  std::vector<double> path{};  ///< angles in the last cycle
};

Swing swing(LooseCable cable, double most, double seconds, int samples = 200) {
  constexpr double room = 0.01, gravity = 9.81;
  cable.grip = 0;  // without tension each node moves by itself
  const double weight = gravity * cable.mass_per_length;
  LooseCables cables({cable}, {length, elements});
  Swing result;
  std::array<double, 2> before{};
  for (int t = 0; t <= 3 * samples; ++t) {
    const double direction = most * std::sin(2 * pi * t / samples);
    cables.advance(leaning(gravity, direction), seconds / samples);
    const std::vector<double>& offset = cables.state(0).offset;
    const std::array now{offset[elements], offset[elements + 1]};
    if (t > 2 * samples) {
      const double middle = most * std::sin(2 * pi * (t - 0.5) / samples);
      result.work += weight * (std::cos(middle) * (now[0] - before[0]) + std::sin(middle) * (now[1] - before[1]));
      result.farthest = std::max(result.farthest, std::abs(angle(cables)));
      result.path.push_back(angle(cables));
    }
    before = now;
  }
  const double lag = std::atan(friction);  // the block stays behind the lowest place by the angle of friction
  result.lost = 4 * room * std::max(0.0, most - lag) * weight * std::sin(lag);
  return result;
}

}  // namespace

TEST_CASE("a cable pressed around an arc stays below mu times N and slides above it") {
  // A bent hose presses a cable under tension onto the inner wall, N = T kappa. A sideways force inclines the total.
  constexpr double room = 0.01, kappa = 2;
  LooseCable cable = lying(room);
  cable.axial_stiffness = 10, cable.slack = -0.1;  // a tension of 0.9 N that changes little with its place
  LooseCables cables({cable}, {length, elements});
  const auto push = [&](double sideways) {
    cables.advance(hose(elements,
                        [&](double) {
                          return HoseNode{.curvature2 = kappa, .pull = {0, sideways / cable.mass_per_length}};
                        }),
                   0.04);
  };
  for (int t = 0; t < 50; ++t) push(0);
  const double press = cables.state(0).press[elements / 2];
  CHECK(press == Approx(cables.state(0).tension[0] * kappa).epsilon(0.01));
  double pushed = 0;
  const auto after =
      [&](double share) {  // of mu N; in small steps, as the direction of friction is that at the last sample
        constexpr int steps = 100;
        const double from = pushed;
        for (int t = 1; t <= steps; ++t) push((from + (share - from) * t / steps) * friction * press);
        pushed = share;
        return angle(cables);
      };
  const double start = angle(cables);
  CHECK(std::abs(after(0.9) - start) * room < 1.01 * elastic(0.9 * friction * press));
  CHECK(std::abs(after(-0.9) - start) * room < 1.01 * elastic(0.9 * friction * press));
  // Beyond, it slides until the total force lies in the cone of friction. N grows by the cosine, 1 %.
  CHECK(after(3) - start == Approx(std::atan(3 * friction) - std::atan(friction)).epsilon(0.03));
  // Without the force it slides back only until the slope of the wall is mu.
  CHECK(after(0) - start == Approx(std::atan(friction)).epsilon(0.03));
}

TEST_CASE("gravity that swings moves a cable by the closed form of dry friction, at any rate, and its work is lost") {
  constexpr double most = 0.9, room = 0.01;
  const double lag = std::atan(friction);
  LooseCable cable = lying(room);
  const double weight = 9.81 * cable.mass_per_length, held = elastic(weight * friction);
  const Swing fast = swing(cable, most, 4), slow = swing(cable, most, 8);
  CHECK(fast.farthest == Approx(most - lag).epsilon(0.01));
  CHECK(fast.work == Approx(fast.lost).epsilon(0.02));
  double apart = 0;
  for (std::size_t t = 0; t < fast.path.size(); ++t) apart = std::max(apart, std::abs(fast.path[t] - slow.path[t]));
  INFO(apart << " rad apart, " << fast.farthest << " " << most - lag << " " << fast.work << " " << fast.lost);
  // The drag that remains, at the largest speed of the gravity's direction.
  const double speed = room * most * 2 * pi / 4, dragged = LooseCable::drag_beside_friction * cable.drag * speed;
  CHECK(dragged < 0.02 * friction * weight);
  CHECK(apart < 2 * dragged / weight);
  // Below the angle of friction it moves elastically and comes back: no work is lost.
  const Swing small = swing(cable, 0.9 * lag, 4);
  CHECK(small.farthest * room < 1.1 * held);
  CHECK(std::abs(small.work) < 0.01 * held * weight * lag);
  // A drag has another path at another rate.
  cable.friction = 0;
  const Swing dragged_fast = swing(cable, most, 4), dragged_slow = swing(cable, most, 8);
  apart = 0;
  for (std::size_t t = 0; t < dragged_fast.path.size(); ++t)
    apart = std::max(apart, std::abs(dragged_fast.path[t] - dragged_slow.path[t]));
  CHECK(apart > 0.04);
}

TEST_CASE("a ring turns with a twist that alternates only where its forces exceed the friction of its cables") {
  // Ten cables on a circle, pressed on the wall by their line load. A held ring has the tension T = E A R^2 t^2/4 of the twist
  // t sin(2 pi z/L), and the sideways force T R t 2 pi/L + E I R t (2 pi/L)^3 per cable at most.
  constexpr double radius = 0.01845, load = 5, hose_length = 2.035;
  std::vector<LooseCable> cables;
  for (int k = 0; k < 10; ++k) {
    cables.push_back(signal_cable(radius * std::cos(2 * pi * k / 10), radius * std::sin(2 * pi * k / 10)));
    cables.back().friction = friction, cables.back().line_load = load;
  }
  fit_in_hose(cables, {0.0255, 0.013});
  const double wave = 2 * pi / hose_length;
  const auto held_strain = [&](double twist) { return std::pow(radius * twist, 2) / 4; };
  const auto force = [&](double twist) {
    return (cables[0].axial_stiffness * held_strain(twist) + cables[0].bending_stiffness * wave * wave) * radius *
           twist * wave;
  };
  const auto strains = [&](double twist,
                           double cycle_time) {  // of the first cable, over the last of three cycles
    constexpr int cycle = 100;
    LooseCables loose(cables, {hose_length, 64});
    std::vector<double> all;
    for (int t = 0; t <= 3 * cycle; ++t) {
      const double now = twist * std::sin(2 * pi * t / cycle);
      loose.advance(hose(64, [&](double z) { return HoseNode{.twist = now * std::sin(2 * pi * z)}; }),
                    cycle_time / cycle);
      if (t > 2 * cycle) all.push_back(loose.state(0).strain);
    }
    CHECK(loose.restless() == 0);
    return all;
  };
  constexpr double small = 0.6, large = 1.2;
  REQUIRE(force(small) < 0.8 * friction * load);
  REQUIRE(force(large) > 3 * friction * load);
  const double held = std::ranges::max(strains(small, 4));
  const double turned = small / wave, gives = elastic(force(small)) / radius;  // of the held ring [rad]
  CHECK(held == Approx(held_strain(small) * std::pow(1 - gives / turned, 2)).epsilon(0.02));
  const std::vector<double> fast = strains(large, 4), slow = strains(large, 40);
  const double slides = std::ranges::max(fast);
  CHECK(slides < 0.7 * held_strain(large));
  CHECK(slides > 0.1 * held_strain(large));
  CHECK(slides == Approx(std::ranges::max(slow)).epsilon(0.05));
}

namespace {

/// Returns the largest range of curvature in the last of six cycles, of ten cables with slack on a ring [1/m].
double range_of_curvature(double mu, double cycle_time, int samples) {
  constexpr std::size_t nodes = 65;
  constexpr int cycles = 6;
  std::vector<LooseCable> cables;
  for (int k = 0; k < 10; ++k) {
    LooseCable& cable =
        cables.emplace_back(signal_cable(0.01845 * std::cos(2 * pi * k / 10), 0.01845 * std::sin(2 * pi * k / 10)));
    cable.bending_stiffness = 0.02, cable.slack = 0.01, cable.friction = mu, cable.line_load = 5;
  }
  fit_in_hose(cables, {0.0255, 0.013});
  LooseCables loose(cables, {2.035, nodes - 1});
  loose.wind(1);
  std::vector<std::array<double, 2>> ends(cables.size() * 2 * nodes, {1e9, -1e9});
  for (int t = 0; t <= cycles * samples; ++t) {
    const double step = t == 0 ? 0.04 : cycle_time / samples;  // the same first places at every rate
    loose.advance(hose(nodes - 1, [&](double z) { return arm(z, static_cast<double>(t) / samples); }), step);
    for (std::size_t k = 0; t > (cycles - 1) * samples && k < cables.size(); ++k)
      for (std::size_t i = 0; i < 2 * nodes; ++i) {
        auto& [low, high] = ends[k * 2 * nodes + i];
        low = std::min(low, loose.state(k).curvature[i]), high = std::max(high, loose.state(k).curvature[i]);
      }
  }
  CHECK(loose.restless() == 0);
  double range = 0;
  for (const auto& [low, high] : ends) range = std::max(range, high - low);
  return range;
}

}  // namespace

TEST_CASE("a wound ring with dry friction bends its cables as much at half the rate, with a drag it does not") {
  const double range = range_of_curvature(friction, 4, 100);
  // The remaining drag is 2 % of the one that changes the range by a fifth.
  CHECK(range_of_curvature(friction, 8, 100) == Approx(range).epsilon(0.005));
  CHECK(range_of_curvature(friction, 4, 200) ==
        Approx(range).epsilon(0.03));  // friction is that of the previous sample
  CHECK(std::abs(range_of_curvature(0, 8, 100) / range_of_curvature(0, 4, 100) - 1) > 0.1);
}
