// Strain with shear: closed forms of single loads, and invariance under rotation of the axes.
#include "fatigue/multiaxial.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;

namespace {

constexpr double rounding = 1e-9;  // relative; a cosine's rounding times the slope of the life curve

std::vector<double> swing(double amplitude, double phase, int samples = 400) {
  std::vector<double> history;
  for (int t = 0; t <= samples; ++t) history.push_back(amplitude * std::sin(2 * pi * t / samples + phase));
  return history;
}

double damage_of_history(const std::vector<double>& history, const pipeline::Material& m) {
  return sum_of_damage(evaluate_cycles(find_reversals(history), m, {}));
}

/// Returns the worst of `planes` planes equally spaced over half a turn, by exact lives. The stage itself uses tables.
CriticalPlane critical_plane(const std::vector<double>& strain, const std::vector<double>& shear,
                             const pipeline::Material& m, const pipeline::Fatigue& settings, int planes = 36) {
  CriticalPlane worst;
  for (int plane = 0; plane < planes; ++plane) {
    const double theta = pi * (double(plane) / planes - 0.5);
    const auto history = plane_strain(strain, shear, m.poisson_ratio, theta);
    const double damage = sum_of_damage(evaluate_cycles(find_reversals(history), m, settings));
    if (damage > worst.damage) worst = {theta, damage};
  }
  return worst;
}

}  // namespace

TEST_CASE("critical plane: pure strain breaks across the axis, as without planes") {
  auto m = copper();
  m.poisson_ratio = 0.34;
  const auto strain = swing(0.004, 0.3);
  const CriticalPlane plane = critical_plane(strain, std::vector<double>(strain.size(), 0.0), m, {});
  CHECK(plane.theta == Approx(0).margin(1e-15));
  CHECK(plane.damage == Approx(damage_of_history(strain, m)).epsilon(rounding));
}

TEST_CASE("critical plane: pure shear opens the planes at 45 degrees with half the shear") {
  auto m = copper();
  m.poisson_ratio = 0.34;
  const auto shear = swing(0.012, 0);
  const CriticalPlane plane = critical_plane(std::vector<double>(shear.size(), 0.0), shear, m, {});
  CHECK(std::fabs(plane.theta) == Approx(pi / 4).epsilon(rounding));
  CHECK(plane.damage == Approx(damage_of_history(swing(0.006, 0), m)).epsilon(rounding));
}

TEST_CASE("critical plane: in phase, its normal is the principal direction") {
  // tan 2 theta = gamma / ((1 + nu) eps); here 2 theta = 60 degrees, a whole number of 5-degree planes.
  auto m = copper();
  m.poisson_ratio = 0.34;
  const double eps = 0.003, gamma = std::sqrt(3) * (1 + m.poisson_ratio) * eps;
  const CriticalPlane plane = critical_plane(swing(eps, 0.2), swing(gamma, 0.2), m, {});
  CHECK(plane.theta == Approx(pi / 6).epsilon(rounding));
  const double principal = eps * (1 - m.poisson_ratio) / 2 + std::hypot(eps * (1 + m.poisson_ratio), gamma) / 2;
  CHECK(plane.damage == Approx(damage_of_history(swing(principal, 0.2), m)).epsilon(rounding));
  // Mirrored shear has the mirrored critical plane.
  const CriticalPlane mirrored = critical_plane(swing(eps, 0.2), swing(-gamma, 0.2), m, {});
  CHECK(mirrored.theta == Approx(-pi / 6).epsilon(rounding));
  CHECK(mirrored.damage == Approx(plane.damage).epsilon(rounding));
}

TEST_CASE("critical plane: out of phase no plane sees both loads at once") {
  auto m = copper();
  m.poisson_ratio = 0.34;
  const double in_phase = critical_plane(swing(0.003, 0), swing(0.006, 0), m, {}).damage;
  const double shifted = critical_plane(swing(0.003, 0), swing(0.006, pi / 2), m, {}).damage;
  const double strain_alone = critical_plane(swing(0.003, 0), swing(0, 0), m, {}).damage;
  CHECK(shifted < in_phase);
  CHECK(shifted >= strain_alone * (1 - rounding));
}

TEST_CASE("critical plane: 90 degrees out of phase with gamma = (1 + nu) eps is no worse than the strain alone") {
  // Mohr's circle then rotates with constant size (Kanazawa, Miller and Brown 1977): the radius of strain and half shear is
  // always (1 + nu) eps / 2. Every plane has the same shear, and the largest normal strain is eps, across the axis. In phase
  // the same loads stretch a plane by eps ((1 - nu) + sqrt(2) (1 + nu)) / 2.
  auto m = copper();
  m.poisson_ratio = 0.34;
  const double eps = 0.003, gamma = (1 + m.poisson_ratio) * eps;
  const CriticalPlane shifted = critical_plane(swing(eps, 0), swing(gamma, pi / 2), m, {});
  CHECK(shifted.theta == Approx(0).margin(1e-15));
  CHECK(shifted.damage == Approx(damage_of_history(swing(eps, 0), m)).epsilon(rounding));
  const auto grid = [&](double phase) {  // amplitude on each of 3600 planes by its closed form
    double largest = 0;
    for (int k = 0; k < 3600; ++k) {
      const double theta = pi * k / 3600, c = std::cos(theta), s = std::sin(theta);
      const double axial = eps * (c * c - m.poisson_ratio * s * s), sheared = gamma * s * c;
      largest = std::max(largest, phase == 0 ? std::abs(axial + sheared) : std::hypot(axial, sheared));
    }
    return largest;
  };
  CHECK(grid(pi / 2) == Approx(eps).epsilon(rounding));
  constexpr double fine_planes = 1e-6;
  const double together = eps * ((1 - m.poisson_ratio) + std::sqrt(2) * (1 + m.poisson_ratio)) / 2;
  CHECK(grid(0) == Approx(together).epsilon(fine_planes));
  const CriticalPlane in_phase =
      critical_plane(swing(eps, 0), swing(gamma, 0), m, {}, 16);  // 22.5 deg is one of these planes
  CHECK(in_phase.theta == Approx(pi / 8).epsilon(rounding));
  CHECK(in_phase.damage == Approx(damage_of_history(swing(together, 0), m)).epsilon(rounding));
}

TEST_CASE("critical plane: by tables as exactly") {
  auto m = copper();
  m.poisson_ratio = 0.34;
  const DamageCounter counter(m, {});
  DamageCounter::Workspace workspace;
  constexpr double single = 2e-6;  // reversals in single precision, times the slope of the life curve
  for (const double phase : {0.0, 0.4, pi / 2}) {
    const auto strain = swing(0.004, 0.1), shear = swing(0.007, phase);
    const CriticalPlane exact = critical_plane(strain, shear, m, {});
    const CriticalPlane counted = critical_plane(strain, shear, m.poisson_ratio, counter, workspace);
    CHECK(counted.theta == exact.theta);
    CHECK(counted.damage == Approx(exact.damage).epsilon(DamageCounter::table_error + single));
  }
}
