// The static start: from any clamps, and with the roll that an installer would choose.
#include "sim/run/equilibrium.h"

#include <random>

#include "sim/rod/start_curve.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

// Random numbers in 0..1, the same on every machine.
class Numbers {
 public:
  double next() { return static_cast<double>(random_()) / 4294967296.0; }
  Vector3 direction() {
    const double z = 2 * next() - 1, a = 2 * pi * next(), r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }
  Quaternion orientation() { return rotation(next() * pi * direction()); }

 private:
  std::mt19937 random_{2026};
};

double largest_torsion(const Rod& rod, const RodState& state) {
  double torsion = 0;
  for (int j = 0; j < rod.links(); ++j) torsion = std::max(torsion, std::abs(rod.link_state(state, j).moment.z()));
  return torsion;
}

double net_twist(const Rod& rod, const RodState& state) {
  double twist = 0;
  for (int j = 0; j < rod.links(); ++j) twist += rod.link_state(state, j).turn.z();
  return twist;
}

}  // namespace

TEST_CASE("the start curve has the hose's length and meets both clamps") {
  Numbers numbers;
  const Rod rod(hose(50));
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    const ClampFrames clamps{{Vector3::Zero(), numbers.orientation()},
                             {numbers.direction() * (0.1 + 1.8 * numbers.next()), numbers.orientation()}};
    const RodState state = start_curve(rod, clamps).state;
    double length = 0;
    Vector3 before = clamps.base.position;
    for (int i = 0; i < 50; ++i) {
      const Vector3 joint = 2 * state.position[i] - before;
      length += (joint - before).norm();
      before = joint;
    }
    CHECK((before - clamps.tool.position).norm() < 1e-9);
    CHECK(length == Approx(2).epsilon(0.05));  // chords of a curve that may bend by 1 rad per segment: 1/24
    CHECK(std::abs(start_curve(rod, clamps).roll_to_tool) <= pi + 1e-9);
  }
}

TEST_CASE("any reasonable pair of clamps has a stable equilibrium that is found") {
  Numbers numbers;
  int taut = 0;
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    RodProperties p = hose(15 + 15 * (k % 8));
    p.axial_stiffness = std::pow(10.0, 4 + 2 * numbers.next());
    p.bending_stiffness = std::pow(20.0, numbers.next());
    p.torsional_stiffness = p.bending_stiffness * (0.5 + numbers.next());
    const Rod rod(p);
    const ClampFrames clamps{{Vector3::Zero(), numbers.orientation()},
                             {numbers.direction() * (0.1 + 1.8 * numbers.next()), numbers.orientation()}};
    const Equilibrium e = find_equilibrium(rod, clamps);
    // At the largest distances the hose is too short for a clamp that points away. This must be reported.
    taut += e.status == EquilibriumStatus::too_short;
    REQUIRE(e.status != EquilibriumStatus::not_converged);
    CHECK(e.negative_pivots == 0);
    CHECK(rod.finite(e.state));
    // With uniform twist the start twist is at most pi. Equilibrium may turn some of it into a coil, but not add to it.
    CHECK(std::abs(net_twist(rod, e.state)) < 2 * pi);
  }
  CHECK(taut < 10);
}

TEST_CASE("the usual shapes: straight, sag, S and U") {
  const Rod rod(hose(40));
  const auto level = [](double x, double z, double angle) { return planar_frame(x, z, angle); };
  const ClampFrames pairs[] = {
      {level(0, 0, 0), level(2, 0, 0)},                // exactly as long as the distance
      {level(0, 0, 0), level(2.01, 0, 0)},             // a little shorter
      {level(0, 0, 0), level(1.2, 0, 0)},              // sag
      {level(0, 0, pi / 2), level(0.8, 0.3, pi / 2)},  // S
      {level(0, 0, pi / 2), level(0.8, 0, -pi / 2)},   // U upside down
      {level(0, 0, -pi / 2), level(0.8, 0, pi / 2)},   // U
      {level(0, 0, 0), level(0.5, 0, pi)},             // tangents toward each other
      {level(0, 0, pi), level(0.5, 0, 0)},             // both away from the other clamp
  };
  for (const ClampFrames& clamps : pairs) {
    const Equilibrium e = find_equilibrium(rod, clamps);
    CAPTURE(clamps.tool.position.transpose(), e.iterations, e.residual);
    CHECK(e.status == EquilibriumStatus::converged);
    CHECK(e.negative_pivots == 0);
    CHECK(std::abs(rod.mean_elongation(e.state)) < longest_elongation);
  }
}

TEST_CASE("a hose too short for its clamps is reported, with how much is missing") {
  const Rod rod(hose(40));
  const ClampFrames clamps{planar_frame(0, 0, 0), planar_frame(2.1, 0, 0)};
  CHECK(missing_length(rod, clamps) == Approx(0.1));
  CHECK(find_equilibrium(rod, clamps).status == EquilibriumStatus::too_short);
  CHECK(missing_length(rod, {planar_frame(0, 0, 0), planar_frame(1.9, 0, 0)}) == 0);
}

