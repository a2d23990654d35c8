// A base clamp that slides under a spring: the retraction unit.
#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

RodProperties pulled_hose(int segments, const SlidingClamp& slider) {
  RodProperties p = hose(segments, 1.2);
  p.diameter = 0.05;
  p.damping_time = 0.02;
  p.slider = slider;
  return p;
}

/// Returns the hose at rest from x = 0 to 1.1.
RodState hanging_between(const Rod& rod) {
  RodProperties fixed = rod.properties();
  fixed.slider.reset();
  const Equilibrium start = find_equilibrium(Rod(fixed), {planar_frame(0, 0, 0), planar_frame(1.1, 0, 0)});
  REQUIRE(start.status == EquilibriumStatus::converged);
  return start.state;
}

/// Moves the tool clamp from x = 1.1 to `to` within a second, then waits until `until` [s]. seen: called after every step. The
/// base clamp starts at x = 0, pulled out by `way`.
RodState pull(const Rod& rod, double to, double h, double until,
              const std::function<void(const RodState&, double)>& seen, double way = 0) {
  const Frame base = planar_frame(-way, 0, 0);
  RodState start = hanging_between(rod);
  start.travel[0].way = way;
  WorldSettings settings;
  settings.time_step = h;
  World world(rod, settings, start);
  const int steps = static_cast<int>(std::lround(until / h));
  for (int k = 1; k <= steps; ++k) {
    const double t = k * h;
    REQUIRE(world.advance({base, planar_frame(1.1 + (to - 1.1) * smooth(t), 0, 0)}).finite);
    if (seen) seen(world.state(), t);
  }
  return world.state();
}

}  // namespace

TEST_CASE("a retraction unit comes to rest where its spring balances the hose") {
  SlidingClamp slider;
  slider.force = 20, slider.spring = 100, slider.stroke = 0.5, slider.damping = 40;
  const Rod rod(pulled_hose(30, slider));
  const RodState state = pull(rod, 1.4, 0.005, 20, {});
  const Travel& travel = state.travel[0];
  CHECK(travel.way > 0.1);
  CHECK(travel.way < 0.45);
  const double rest = 1e-3;  // [N]; remaining motion after 19 s
  CHECK(state.link_force[0].x() == Approx(20 + 100 * travel.way).margin(rest));
  CHECK(state.clamps.base.position.x() == Approx(travel.way));
}

TEST_CASE("a retraction unit stays between its stops and reports when they hold it") {
  SlidingClamp slider;
  slider.stroke = 0.1, slider.force = 15, slider.damping = 10;
  const Rod rod(pulled_hose(30, slider));
  const auto within = [&](const RodState& s, double) {
    REQUIRE(s.travel[0].way >= 0);
    REQUIRE(s.travel[0].way <= 0.1);
  };
  const RodState out = pull(rod, 1.302, 0.005, 4, within);  // 2 mm longer than hose and stroke
  CHECK(out.travel[0].way == 0.1);
  CHECK(out.travel[0].mode == Travel::Mode::at_end);
  CHECK(out.link_force[0].x() > 15);
  const RodState home = pull(rod, 0.9, 0.005, 4, within);  // so slack that the hose pulls less than the spring
  CHECK(home.travel[0].way == 0);
  CHECK(home.travel[0].mode == Travel::Mode::at_home);
  CHECK(home.link_force[0].x() < 15);
}

TEST_CASE("friction holds the sliding clamp up to its limit and takes energy when it slides") {
  SlidingClamp slider;
  slider.stroke = 0.5, slider.force = 20, slider.friction = 8;
  const Rod rod(pulled_hose(30, slider));
  double before = -1;
  int held = 0, slid = 0;
  pull(rod, 1.45, 0.005, 3, [&](const RodState& s, double t) {
    const double force = s.link_force[0].x();
    if (t > 2.5) {  // at rest again
      ++held;
      CHECK(s.travel[0].way == before);
      CHECK(std::abs(force - 20) <= 8);
    } else if (s.travel[0].speed > 0.1) {
      ++slid;
    }
    before = s.travel[0].way;
  });
  CHECK(held > 50);
  CHECK(slid > 20);
  CHECK(before > 0.2);
}

