// Loose cables against closed forms.
#include <cmath>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/strain/loose/hoses.h"

using namespace dresslife;
using namespace dresslife::strain;
using dresslife::strain::test::hose;
using dresslife::strain::test::signal_cable;

namespace {

constexpr double step = 0.04;  // between samples [s]

double largest_offset(const CableState& state, int direction) {
  double largest = 0;
  for (std::size_t p = direction; p < state.offset.size(); p += 2)
    largest = std::max(largest, std::abs(state.offset[p]));
  return largest;
}

}  // namespace

TEST_CASE("without play a loose cable has the strain of one that is held") {
  // Clamp to clamp, under any bend and twist: mean of |v| of (W5).
  LooseCable cable = signal_cable(0.012, -0.014);
  cable.play = 0;
  cable.wall_stiffness = 1e11;  // a contact force of 30 kN/m compresses it by 0.3 um
  const LooseSettings settings{2, 128};
  LooseCables cables({cable}, settings);
  const auto at = [](double z) {
    return HoseNode{3 * std::sin(2 * pi * z) + 1, 2 * std::cos(5 * z), 3 + 4 * z, 1e-3 * z, {0, -9.81}};
  };
  cables.advance(hose(128, at), step);
  double path = 0;
  constexpr int fine = 100000;
  for (int k = 0; k < fine; ++k) {
    const HoseNode node = at((k + 0.5) / fine);
    const double y = 1 + node.elongation + node.curvature1 * -0.014 - node.curvature2 * 0.012;
    path += std::sqrt(y * y + std::pow(std::hypot(0.012, -0.014) * node.twist, 2)) / fine;
  }
  // The model uses |a'|^2 / 2 instead of the root. This neglects |a'|^2 / 2 times the bending strain, 1e-3 of 1e-2.
  CHECK(cables.state(0).strain == Approx(path - 1).epsilon(0.01));
  CHECK(largest_offset(cables.state(0), 0) < 1e-6);
}

TEST_CASE("a cable has no strain in the shape in which it was mounted, bent or not") {
  for (const double lay : {-10.0, 0.5, 20.0})
    for (const double rest : {0.0, 0.8}) {
      LooseCable cable = signal_cable(0.01845 * std::cos(0.3), 0.01845 * std::sin(0.3));
      cable.lay_rate = std::tan(lay * pi / 180) / 0.01845;
      cable.play = 0.004;
      LooseCables cables({cable}, {2, 128, rest});
      cables.advance(hose(128, [&](double) { return HoseNode{.curvature2 = rest}; }), step);
      const CableState& state = cables.state(0);
      CHECK(std::abs(state.strain) < 1e-9);
      CHECK(std::max(largest_offset(state, 0), largest_offset(state, 1)) < 1e-9);
      for (std::size_t i = 0; i <= 128; ++i)  // curvatures that the levels inside the cable get
        CHECK(std::hypot(state.curvature[2 * i], state.curvature[2 * i + 1] - rest) < 1e-6);
    }
}

TEST_CASE("twist along the lay stretches a cable without play, twist against it relaxes the cable") {
  constexpr double radius = 0.01845, lay = 8 * pi / 180;
  LooseCable cable = signal_cable(radius);
  cable.lay_rate = std::tan(lay) / radius;
  cable.play = 0;
  cable.wall_stiffness = 1e11;
  const LooseSettings settings{2, 256};
  for (const double twist : {1.5, -1.5}) {
    LooseCables cables({cable}, settings);
    cables.advance(hose(256, [&](double) { return HoseNode{.twist = twist}; }), step);
    const double path = std::hypot(1, radius * (cable.lay_rate + twist)) * std::cos(lay);
    // The model uses |a'|^2 / 2 instead of the root. This neglects 1/4 of |a'|^4, which is tan^2(lay) / 2 of the change: 1 %.
    CHECK(cables.state(0).strain == Approx(path - 1).epsilon(0.012));
  }
}

