// The chain at rest against closed forms of the planar elastica.
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

TEST_CASE("a cantilever under a tip force follows the elastica to second order") {
  // Bisshopp and Drucker (1945): P L^2/EI, deflection v/L, shortening h/L.
  const double cases[][3] = {
      {1, 0.3017208, 0.0564332}, {2, 0.4934575, 0.1606417}, {5, 0.7137915, 0.3876284}, {10, 0.8106090, 0.5549956}};
  const double tip_error_n40 = 2e-5;  // l^3 P: 1.6e-5 at P = 10, smaller for smaller P
  for (const auto& [load, v, h] : cases) {
    CAPTURE(load);
    const auto error = [&, v = v, h = h, load = load](int n) {
      RodProperties p = unit_rod(n);
      p.tool_end = End::free;
      const Rod rod(p);
      const Vector3 tip = rod.tip(tip_loaded(rod, planar_frame(0, 0, 0), {0, 0, load}));
      return std::hypot(tip.z() - v, 1 - tip.x() - h);
    };
    CHECK(error(40) < tip_error_n40);
  }
}

TEST_CASE("the tip of the elastica converges at second order in the segment length") {
  // Reference: the same chain with four times the resolution. By second order its error is 1/16 of the coarse one.
  const auto tip = [](int n) {
    RodProperties p = unit_rod(n);
    p.tool_end = End::free;
    const Rod rod(p);
    return rod.tip(tip_loaded(rod, planar_frame(0, 0, 0), {0, 0, 10}));
  };
  const Vector3 a = tip(80), b = tip(160), c = tip(320);
  CHECK(observed_order((a - b).norm(), (b - c).norm()) > least_order);
}

TEST_CASE("a heavy cantilever hangs as measured and computed by Romero et al.") {
  // w L^3/EI, height / width of the hanging hose (Romero et al. 2021).
  const double cases[][2] = {{0.1, 0.0124996}, {1, 0.1245618},  {3, 0.3646208},
                             {10, 1.0668023},  {30, 2.5472139}, {100, 5.8881046}};
  const auto ratio = [](double weight, int n) {
    RodProperties p = unit_rod(n);
    p.tool_end = End::free;
    p.gravity = {0, 0, -weight};
    const Rod rod(p);
    const Equilibrium e = find_equilibrium(rod, rod.straight(planar_frame(0, 0, 0)).clamps);
    REQUIRE(e.status == EquilibriumStatus::converged);
    const Vector3 tip = rod.tip(e.state);
    return -tip.z() / tip.x();
  };
  for (const auto& [weight, expected] : cases) {
    CAPTURE(weight);
    const double tolerance = 5e-4;  // at 32, measured; the order of convergence is at least three
    CHECK(ratio(weight, 32) == Approx(expected).epsilon(tolerance));
    CHECK(ratio(weight, 64) == Approx(expected).epsilon(tolerance / 8));
  }
}

TEST_CASE("an end moment of 2 pi EI/L closes a circle with the same curvature at every link") {
  RodProperties p = unit_rod(40);
  p.tool_end = End::free;
  const Rod rod(p);
  RodState state = rod.straight(planar_frame(0, 0, 0));
  EquilibriumSettings newton;
  newton.also_unstable = true;  // under a torque about a fixed axis the rod falls sideways beyond half a circle
  for (int part = 1; part <= 8; ++part) {
    std::vector<Load> loads(40);
    loads.back().torque = Vector3(0, -2 * pi * part / 8, 0);
    const Equilibrium e = find_equilibrium(rod, state.clamps, state, loads, newton);
    REQUIRE(e.status == EquilibriumStatus::converged);
    state = e.state;
  }
  const double rounding = 1e-6;  // all links have equal moments, so only the search's residual remains
  for (int j = 0; j < 40; ++j) CHECK(curvature(rod, state, j) == Approx(2 * pi).epsilon(rounding));
  // n chords of turned segments: the polygon closes except for the missing half link of the free end, of order l^2.
  CHECK(rod.tip(state).norm() < 2 * pi / (40.0 * 40.0));
}

TEST_CASE("uniform twist between clamps, three turns of it, is equal at every link") {
  const int n = 40, turns = 3;
  const Rod rod(unit_rod(n));
  RodState state = rod.straight(planar_frame(0, 0, 0));
  // A taut rod: under a tension of 100 EI/L^2 it does not buckle at the torque 2 pi 7 GJ/L (limit 2 sqrt(P EI) + ...).
  state.clamps.tool.position *= 1 + 400 / unit_rod(n).axial_stiffness;
  for (int k = 1; k <= 16 * turns; ++k) {
    ClampFrames clamps = state.clamps;
    clamps.tool = rolled(planar_frame(clamps.tool.position.x(), 0, 0), k * pi / 8);
    const Equilibrium e = find_equilibrium(rod, clamps, state);
    REQUIRE(e.status == EquilibriumStatus::converged);
    REQUIRE(e.negative_pivots == 0);
    state = e.state;
  }
  const double tolerance = 1e-6;  // the effect of the search's residual, 1e-8 of the moment, in one link
  double largest = 0, smallest = 1e9;
  for (int j = 0; j <= n; ++j) {
    const double twist = rod.link_state(state, j).turn.z() / rod.bending_length(j);
    largest = std::max(largest, twist), smallest = std::min(smallest, twist);
  }
  CHECK(largest == Approx(2 * pi * turns).epsilon(tolerance));
  CHECK(smallest == Approx(2 * pi * turns).epsilon(tolerance));
}