TEST_CASE("a mass on a hose below a sliding clamp swings up and down as on a spring") {
  // The mass m + M + hose on the spring alone: the hose hardly stretches.
  SlidingClamp slider;
  slider.mass = 2, slider.spring = 400, slider.stroke = 1;
  RodProperties p = unit_rod(10);
  p.tool_end = End::free;
  p.tip_mass = 4;
  p.mass_per_length = 0.5;
  p.axial_stiffness = 1e6;
  p.gravity = {0, 0, -9.81};
  p.slider = slider;
  const Rod rod(p);
  const double mass = 6.5, omega = std::sqrt(400 / mass), rest = mass * 9.81 / 400, h = 2e-3;
  RodState state = rod.straight(planar_frame(0, 0, -pi / 2));
  const ClampFrames home = state.clamps;
  const double start = rod.energy(state).total();
  RodSolver solver(rod);
  std::vector<double> crossing;
  double before = -rest, lowest = 0, most = start;
  for (int k = 1; crossing.size() < 21; ++k) {
    REQUIRE(advance_rod(rod, solver, state, home, h));
    const double off = state.travel[0].way - rest;
    if (before * off < 0) crossing.push_back((k - off / (off - before)) * h);
    lowest = std::max(lowest, state.travel[0].way);
    most = std::max(most, rod.energy(state).total());
    before = off;
  }
  const double tolerance = 1e-3;  // (omega h)^2/24 = 1e-5; the hose stretches by 65 N/1e6 N of 1 m
  CHECK(20 * pi / (crossing.back() - crossing.front()) == Approx(omega).epsilon(tolerance));
  CHECK(lowest == Approx(2 * rest).epsilon(1e-2));  // released from home; the jerk of the hose dissipates a little
  CHECK(state.link_force[0].z() < 0);
  const double half_step = 0.5 * h * mass * 9.81 * omega * rest;
  CHECK(most < start + half_step);
}

TEST_CASE("a sliding clamp leaves the motion of second order in the step and feeds it no energy") {
  SlidingClamp slider;
  slider.spring = 60, slider.stroke = 1, slider.mass = 3, slider.damping = 5;
  RodProperties p = pulled_hose(20, slider);
  const double way = 0.2;  // pulled out and balanced there: a jerk at the start would have no order of convergence
  p.slider->force = hanging_between(Rod(p)).link_force[0].x() - 60 * way;
  const auto ways = [&](double h) {
    std::vector<double> list;
    const int every = static_cast<int>(std::lround(0.05 / h));
    int k = 0;
    pull(
        Rod(p), 1.5, h, 3,
        [&](const RodState& s, double) {
          if (++k % every == 0) list.push_back(s.travel[0].way);
        },
        way);
    return list;
  };
  const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t k = 20; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
  };
  const auto a = ways(0.005), b = ways(0.0025), c = ways(0.00125);
  CAPTURE(distance(a, b), distance(b, c));
  CHECK(observed_order(distance(a, b), distance(b, c)) > least_order);
  // Without damping the energy does not grow after the tool clamp has stopped.
  p.damping_time = 0, p.slider->damping = 0;
  const Rod rod(p);
  double begin = 0, most = -1e9;
  pull(
      rod, 1.5, 0.002, 15,
      [&](const RodState& s, double t) {
        const double energy = rod.energy(s).total();
        if (begin == 0 && t >= 1) begin = energy;
        if (t > 1) most = std::max(most, energy);
      },
      way);
  const double half_step = 0.5 * 0.002 * 60;  // positions and velocities are half a step apart: at most 60 W
  CHECK(most < begin + half_step);
}