TEST_CASE("a bend of many pitches leaves a laid cable as long as it is, and moves its wires by the bend alone") {
  LooseCable cable = signal_cable(0.01845);
  cable.lay_rate = 8 * 2 * pi / 2;  // eight turns in 2 m
  cable.play = 0;
  cable.wall_stiffness = 1e11;
  LooseCables cables({cable}, {2, 256});
  cables.advance(hose(256, [](double) { return HoseNode{.curvature2 = 1}; }), step);
  CHECK(std::abs(cables.state(0).strain) < 1e-3 * 0.01845);
}

TEST_CASE("a cable on the outside of a bend moves in by its play and pulls for the rest") {
  LooseCable cable = signal_cable(-0.01845);
  cable.play = 0.005;
  cable.wall_stiffness = 1e9;
  LooseCables cables({cable}, {2.035, 128});
  cables.advance(hose(128, [](double) { return HoseNode{.curvature2 = 1}; }), step);
  // From a clamp the cable runs straight, seen from the side, until it touches after sqrt(2 c / kappa). Each of the two ends
  // is longer by kappa^2 (2 c / kappa)^1.5 / 3. The bending stiffness rounds this off by 0.1 %.
  const double ends = 2.0 / 3 * std::pow(2 * 0.005, 1.5) / 2.035;
  CHECK(cables.state(0).strain == Approx((0.01845 - 0.005) * 1 + ends).epsilon(0.002));
}

TEST_CASE("a cable pressed together in a straight tube lies in it as a helix") {
  // slope^2 / 2 = delta for a helix of radius c. Its energy E I k^4 c^2 / 2 per length gives the force 4 E I delta / c^2.
  LooseCable cable = signal_cable(0);
  cable.play = 0.004;
  cable.wall_stiffness = 1e9;
  cable.axial_stiffness = 1e8;            // so stiff that all of the shortening goes into the helix
  constexpr std::size_t elements = 1536;  // 16 in a wave: 0.7 %; the ends: 1.2 %
  LooseCables cables({cable}, {12, elements});
  constexpr double most = 0.02;
  for (int t = 1; t <= 200; ++t) {
    // The weight turns along the tube while the cable buckles. This gives one helix instead of two.
    const double weight = t < 30 ? 5 : 0;
    cables.advance(hose(elements,
                        [&](double z) {
                          return HoseNode{.elongation = -most * t / 200,
                                          .pull = {weight * std::cos(300 * z), weight * std::sin(300 * z)}};
                        }),
                   step);
  }
  CHECK(-cables.state(0).tension[0] == Approx(4 * 0.2 * most / std::pow(0.004, 2)).epsilon(0.02));
}

TEST_CASE("a cable tied to an elastic wall buckles at the root of its stiffnesses") {
  LooseCable cable = signal_cable(0);
  cable.play = 0;  // springs in every direction
  cable.wall_stiffness = 1e8;
  cable.axial_stiffness = 1e7;
  constexpr std::size_t elements = 512;  // waves of 42 mm
  LooseCables cables({cable}, {1.6, elements});
  double highest = 0;
  for (int t = 1; t <= 200; ++t) {
    cables.advance(hose(elements,
                        [&](double z) {
                          return HoseNode{.elongation = -2e-3 * t / 200, .pull = {std::sin(230 * z), 0}};
                        }),
                   step);
    highest = std::max(highest, -cables.state(0).tension[0]);
  }
  // The clamps hold the outermost waves, so the tied cable carries a little more than the formula.
  CHECK(highest == Approx(2 * std::sqrt(0.2 * 1e8)).epsilon(0.05));
}

