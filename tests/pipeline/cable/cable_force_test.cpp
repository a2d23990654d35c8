// The force of a cable from its strain: closed forms of one wire, and the thesis' cable calculated by hand.
#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/cable/cable_pulls.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using pipeline::CableForce;

namespace {

pipeline::Dresspack copper_only() {
  pipeline::Dresspack dresspack;
  dresspack.materials = {test_dresspacks::copper()};
  return dresspack;
}

const pipeline::Component signal_cable = test_dresspacks::thesis_dresspack().components[0];

}  // namespace

TEST_CASE("a straight wire pulls as its cyclic curve says, and back") {
  pipeline::Component one_wire = test_dresspacks::part("cable", 1, 5.3e-3, 0, 0);
  one_wire.components = {test_dresspacks::wires("", 1, 75e-6, 0.5e-3, 0, pipeline::Hand::right)};
  const CableForce force(copper_only(), one_wire);
  const double area = pi * 75e-6 * 75e-6, hardening = 0.112 / 0.6, K = 983e6 / std::pow(2.43, hardening);
  for (const double sigma : {1e6, 50e6, 150e6, 300e6, 500e6}) {
    const double strain = sigma / 117e9 + std::pow(sigma / K, 1 / hardening);
    CHECK(force.force(strain) == Approx(area * sigma).epsilon(1e-10));  // rounding of powers
    CHECK(force.force(-strain) == Approx(-area * sigma).epsilon(1e-10));
    CHECK(force.strain_at(area * sigma) == Approx(strain).epsilon(1e-9));
  }
  CHECK(force.force(1e-9) == Approx(1e-9 * area * 117e9));
  CHECK(force.strength() == Approx(area * 230e6));
}

TEST_CASE("the thesis' cable tears at 2.4 kN, and a strain of 1.2 .. 2 % would take 3.4 .. 3.8 kN") {
  const CableForce force(copper_only(), signal_cable);
  const double area = 7 * 92 * pi * 75e-6 * 75e-6;  // 11.4 mm2
  const double cosines = std::cos(25 * pi / 180) * std::cos(5 * pi / 180);
  CHECK(force.strength() == Approx(area * 230e6 * cosines));
  CHECK(force.force(1e-9) == Approx(1e-9 * area * 117e9 * std::pow(cosines, 3)));
  // Wires have cos^2 of the cable's strain, and the stress of their curve at that strain.
  const double hardening = 0.112 / 0.6, K = 983e6 / std::pow(2.43, hardening);
  for (const double strain : {0.012, 0.02}) {
    const double sigma = force.force(strain) / (area * cosines);
    CHECK(sigma / 117e9 + std::pow(sigma / K, 1 / hardening) == Approx(cosines * cosines * strain));
    CHECK(force.force(strain) > 1.3 * force.strength());
  }
  CHECK(force.force(0.012) == Approx(3.4e3).epsilon(0.05));
  CHECK(force.force(0.02) == Approx(3.8e3).epsilon(0.05));
}

TEST_CASE(
    "a loose cable's own stiffness is what was measured, else its wires' with their friction in the polymer that is "
    "given or guessed") {
  pipeline::Component cable = signal_cable;
  const double wires = pipeline::CableBending(copper_only(), cable).moment(1, 1);
  CHECK(wires == Approx(644 * 117e9 * pi / 4 * std::pow(75e-6, 4) * std::cos(5 * pi / 180)).epsilon(0.05));
  const double round = 10e6 * pi / 4 * std::pow(5.3e-3, 4);
  CHECK(CableForce(copper_only(), cable).bending_stiffness() == Approx(wires + round));
  cable.polymer_bending_stiffness = 0.02;
  CHECK(CableForce(copper_only(), cable).bending_stiffness() == Approx(wires + 0.02));
  cable.measured_bending_stiffness = 0.2;
  CHECK(CableForce(copper_only(), cable).bending_stiffness() == 0.2);
  // Wires of 11.4 mm2 use 12.6 of the section's 88.2 mm2, because they cross it at an angle: 0.112 kg/m of copper and 0.091
  // of polymer.
  CHECK(CableForce(copper_only(), cable).mass_per_length() == Approx(0.203).margin(0.0005));
}

TEST_CASE("a strength that one material lacks is not known") {
  pipeline::Dresspack dresspack = copper_only();
  dresspack.materials[0].tensile_strength.reset();
  CHECK(CableForce(dresspack, signal_cable).strength() == 0);
}

TEST_CASE("cables pull at both clamps with the moment of their forces about the hose's axis") {
  pipeline::Component wire = test_dresspacks::part("cable", 1, 5.3e-3, 0, 0);
  wire.components = {test_dresspacks::wires("", 1, 75e-6, 0.5e-3, 0, pipeline::Hand::right)};
  const CableForce force(copper_only(), wire);
  const std::array<std::vector<double>, 3> strain{{{1e-4, -3e-3, 2e-4}, {1e-4, -2e-3, 1e-4}, {-5e-5, -1e-3, 2e-4}}},
      other{{{2e-4, 1e-4, 4e-3}, {2e-4, 1e-4, 1e-3}, {1e-4, 1e-5, 3e-3}}};
  const std::vector<pipeline::PulledCable> cables{{force, strain, {{{0.01, 0.002}, {-0.004, 0.007}}}},
                                                  {force, other, {{{-0.01, 0.005}, {0.003, 0.008}}}}};
  const pipeline::CablePulls pulls = pulls_of(cables, 3);
  for (std::size_t t = 0; t < 3; ++t) {
    double largest = 0;
    for (std::size_t clamp = 0; clamp < 2; ++clamp) {
      double about1 = 0, about2 = 0;
      for (const pipeline::PulledCable& cable : cables) {
        about1 += cable.place[clamp][1] * force.force(cable.strain[clamp + 1][t]);
        about2 -= cable.place[clamp][0] * force.force(cable.strain[clamp + 1][t]);
      }
      largest = std::max(largest, std::hypot(about1, about2));
    }
    CHECK(pulls.moment[t] == Approx(largest));
    CHECK(pulls.tension[0][t] == Approx(force.force(strain[0][t])));
    CHECK(pulls.tension[1][t] == Approx(force.force(other[0][t])));
  }
  CHECK(pulls.force_share == Approx(force.force(4e-3) / force.strength()));
  CHECK(pulls.of_cable == 1);
  CHECK(pulls.at_sample == 2);
  const pipeline::CablePulls first = pulls_of(std::span(cables).first(1), 3);
  CHECK(first.force_share == Approx(force.force(3e-3) / force.strength()));  // a compression counts by its magnitude
  CHECK(first.at_sample == 1);
  const double most = *std::max_element(pulls.moment.begin(), pulls.moment.end());
  CHECK(pipeline::moment_share(pulls, std::vector<double>{0.1, 0.5, 0.2}) == Approx(most / 0.5));
  CHECK(pipeline::moment_share(pulls, std::vector<double>{0, 0, 0}) == 0);
  CHECK(pipeline::moment_share({}, std::vector<double>{1}) == 0);
}
