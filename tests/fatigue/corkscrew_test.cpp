// Corkscrew against closed forms for rods with compression, tension, twist and a wall.
#include "fatigue/corkscrew.h"

#include <cmath>
#include <numbers>

#include "tests/catch.h"

namespace dresslife::fatigue {
namespace {

using std::numbers::pi;

BoredCable cable() { return {0.03, 0.02, 5e-3, 20, 2}; }

/// Returns (F33) as the minimum over many wave numbers.
double least_torque(const BoredCable& of, double compression, double curvature) {
  const double k = std::abs(compression) * curvature / of.room;
  double least = 1e9;
  for (double q = 2 * pi / of.length; q < 1e3; q *= 1.0001)
    least = std::min(least, of.bending * q + k / (q * q * q) - compression / q);
  return least;
}

}  // namespace

TEST_CASE("corkscrew: twist alone coils a cable at Greenhill's torque, compression alone at Euler's force") {
  const BoredCable of = cable();
  CHECK(of.torque_to_coil(0, 0) == Approx(2 * pi * of.bending / of.length));
  const double euler = 4 * pi * pi * of.bending / (of.length * of.length), rounding = 1e-12;
  CHECK(of.torque_to_coil(euler, 0) == Approx(0).margin(rounding));
}

TEST_CASE(
    "corkscrew: a long cable under tension coils at 2 sqrt(E I T), one pressed into a bend at Dawson and Paslay's force") {
  BoredCable of = cable();
  CHECK(of.torque_to_coil(-7, 0) == Approx(2 * std::sqrt(of.bending * 7)));
  of.length = 100;
  // P = 2 sqrt(E I P kappa / r) at P = 4 E I kappa / r
  const double kappa = 1.5, force = 4 * of.bending * kappa / of.room;
  const double small = 1e-9 * std::sqrt(of.bending * force);  // rounding relative to its terms
  CHECK(of.torque_to_coil(force, kappa) == Approx(0).margin(small));
  CHECK(of.torque_to_coil(0.99 * force, kappa) > small);
}

TEST_CASE("corkscrew: the closed form is the least torque of all wave numbers") {
  const double steps = 1e-6;  // step of the tried wave numbers, squared, and rounding
  for (const double compression : {-20.0, -0.5, 0.0, 0.2, 3.0})
    for (const double curvature : {0.0, 0.3, 4.0})
      CHECK(cable().torque_to_coil(compression, curvature) ==
            Approx(least_torque(cable(), compression, curvature)).epsilon(steps).margin(steps));
}

TEST_CASE("corkscrew: compression alone makes a helix of curvature r P / (2 E I), which is tight at its limit") {
  const BoredCable of = cable();
  const double force = 2 * of.bending * of.tightest / of.room, rounding = 1e-12;
  CHECK(of.torque_to_tighten(force) == Approx(0).margin(rounding));
}

TEST_CASE(
    "corkscrew: the helix of least energy under compression and torque has the limit's curvature at the critical torque") {
  const BoredCable of = cable();
  const double compression = 40, torque = of.torque_to_tighten(compression);
  REQUIRE(torque > 0);
  const auto energy = [&](double q) { return ((of.bending * q - torque) * q - compression) * q * q; };
  double best = 1;
  constexpr double step = 1.00001;
  for (double q = 1; q < 1e3; q *= step)
    if (energy(q) < energy(best)) best = q;
  CHECK(of.room * best * best == Approx(of.tightest).epsilon(2 * (step - 1)));
}

TEST_CASE("corkscrew: the margin is the factor on forces and twist that reaches the critical torque") {
  const BoredCable of = cable();
  for (const double compression : {-5.0, 0.0, 5.0}) {
    const double torque = 0.2, curvature = 0.5, margin = of.margin(compression, torque, curvature);
    CHECK(margin * torque == Approx(of.critical_torque(margin * compression, curvature)));
  }
  CHECK(of.margin(0, 0, 1) == BoredCable::largest_margin);
  CHECK(of.margin(-5, 0, 1) == BoredCable::largest_margin);
}

}  // namespace dresslife::fatigue
