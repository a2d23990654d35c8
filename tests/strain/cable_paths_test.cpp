// Cables between two clamps: what is held against what (W10) says, loose ones without play against those, the
// onset of tension with slack, lays from straight to steep, memory, forces and moments.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strain/cable_paths.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife::strain;
using dresslife::pipeline::Dresspack;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Position;
using dresslife::pipeline::Slip;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double length = 2;
constexpr std::size_t segments = 64;

/// What a measured stiffness needs to be explained by.
void rub(std::vector<dresslife::pipeline::Component>& parts) {
  for (dresslife::pipeline::Component& part : parts) {
    part.friction = 0.3;
    part.radial_line_load = 20;
    rub(part.components);
  }
}

Dresspack thesis_hose() {
  Dresspack dresspack = test_dresspacks::thesis_dresspack();
  dresspack.bending_stiffness = 25;
  dresspack.inner_diameter = 0.051;
  dresspack.core_diameter = 0.026;
  dresspack.materials = {test_dresspacks::copper()};
  rub(dresspack.components[0].components);
  dresspack.components[0].measured_bending_stiffness = 0.2;
  return dresspack;
}

/// Swings from one side to the other with some twist: a hose on a wrist. turn: of its cycle.
Deformation swing(double z, double turn) {
  const double w = 2 * pi * turn;
  return {(0.8 + 0.4 * std::sin(w)) * std::sin(pi * z), 0.5 * std::cos(w) * std::cos(pi * z / 2),
          0.4 * std::sin(w), 1e-4 * std::cos(w)};
}

Deformation operator*(double size, const Deformation& d) {
  return {size * d.curvature1, size * d.curvature2, size * d.twist, size * d.elongation};
}

struct Run {
  Construction construction;
  std::vector<double> lengths, arcs;
  DeformationHistory history;
  CablePaths paths;

  Run(const Dresspack& dresspack, Slip slip, std::size_t samples, std::size_t cycle, double size = 1)
      : construction(dresspack, Kinematics::exact),
        lengths(segments, length / segments),
        arcs(centres()),
        history(segments, samples),
        paths(construction, plan_slip(construction, {slip, Slip::free}, length), slip == Slip::friction,
              lengths, arcs, samples) {
    for (std::size_t t = 0; t < samples; ++t)
      for (std::size_t i = 0; i < segments; ++i)
        history.set(i, t, size * swing(arcs[i] / length, static_cast<double>(t) / static_cast<double>(cycle)));
    paths.add({history});
    paths.finish();
  }
  static std::vector<double> centres() {
    std::vector<double> arcs;
    for (std::size_t i = 0; i < segments; ++i) arcs.push_back((static_cast<double>(i) + 0.5) * length / segments);
    return arcs;
  }
  double strain(std::size_t cable, std::size_t segment, std::size_t sample) {
    CablePaths::Keeper keeper;
    return keeper.of(paths, segment, history.columns(segment), 0, history.samples()).strain[cable][sample];
  }
  double largest_tension() {
    double most = 0;
    for (std::size_t k = 0; k < paths.cables(); ++k)
      for (const double force : paths.tension(k)) most = std::max(most, force);
    return most;
  }
};

Dresspack held_hose() {
  Dresspack dresspack = thesis_hose();
  dresspack.components[0].laying.position = Position::held;
  return dresspack;
}

}  // namespace

TEST_CASE("a held cable has the mean stretch of its place, less its slack") {
  Dresspack dresspack = held_hose();
  for (const double slack : {0.0, 0.5}) {
    dresspack.components[0].laying.slack = slack;
    Run run(dresspack, Slip::free, 5, 20);
    for (std::size_t k = 0; k < 10; ++k)
      for (std::size_t t = 0; t < 5; ++t) {
        double path = 0;
        const double theta = 2 * pi * static_cast<double>(k) / 10, R = 0.01845;
        for (std::size_t i = 0; i < segments; ++i) {
          const Deformation d = swing(run.arcs[i] / length, static_cast<double>(t) / 20);
          const double y =
              1 + d.elongation + R * (d.curvature1 * std::sin(theta) - d.curvature2 * std::cos(theta));
          path += std::hypot(y, R * d.twist) / segments;
        }
        CHECK(run.strain(k, 17, t) == Approx(path / (1 + slack / 100) - 1).margin(1e-12));
      }
  }
}