TEST_CASE("uniform bend between clamps is equal at every link") {
  // The clamps are at the ends of the chain's own circular arc (end moment only). Then the tool end is fixed there.
  const int n = 40;
  const double moment = 2;  // 2 rad in total
  RodProperties p = unit_rod(n);
  const Rod rod(p);
  const auto arm = [&](int link) {  // (S17)
    const bool between = link > 0 && link < n;
    return 0.5 / n * (between ? 1 + (1 - std::cos(moment * rod.bending_length(link))) / 12 : 1);
  };
  double angle = 0;
  Vector3 joint = Vector3::Zero();
  for (int i = 0; i < n; ++i) {
    angle += moment * rod.bending_length(i);
    joint += (arm(i) + arm(i + 1)) * tangent(planar_frame(0, 0, angle).orientation);
  }
  angle += moment * rod.bending_length(n);
  const ClampFrames clamps{planar_frame(0, 0, 0), planar_frame(joint.x(), joint.z(), angle)};
  const Equilibrium e = find_equilibrium(rod, clamps);
  REQUIRE(e.status == EquilibriumStatus::converged);
  const double tolerance = 1e-6;  // the effect of the search's residual, 1e-8 of the moment, in one link
  for (int j = 0; j <= n; ++j) CHECK(curvature(rod, e.state, j) == Approx(moment).epsilon(tolerance));
  // The clamps of the true arc differ from these, and therefore the curvatures differ by an eighth of (kappa l)^2/12.
  const ClampFrames arc{planar_frame(0, 0, 0),
                        planar_frame(std::sin(moment) / moment, (1 - std::cos(moment)) / moment, moment)};
  const Equilibrium on_arc = find_equilibrium(rod, arc);
  const double arc_tolerance = moment * moment / (n * n) / 60;
  for (int j = 0; j <= n; ++j) CHECK(curvature(rod, on_arc.state, j) == Approx(moment).epsilon(arc_tolerance));
}

namespace {

// The rod of n segments, compressed in small steps until its clamps have this distance.
struct Buckled {
  double deflection, push;
};
Buckled buckle(int n, double distance) {
  RodProperties p = unit_rod(n);
  p.gravity = {0, 0, -1e-5};  // selects the side; small against forces of at least 16 pi^2
  const Rod rod(p);
  Equilibrium e = find_equilibrium(rod, {planar_frame(0, 0, 0), planar_frame(std::max(0.9, distance), 0, 0)});
  for (double x = 0.9; x > distance - 0.02; x -= 0.02) {
    e = find_equilibrium(rod, {planar_frame(0, 0, 0), planar_frame(std::max(x, distance), 0, 0)}, e.state);
    REQUIRE(e.status == EquilibriumStatus::converged);
  }
  const LinkState middle = rod.link_state(e.state, n / 2);
  return {-on_axis(rod, e.state, n / 2).z(), -rod.gap_stiffness(n / 2) * middle.gap.x()};
}

}  // namespace

TEST_CASE("a clamped rod pushed together buckles as the elastica") {
  // Four quarter waves with k = sin(alpha/2), alpha the slope at the inflections: P L^2/EI = 16 K^2, distance of the clamps
  // 2 E/K - 1, deflection at the middle k/K (all divided by L).
  for (const double alpha : {0.3, 1.0, 1.5}) {
    CAPTURE(alpha);
    const double k = std::sin(alpha / 2), K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
    const double distance = 2 * E / K - 1, deflection = k / K, push = 16 * K * K;
    const Buckled coarse = buckle(40, distance), fine = buckle(80, distance);
    const double tolerance_n40 = 4e-4;  // (4 K l)^2/12 = 2e-3, of which (S17) leaves less than a fifth
    CHECK(coarse.deflection == Approx(deflection).epsilon(tolerance_n40));
    CHECK(coarse.push == Approx(push).epsilon(tolerance_n40));
    CHECK(fine.deflection == Approx(deflection).epsilon(tolerance_n40 / 4));
    CHECK(fine.push == Approx(push).epsilon(tolerance_n40 / 4));
  }
}

TEST_CASE("a limp hose hangs as the catenary and pulls as one") {
  // Length 1, span c: sinh(x)/x = 1/c with x = c/(2 b), b = horizontal tension / weight per length.
  const double span = 0.6;
  const double x = bisect(1e-3, 10, 100, [&](double y) { return std::sinh(y) / y > 1 / span; });
  const double b = span / (2 * x), sag = b * (std::cosh(x) - 1), slope = std::atan(std::sinh(x));
  const auto solve = [&](int n) {
    RodProperties p = unit_rod(n);
    p.bending_stiffness = p.torsional_stiffness = 1e-7;  // EI/(2 w b^3) = 1e-5 of the tension
    p.gravity = {0, 0, -1};
    p.axial_stiffness = 1e5;
    const Rod rod(p);
    const Equilibrium e = find_equilibrium(rod, {planar_frame(0, 0, -slope), planar_frame(span, 0, slope)});
    REQUIRE(e.status == EquilibriumStatus::converged);
    const double pull = rod.gap_stiffness(n / 2) * rod.link_state(e.state, n / 2).gap.x();
    return std::pair(-on_axis(rod, e.state, n / 2).z(), pull);
  };
  const double tolerance = 1e-4;  // EI and EA: 1e-5 each; (l/b)^4 of the chain
  const auto [sag_60, pull_60] = solve(60);
  CHECK(sag_60 == Approx(sag).epsilon(tolerance));
  CHECK(pull_60 == Approx(b).epsilon(tolerance));
}