TEST_CASE("a cable lying in a straight tube goes in waves, then in coils") {
  // Waves begin at 2 sqrt(E I w / c) (Dawson and Paslay 1984). From sqrt(2) times that force on a coil has less energy than
  // waves (Chen, Lin and Cheatham 1990). A cable under slowly rising force changes to a coil later, and under slowly falling
  // force it changes back earlier.
  LooseCable cable = signal_cable(0);
  cable.play = 0.005;
  cable.wall_stiffness = 1e8;
  cable.drag = 0.3;
  const double weight = 0.19 * 9.81, waves = 2 * std::sqrt(0.2 * weight / 0.005);
  constexpr std::size_t elements = 512;
  LooseCables cables({cable}, {12, elements});
  const auto pressed = [&](double shortened) {
    cables.advance(hose(elements,
                        [&](double z) {
                          return HoseNode{.elongation = -shortened, .pull = {0.002 * std::sin(97 * z), -9.81}};
                        }),
                   step);
    return -cables.state(0).tension[0];
  };
  const auto highest = [&] {
    double height = -1;  // away from the clamps, which hold the cable in the middle
    for (std::size_t i = elements / 8; i < 7 * elements / 8; ++i)
      height = std::max(height, cables.state(0).offset[2 * i + 1]);
    return height;
  };
  double shortened = 0, at_waves = 0, at_coils = 0, at_fall = 0;
  for (; at_coils == 0 && shortened < 3e-3; shortened += 8e-7) {
    const double force = pressed(shortened);
    if (at_waves == 0 && largest_offset(cables.state(0), 0) > 0.1 * 0.005) at_waves = force;
    if (highest() > 0.9 * 0.005) at_coils = force;
  }
  for (int t = 0; t < 100; ++t) pressed(shortened);
  for (; at_fall == 0 && shortened > 0; shortened -= 8e-7) {
    const double force = pressed(shortened);
    if (highest() < 0) at_fall = force;
  }
  INFO(waves << " N: waves at " << at_waves << ", coils at " << at_coils << ", down at " << at_fall);
  CHECK(at_waves == Approx(waves).epsilon(0.05));  // the criterion, a tenth of the play, is reached a little later
  CHECK(at_coils > std::sqrt(2) * waves);
  CHECK(at_fall < std::sqrt(2) * waves);
  CHECK(at_fall == Approx(std::sqrt(2) * waves).epsilon(0.1));  // the weight pulls its ends down first
}

TEST_CASE("a cable that is pulled bends at its clamp as a beam does, on any mesh") {
  // In a bend without walls the cable is straight and turns at the clamps by half of the bend's angle, as a beam with tension T:
  //     its curvature at the clamp = K L / (2 l tanh(L / 2 l)), l = sqrt(E I / T).
  LooseCable cable = signal_cable(0);
  cable.bending_stiffness = 0.03;
  constexpr double bend = 0.1, length = 2;  // [1/m], [m]
  for (const double elongation : {1e-4, 1e-3, 3e-3})
    for (const std::size_t elements : {128, 256, 512}) {
      LooseCables cables({cable}, {length, elements});
      for (int k = 0; k < 200; ++k)  // until the drag has let it come to equilibrium
        cables.advance(hose(elements, [&](double) { return HoseNode{.curvature2 = bend, .elongation = elongation}; }),
                       10);
      const CableState& state = cables.state(0);
      REQUIRE(state.tension.front() > 0);
      const double decay = std::sqrt(cable.bending_stiffness / state.tension.front()),
                   spacing = length / double(elements);
      const double exact = bend * length / (2 * decay * std::tanh(length / (2 * decay)));
      INFO("T " << state.tension.front() << " N, " << elements << " pieces of " << spacing / decay << " decay lengths");
      const double raw = state.curvature[1], left = state.clamped[1];
      // A cable that is straight between the clamps has no slowly varying curvature, so only the curvature at rest is left out.
      CHECK(left == Approx(exact).epsilon(0.001));
      CHECK(state.clamped[3] == Approx(exact).epsilon(0.001));
      CHECK(raw == Approx(exact / std::sqrt(1 + std::pow(spacing / decay, 2) / 4)).epsilon(0.001));
    }
}
