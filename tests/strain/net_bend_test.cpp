// The strain of incomplete turns: against the mean of the exact kinematics from clamp to clamp, and closed forms.
#include "strain/net_bend.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "strain/clamp_means.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;

namespace {

constexpr double length = 1, helix_radius = 0.003, wire_radius = 1e-4;
constexpr std::size_t segments = 80, samples = 64;

/// Returns a cable of six wires with this lay length, alone or as the conductor of a straight cable.
Dresspack with_lay(double lay, Hand hand = Hand::right) {
  const double angle = std::atan(2 * pi * helix_radius / lay) / degree;
  Dresspack dresspack;
  dresspack.components = {wires("", 6, wire_radius, helix_radius, angle, hand)};
  dresspack.materials = {copper()};
  return dresspack;
}

struct Rod {
  std::vector<double> lengths = std::vector<double>(segments, length / segments), arcs;
  DeformationHistory history{segments, samples};
  Rod(const auto& curvature) {
    for (std::size_t i = 0; i < segments; ++i) {
      arcs.push_back((static_cast<double>(i) + 0.5) * length / segments);
      for (std::size_t t = 0; t < samples; ++t) {
        const std::array<double, 2> bend = curvature(arcs[i], static_cast<double>(t) / (samples - 1));
        history.set(i, t, {bend[0], bend[1], 0, 0});
      }
    }
  }
  NetBend::Largest net(const Dresspack& dresspack) const {
    const Construction construction(dresspack, Kinematics::exact);
    NetBend net(construction, plan_slip(construction, {Slip::free}, length), lengths, arcs, length);
    net.add(history);
    return net.largest();
  }
  /// Returns the largest range of the mean strain from clamp to clamp, by the exact kinematics.
  double clamped_range(const Dresspack& dresspack) const {
    const Construction construction(dresspack, Kinematics::exact);
    std::vector<LayerSlip> plan = plan_slip(construction, {Slip::free}, length);
    plan[0].sliding = Sliding::clamp_to_clamp;
    ClampMeans means(construction, plan, lengths, arcs, samples);
    for (std::size_t i = 0; i < segments; ++i) means.add(0, i, {samples, history.columns(i)});
    means.end_round(0);
    means.next_block();
    double most = 0;
    for (int k = 0; k < 64; ++k) {
      const std::vector<double> strain = means.at_angle(dresspack_itself, 0, 2 * pi * k / 64);
      const auto [low, high] = std::minmax_element(strain.begin(), strain.begin() + samples);
      most = std::max(most, *high - *low);
    }
    return most;
  }
};

}  // namespace

TEST_CASE("incomplete turns strain a helix as its path from clamp to clamp does") {
  // A bend that rolls along the cable while its plane turns. Eight directions miss at most 2 % of a range. Strains are so small that
  // terms of second order, (R kappa)^2, are below 1e-3 of them.
  const Rod rod([](double arc, double time) {
    const double from = 0.1 + 0.5 * time, bend = arc > from && arc < from + 0.25 ? 0.2 : 0;
    return std::array{bend * std::cos(time), bend * std::sin(time)};
  });
  for (const double lay : {0.03, 0.07, 0.11, 0.2})
    for (const Hand hand : {Hand::right, Hand::left}) {
      INFO("lay " << lay);
      const Dresspack dresspack = with_lay(lay, hand);
      const double exact = rod.clamped_range(dresspack), net = rod.net(dresspack).strain;
      CHECK(net < 1.002 * exact);
      CHECK(net > 0.979 * exact);
    }
}

TEST_CASE("an even bend strains a helix by its incomplete turn, and whole turns not at all") {
  const double kappa = 2;
  const Rod rod([&](double, double time) { return std::array{0.0, kappa * time}; });
  const auto closed_form = [&](double lay) {
    const double turn = 2 * pi / lay, cosine2 = 1 / (1 + std::pow(turn * helix_radius, 2));
    return helix_radius * cosine2 * kappa * std::abs(2 * std::sin(turn * length / 2) / (turn * length));
  };
  for (const double lay : {0.1, 1 / 7.5, 0.15, 0.24}) {
    const NetBend::Largest net = rod.net(with_lay(lay));
    INFO("lay " << lay);
    REQUIRE(net.layer == 0);
    CHECK_THAT(net.lay, Catch::WithinRel(lay, 1e-9));
    CHECK_THAT(net.own, Catch::WithinRel(wire_radius * kappa, 1e-9));
    CHECK(net.strain <= closed_form(lay) + 1e-12);
    CHECK(net.strain >= 0.98 * closed_form(lay));
  }
  CHECK(rod.net(with_lay(0.1)).strain < 1e-9);
}

TEST_CASE("a layer with fewer than four turns has its incomplete turn in its mean, and a straight one has no turns") {
  const Rod rod([](double, double time) { return std::array{0.0, time}; });
  CHECK(rod.net(with_lay(0.26)).layer == -1);
  Dresspack straight;
  straight.components = {wires("", 6, wire_radius, helix_radius, 0, Hand::right)};
  CHECK(rod.net(straight).layer == -1);
}

TEST_CASE("friction of a helix with few turns gathers over its own wave, as with many") {
  // Three turns and five turns of equal lay in cables of two lengths: a quarter of the wave carries the friction.
  Dresspack dresspack = with_lay(0.15);
  dresspack.components[0].friction = 0.3;
  dresspack.components[0].radial_line_load = 100;
  const Construction construction(dresspack, Kinematics::exact);
  const LayerSlip few = plan_slip(construction, {Slip::friction}, 3 * 0.15)[0];
  const LayerSlip many = plan_slip(construction, {Slip::friction}, 5 * 0.15)[0];
  CHECK(few.sliding == Sliding::clamp_to_clamp);
  CHECK(many.sliding == Sliding::over_pitch);
  CHECK_THAT(few.cap.constant, Catch::WithinRel(many.cap.constant, 1e-12));
  CHECK_THAT(few.evening, Catch::WithinRel(many.evening, 1e-12));
}
