// The force of a cable from its strain: closed forms of one wire, and the thesis' cable by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strain/cable_force.h"

using namespace dresslife;
using strain::CableForce;

namespace {

constexpr double pi = std::numbers::pi;

pipeline::Dresspack copper_only() {
  pipeline::Dresspack dresspack;
  pipeline::Material copper;
  copper.name = "copper";
  copper.youngs_modulus = 117e9;
  copper.fatigue_strength = 983e6;
  copper.fatigue_strength_exponent = -0.112;
  copper.fatigue_ductility = 2.43;
  copper.fatigue_ductility_exponent = -0.6;
  copper.tensile_strength = 230e6;
  dresspack.materials.push_back(copper);
  return dresspack;
}

pipeline::Component wires(int count, double lay_degrees = 0) {
  pipeline::Component wire;
  wire.name = "wire";
  wire.material = "copper";
  wire.count = count;
  wire.radius = 75e-6;
  wire.helix_radius = 0.5e-3;
  wire.lay_angle = lay_degrees * pi / 180;
  return wire;
}

pipeline::Component cable(std::vector<pipeline::Component> parts) {
  pipeline::Component cable;
  cable.name = "cable";
  cable.radius = 5.3e-3;
  cable.components = std::move(parts);
  return cable;
}

/// Seven conductors of 92 wires, as in table 1 of the thesis.
pipeline::Component signal_cable() {
  pipeline::Component conductor = cable({wires(92, 5)});
  conductor.name = "conductor";
  conductor.count = 7;
  conductor.radius = 1.175e-3;
  conductor.helix_radius = 2.825e-3;
  conductor.lay_angle = 25 * pi / 180;
  return cable({conductor});
}

}  // namespace

TEST_CASE("a straight wire pulls as its cyclic curve says, and back") {
  const CableForce force(copper_only(), cable({wires(1)}));
  const double area = pi * 75e-6 * 75e-6, hardening = 0.112 / 0.6, K = 983e6 / std::pow(2.43, hardening);
  for (const double sigma : {1e6, 50e6, 150e6, 300e6, 500e6}) {
    const double strain = sigma / 117e9 + std::pow(sigma / K, 1 / hardening);
    CHECK(force.force(strain) == Approx(area * sigma).epsilon(1e-10));  // rounding of powers
    CHECK(force.force(-strain) == Approx(-area * sigma).epsilon(1e-10));
    CHECK(force.strain_at(area * sigma) == Approx(strain).epsilon(1e-9));
  }
  CHECK(force.axial_stiffness() == Approx(area * 117e9));
  CHECK(force.strength() == Approx(area * 230e6));
}

TEST_CASE("the thesis' cable tears at 2.4 kN, and a strain of 1.2 .. 2 % would take 3.4 .. 3.8 kN") {
  const CableForce force(copper_only(), signal_cable());
  const double area = 7 * 92 * pi * 75e-6 * 75e-6;  // 11.4 mm2
  const double cosines = std::cos(25 * pi / 180) * std::cos(5 * pi / 180);
  CHECK(force.strength() == Approx(area * 230e6 * cosines));
  CHECK(force.axial_stiffness() == Approx(area * 117e9 * std::pow(cosines, 3)));
  // wires have cos^2 of the cable's strain, and the stress of their curve there
  const double hardening = 0.112 / 0.6, K = 983e6 / std::pow(2.43, hardening);
  for (const double strain : {0.012, 0.02}) {
    const double sigma = force.force(strain) / (area * cosines);
    CHECK(sigma / 117e9 + std::pow(sigma / K, 1 / hardening) == Approx(cosines * cosines * strain));
    CHECK(force.force(strain) > 1.3 * force.strength());
  }
  CHECK(force.force(0.012) == Approx(3.4e3).epsilon(0.05));
  CHECK(force.force(0.02) == Approx(3.8e3).epsilon(0.05));
}

TEST_CASE("a strength that one material lacks is not known") {
  pipeline::Dresspack dresspack = copper_only();
  dresspack.materials[0].tensile_strength.reset();
  CHECK(CableForce(dresspack, signal_cable()).strength() == 0);
}