TEST_CASE("a loose cable with next to no play has the strain of a held one") {
  Dresspack dresspack = thesis_hose();
  dresspack.components[0].laying.play = 1e-5;
  // A tenth of the swing: pressed cables stay below 2 sqrt(E I k_w) = 2.8 kN, where they would buckle into a wall
  // of 1e7 N/m2, and pulled ones press into it by 1.3 kN x 0.12 1/m, 16 um, of 18.45 mm as the 10 um of play.
  constexpr double size = 0.1;
  Run loose(dresspack, Slip::free, 10, 20, size), held(held_hose(), Slip::free, 10, 20, size);
  double largest = 0;
  for (std::size_t k = 0; k < 10; ++k)
    for (std::size_t t = 0; t < 10; ++t) largest = std::max(largest, std::abs(held.strain(k, 0, t)));
  REQUIRE(largest > 1e-3);
  for (std::size_t k = 0; k < 10; ++k)
    for (std::size_t t = 0; t < 10; ++t)
      CHECK(loose.strain(k, 3, t) == Approx(held.strain(k, 3, t)).margin(0.01 * largest));
}

TEST_CASE("tension begins where slack no longer covers what turning asks less what play gives") {
  // s* = max over time and cables of (R e . net turning - c x turning of either sign) / L, for one plane bend
  // without twist both turnings are the same: (R - c) kappa.
  Dresspack dresspack = thesis_hose();
  const double c = 5e-3, kappa = 0.8;
  dresspack.components[0].laying.play = c;
  const auto tension = [&](double slack_percent) {
    dresspack.components[0].laying.slack = slack_percent;
    const Construction construction(dresspack, Kinematics::exact);
    DeformationHistory history(segments, 40);
    for (std::size_t t = 0; t < 40; ++t)  // slowly, so that it is at rest all the way
      for (std::size_t i = 0; i < segments; ++i)
        history.set(i, t, {kappa * std::min(1.0, static_cast<double>(t) / 30), 0, 0, 0});
    CablePaths paths(construction, plan_slip(construction, {Slip::free}, length), false,
                     std::vector<double>(segments, length / segments), Run::centres(), 40);
    paths.add({history});
    paths.finish();
    double most = 0;
    for (std::size_t k = 0; k < 10; ++k) most = std::max(most, paths.tension(k).back());
    return most;
  };
  // cable 3 and 4 lie at 72 and 108 degrees: sin 72 of the radius is the farthest outside
  const double onset = 100 * (0.01845 * std::sin(72 * pi / 180) - c) * kappa;
  CHECK(tension(onset + 0.1) < 25);   // N: bending it into place and its weight, no stretch
  CHECK(tension(onset - 0.1) > 500);  // 0.1 % of 0.98 MN, less what the wall gives
}

TEST_CASE("strains change smoothly with the lay from straight to ten degrees") {
  Dresspack dresspack = held_hose();
  std::vector<double> ranges;
  const double step = 0.05;  // [deg]
  for (double lay = 0; lay < 10; lay += step) {
    dresspack.components[0].lay_angle = lay * pi / 180;
    Run run(dresspack, Slip::free, 20, 20);
    double widest = 0;
    for (std::size_t k = 0; k < 10; ++k) {
      double low = 1, high = -1;
      for (std::size_t t = 0; t < 20; ++t) {
        low = std::min(low, run.strain(k, 40, t));
        high = std::max(high, run.strain(k, 40, t));
      }
      widest = std::max(widest, high - low);
    }
    ranges.push_back(widest);
  }
  const double largest = *std::max_element(ranges.begin(), ranges.end());
  // A turn more between the clamps every 3.3 degrees takes the range from its largest to nearly nothing: over
  // 0.05 degrees by pi x 0.05/3.3, 5 % of the largest; a jump would be of its whole size.
  for (std::size_t i = 1; i < ranges.size(); ++i)
    CHECK(std::abs(ranges[i] - ranges[i - 1]) < 0.05 * largest);
}

