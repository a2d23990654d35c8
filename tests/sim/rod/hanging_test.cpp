// A dresspack that hangs from one clamp with a mass at its end: the arrangement in which its damping is measured.
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

RodProperties hanging(int segments, double tip_mass) {
  RodProperties p = unit_rod(segments);
  p.tool_end = End::free;
  p.tip_mass = tip_mass;
  p.diameter = 1e-3;
  return p;
}

/// Returns the lowest root of 1 + cos b cosh b = mu b (sin b cosh b - cos b sinh b), mu = tip mass / the rod's mass.
double lowest_root(double mu) {
  return bisect(1e-3, 1.8751041, 80, [mu](double b) {
    return 1 + std::cos(b) * std::cosh(b) < mu * b * (std::sin(b) * std::cosh(b) - std::cos(b) * std::sinh(b));
  });
}

}  // namespace

TEST_CASE("a hanging hose is stretched by its own weight and by the mass at its end") {
  RodProperties p = hanging(20, 3);
  p.axial_stiffness = 1e4;
  p.gravity = {0, 0, -9.81};
  const Rod rod(p);
  const Frame down = planar_frame(0, 0, -pi / 2);
  const Equilibrium e = find_equilibrium(rod, rod.straight(down).clamps);
  REQUIRE(e.status == EquilibriumStatus::converged);
  // Stretch by its own weight: midpoint rule. The first half link has an error of l^2/8, the last, of 3/2 l, of 3 l^2/8.
  const double exact = (3 + 0.5) * 9.81 / 1e4, ends = 0.5 * 9.81 / 1e4 / (20 * 20);
  CHECK(-rod.tip(e.state).z() - 1 == Approx(exact).margin(1.01 * ends));
  CHECK(rod.tensions(e.state)[0] == Approx(4 * 9.81).epsilon(1e-6));
}

TEST_CASE("a mass at the end of a cantilever bends it as the elastica") {
  // P L^2/EI = 5 (Bisshopp and Drucker 1945). The rod's own weight is 1e-4 of the mass's.
  RodProperties p = hanging(40, 1);
  p.mass_per_length = 1e-4;
  p.gravity = {0, 0, -5};
  const Rod rod(p);
  const Equilibrium e = find_equilibrium(rod, rod.straight(planar_frame(0, 0, 0)).clamps);
  REQUIRE(e.status == EquilibriumStatus::converged);
  const double n40_and_weight = 2e-4;  // 6e-5 of the chain; 0.4 of the rod's weight acts at the tip: 4e-5 of 5
  CHECK(-rod.tip(e.state).z() == Approx(0.7137915).margin(n40_and_weight));
  CHECK(1 - rod.tip(e.state).x() == Approx(0.3876284).margin(n40_and_weight));
}

TEST_CASE("a mass at the end of a cantilever rings and decays as Rayleigh's beam") {
  for (const double mu : {0.0, 0.5, 3.0}) {
    CAPTURE(mu);
    const double root = lowest_root(mu), omega = root * root, period = 2 * pi / omega, ratio = 0.02;
    RodProperties p = hanging(40, mu);
    p.damping_time = 2 * ratio / omega;
    const Rod rod(p);
    RodState state = rod.straight(planar_frame(0, 0, 0));
    const double sigma = (std::cosh(root) + std::cos(root)) / (std::sinh(root) + std::sin(root));
    for (int i = 0; i < 40; ++i) {
      const double s = root * (i + 0.5) / 40;
      const double shape = std::cosh(s) - std::cos(s) - sigma * (std::sinh(s) - std::sin(s));
      const double slope = root * (std::sinh(s) + std::sin(s) - sigma * (std::cosh(s) - std::cos(s)));
      state.velocity[i] = Vector3(0, 0, 1e-4 * shape);
      state.angular_velocity[i] = Vector3(0, -1e-4 * slope, 0);
    }
    RodSolver solver(rod);
    const double h = period / 400;
    std::vector<double> crossing, peaks;
    double before = 0, peak = 0;
    for (int k = 1; crossing.size() < 21 && k < 100000; ++k) {
      REQUIRE(advance_rod(rod, solver, state, state.clamps, h));
      const double z = rod.tip(state).z();
      if (before * z < 0) crossing.push_back((k - z / (z - before)) * h), peaks.push_back(peak), peak = 0;
      peak = std::max(peak, std::abs(z));
      before = z;
    }
    REQUIRE(crossing.size() == 21);
    const double frequency_tolerance = 1e-3;  // (root l)^2/12 and (omega h)^2/24 are below 3e-4
    CHECK(20 * pi / (crossing.back() - crossing.front()) ==
          Approx(omega * std::sqrt(1 - ratio * ratio)).epsilon(frequency_tolerance));
    const double decay_tolerance =
        0.01;  // the discrete initial shape excites other modes, which change the first peaks
    CHECK(std::log(peaks[1] / peaks[20]) / (19 * pi) ==
          Approx(ratio / std::sqrt(1 - ratio * ratio)).epsilon(decay_tolerance));
  }
}

TEST_CASE("a heavy mass on a light limp hose swings as a pendulum and keeps its energy") {
  RodProperties p = hanging(20, 10);
  p.mass_per_length = 1e-3;
  p.bending_stiffness = p.torsional_stiffness = 1e-5;
  p.axial_stiffness = 1e6;
  p.gravity = {0, 0, -9.81};
  const Rod rod(p);
  const double angle = 0.1, h = 2e-3;
  RodState state = rod.straight(planar_frame(0, 0, -pi / 2 + angle));
  state.clamps.base = planar_frame(0, 0, -pi / 2);
  for (Vector3& force : state.link_force) force = 98 * tangent(state.orientation[0]);
  RodSolver solver(rod);
  std::vector<double> crossing;
  double before = 0, most = -1e9;
  const double start = rod.energy(state).total();
  for (int k = 1; crossing.size() < 9; ++k) {
    REQUIRE(advance_rod(rod, solver, state, state.clamps, h));
    const double x = rod.tip(state).x();
    if (before * x < 0) crossing.push_back((k - x / (x - before)) * h);
    before = x;
    most = std::max(most, rod.energy(state).total());
  }
  // Small swings; the period grows by angle^2/16. The clamp bends the hose's first sqrt(EI/T) = 0.3 mm.
  const double omega = std::sqrt(9.81) * (1 - angle * angle / 16), tolerance = 2e-3;
  CHECK(8 * pi / (crossing.back() - crossing.front()) == Approx(omega).epsilon(tolerance));
  const double half_step = 0.5 * h * 98.1 * 0.32 * angle;  // positions and velocities are half a step apart
  CHECK(most < start + half_step);
}