TEST_CASE("an equilibrium stands still in the world") {
  const Rod rod(hose(40));
  const ClampFrames clamps{planar_frame(0, 1, 0), {{1.1, 0.3, 0.8}, rotation({0.5, 1.2, -0.4})}};
  const Equilibrium e = find_equilibrium(rod, clamps);
  REQUIRE(e.status == EquilibriumStatus::converged);
  World world(rod, {}, e.state);
  double fastest = 0, moved = 0;
  for (int k = 0; k < 400; ++k) {
    REQUIRE(world.advance(clamps).finite);
    for (int i = 0; i < 40; ++i) {
      fastest = std::max(fastest, world.state().velocity[i].norm());
      moved = std::max(moved, (world.state().position[i] - e.state.position[i]).norm());
    }
  }
  CHECK(fastest < 1e-6);  // [m/s] residual forces of 1e-8 of about 10 N on 0.1 kg over 5 ms, and their accumulation
  CHECK(moved < 1e-6);    // [m]
}

TEST_CASE("a twist-free clamp carries no torsion, whatever roll it was given") {
  Numbers numbers;
  const Rod rod(hose(40));
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    ClampFrames clamps{{Vector3::Zero(), numbers.orientation()},
                       {numbers.direction() * (0.3 + 1.2 * numbers.next()), Quaternion::Identity()}};
    clamps.tool.orientation = rotation(numbers.direction() * 1.2) * clamps.base.orientation;
    const TwistFreeClamp free = twist_free_roll(rod, clamps);
    REQUIRE(free.equilibrium.status == EquilibriumStatus::converged);
    const double no_torsion = 1e-5;  // [N m] of 12 N m for one turn of this hose
    CHECK(largest_torsion(rod, free.equilibrium.state) < no_torsion);
    // The rolled tool frame is the given frame turned about its own tangent.
    const Frame expected = rolled(clamps.tool, free.roll);
    CHECK(expected.orientation.angularDistance(free.equilibrium.state.clamps.tool.orientation) < 1e-9);
    // From another given roll the result is the same.
    const TwistFreeClamp again = twist_free_roll(rod, {clamps.base, rolled(clamps.tool, 1.0)});
    CHECK(std::abs(std::remainder(again.roll + 1.0 - free.roll, 2 * pi)) < 1e-6);
  }
}

TEST_CASE("a planar bend needs no roll") {
  const Rod rod(hose(40));
  const TwistFreeClamp free = twist_free_roll(rod, {planar_frame(0, 0, -0.4), planar_frame(1.2, 0.2, 0.3)});
  CHECK(std::abs(free.roll) < 1e-9);
}

TEST_CASE("a hose settles on an obstacle that stands in its equilibrium") {
  const Rod rod(hose(40));
  const ClampFrames clamps{planar_frame(0, 1, 0), planar_frame(1.4, 1, 0)};
  const Equilibrium sag = find_equilibrium(rod, clamps);
  double lowest = 1;
  for (const Vector3& x : sag.state.position) lowest = std::min(lowest, x.z());
  const Frame link{{0.7, 0, lowest - 0.05}, Quaternion::Identity()};  // 80 mm into the hose
  World world(rod, {}, sag.state, std::span(&link, 1));
  world.add(0, CapsuleShape{{0, -0.5, 0}, {0, 0.5, 0}, 0.1});
  const Equilibrium settled = settle(world, std::span(&link, 1));
  CAPTURE(settled.iterations, settled.residual);
  CHECK(settled.status == EquilibriumStatus::converged);
  double carried = 0;
  for (const Contact& c : world.contacts()) {
    carried += c.normal_force;
    CHECK(c.depth < 1e-3);
  }
  CHECK(carried > 1);
}

TEST_CASE("a chain whose simulation breaks down has no small residual") {
  const Rod rod(hose(40));
  RodState state = find_equilibrium(rod, {planar_frame(0, 1, 0), planar_frame(1.4, 1, 0)}).state;
  state.velocity[20].z() = NAN;
  World world(rod, {}, state);
  const Equilibrium broken = settle(world);
  CHECK(broken.status == EquilibriumStatus::not_converged);
  CHECK(std::isinf(broken.residual));
}

TEST_CASE("a leaning arch rests on either side, and within each shape the bend radius converges with the segments") {
  const auto frame = [](const Vector3& position, const Vector3& direction) {
    return Frame{position, turn_between(Vector3::UnitZ(), direction.normalized())};
  };
  const ClampFrames clamps{frame({0, 0, 1}, {0, 0.1, 1}), frame({0.5, 0, 1}, {0, -0.1, -1})};
  const auto radii = [&](int segments) {
    RodProperties p = hose(segments);
    p.bending_stiffness = 2;
    p.torsional_stiffness = 1.6;
    std::vector<double> found;
    for (const TwistFreeClamp& shape : rest_shapes(p, clamps, true)) {
      const Rod rod(p);
      CHECK(shape.equilibrium.negative_pivots == 0);  // stable
      double curvature = 0;
      for (int j = 0; j < rod.links(); ++j)
        curvature = std::max(curvature, rod.curvature(rod.link_state(shape.equilibrium.state, j).turn, j));
      found.push_back(1 / curvature);
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  const std::vector<double> coarse = radii(32), fine = radii(64), finest = radii(128);
  CAPTURE(coarse, fine, finest);
  REQUIRE(coarse.size() >= 2);
  REQUIRE(fine.size() == coarse.size());
  REQUIRE(finest.size() == coarse.size());
  CHECK(finest.back() > 1.1 * finest.front());  // the shapes are different
  for (std::size_t k = 0; k < finest.size(); ++k) {
    CHECK(coarse[k] == Approx(finest[k]).epsilon(0.01));  // the shapes differ by 17 %
    CHECK(fine[k] == Approx(finest[k]).epsilon(0.0025));  // second order: a fourth of that
  }
}