TEST_CASE("a grip bounds the force of a cable, and its slip adds up over a repeat") {
  Dresspack dresspack = held_hose();
  dresspack.components[0].laying.base_grip = 300;
  Run run(dresspack, Slip::free, 101, 50);
  CHECK(run.largest_tension() == Approx(300).epsilon(1e-3));
  double let_in = 0;
  for (std::size_t k = 0; k < 10; ++k) {
    let_in = std::max(let_in, run.paths.grip_slip(k)[0]);
    CHECK(run.paths.grip_slip(k)[1] == 0);
  }
  CHECK(let_in > 0.005);  // of 2 m that stretch by 0.5 % and more to and fro, twice
}

TEST_CASE("forces of held cables are told beside their moment on the hose") {
  Run run(held_hose(), Slip::free, 20, 20);
  const double share = run.paths.largest_force_share();
  CHECK(share > 1);  // copper does not bear what held cables ask of it
  double most = 0;
  for (const double moment : run.paths.cable_moment()) most = std::max(most, moment);
  CHECK(most > 100);  // [N m], of a hose that carries 25 N m2 x 1 1/m
  CHECK(*std::max_element(run.paths.hose_moment().begin(), run.paths.hose_moment().end()) < 25);
  CHECK(run.paths.clamp_moment_share() ==
        most / *std::max_element(run.paths.hose_moment().begin(), run.paths.hose_moment().end()));
  Dresspack with_slack = thesis_hose();
  with_slack.components[0].laying.slack = 1;
  Run loose(with_slack, Slip::free, 20, 20);
  CHECK(loose.paths.largest_force_share() < 0.2);
}

TEST_CASE("with friction along it a cable's largest force counts, wherever it is") {
  Dresspack dresspack = held_hose();
  dresspack.components[0].friction = 0.3;
  dresspack.components[0].radial_line_load = 2000;  // 0.3 x 2000 N/m x 2 m: as much as its ends feel
  Run run(dresspack, Slip::friction, 20, 20);
  double largest = 0;
  const CableForce& force = run.construction.layers()[0].force;
  for (std::size_t k = 0; k < 10; ++k)
    for (std::size_t i = 0; i < segments; ++i)
      for (std::size_t t = 0; t < 20; ++t)
        largest = std::max(largest, std::abs(force.force(run.strain(k, i, t))));
  CHECK(run.paths.largest_force_share() == Approx(largest / force.strength()));
  double ends = 0;
  for (std::size_t k = 0; k < 10; ++k)
    for (const std::size_t i : {std::size_t{0}, segments - 1})
      for (std::size_t t = 0; t < 20; ++t) ends = std::max(ends, std::abs(force.force(run.strain(k, i, t))));
  CHECK(ends < 0.99 * largest);  // else this would not tell the two apart
}

TEST_CASE("the same cables come out in blocks of any size") {
  Dresspack dresspack = thesis_hose();
  dresspack.components[0].laying.slack = 0.5;
  dresspack.components[0].friction = 0.3;
  dresspack.components[0].radial_line_load = 5;
  const Run whole(dresspack, Slip::friction, 30, 30);
  const Construction construction(dresspack, Kinematics::exact);
  CablePaths paths(construction, plan_slip(construction, {Slip::friction, Slip::free}, length), true,
                   whole.lengths, whole.arcs, 30);
  for (std::size_t first = 0; first < 30; first += 10) {
    DeformationHistory part(segments, 10);
    for (std::size_t t = 0; t < 10; ++t)
      for (std::size_t i = 0; i < segments; ++i)
        part.set(i, t, swing(whole.arcs[i] / length, static_cast<double>(first + t) / 30));
    paths.add({part});
  }
  paths.finish();
  for (std::size_t k = 0; k < 10; ++k) CHECK(paths.tension(k) == whole.paths.tension(k));
}
