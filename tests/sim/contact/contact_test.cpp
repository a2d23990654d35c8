// The hose on obstacles: limited penetration, rest where friction holds it, Coulomb's and Newton's laws.
#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

constexpr double deepest = 1e-3;  // [m] at steps of 5 ms: less than the wall of a real hose yields
constexpr double at_rest = 1e-8;  // [m/s] of a sticking contact: the contact solver stops at impulses of 1e-9 N s
const double smooth_time = 1;     // [s]

const ClampFrames hanging{planar_frame(0, 1, 0), planar_frame(1.4, 1, 0)};

double lowest(const RodState& state) {
  double z = 1e9;
  for (const Vector3& x : state.position) z = std::min(z, x.z());
  return z;
}

struct Run {
  double depth = 0, sliding = 0, fastest = 0;  // sliding: of contacts with force in the last step
  Vector3 force = Vector3::Zero();             // of all contacts in the last step
};

// Steps the world to `until` with the given motion of the clamps and of one link.
template <typename Clamps, typename Link>
Run run(World& world, double until, const Clamps& clamps, const Link& link) {
  Run result;
  const double h = world.time_step();
  for (int k = 1; k * h < until + h / 2; ++k) {
    const Frame frame = link(k * h);
    const StepReport report = world.advance(clamps(k * h), std::span(&frame, 1));
    REQUIRE(report.finite);
    result.depth = std::max(result.depth, report.max_depth);
  }
  for (const Contact& c : world.contacts()) {
    result.force += c.normal_force * c.normal + c.friction_force;
    if (c.normal_force > 1e-6) result.sliding = std::max(result.sliding, c.sliding_speed);
  }
  for (const Vector3& v : world.state().velocity) result.fastest = std::max(result.fastest, v.norm());
  return result;
}

}  // namespace

TEST_CASE("a hose lifted and dragged by a capsule stays outside it") {
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    CAPTURE(stiffness);
    RodProperties p = hose(40);
    p.axial_stiffness = stiffness;
    const Rod rod(p);
    const Equilibrium start = find_equilibrium(rod, hanging);
    REQUIRE(start.status == EquilibriumStatus::converged);
    const Frame below{{0.7, 0, lowest(start.state) - 0.13}, Quaternion::Identity()};
    World world(rod, {}, start.state, std::span(&below, 1));
    world.add(0, CapsuleShape{{0, -0.5, 0}, {0, 0.5, 0}, 0.05});
    // The dragged arch snaps over the capsule at a time that depends on rounding. Then it comes to rest.
    const Run r = run(
        world, 6, [](double) { return hanging; },
        [&](double t) {
          Frame frame = below;
          frame.position += Vector3(0.2 * smooth((t - 1.5) / smooth_time), 0, 0.35 * smooth(t / smooth_time));
          return frame;
        });
    CHECK(r.depth < deepest);
    CHECK(r.force.z() > 30);  // it rests on the capsule with the larger part of its 49 N
  }
}

TEST_CASE("an arm sweeping through the hose at 2 m/s pushes it aside") {
  for (const double h : {0.002, 0.005}) {
    CAPTURE(h);
    const Rod rod(hose(40));
    const Equilibrium start = find_equilibrium(rod, hanging);
    const Frame aside{{0.7, -1, lowest(start.state) + 0.1}, Quaternion::Identity()};
    WorldSettings settings;
    settings.time_step = h;
    World world(rod, settings, start.state, std::span(&aside, 1));
    world.add(0, CapsuleShape{{-0.5, 0, 0}, {0.5, 0, 0}, 0.05});
    const auto arm = [&](double t) { return Frame{aside.position + Vector3(0, 2 * t, 0), aside.orientation}; };
    const Run r = run(
        world, 0.65, [](double) { return hanging; }, arm);
    CHECK(r.depth < deepest);
    // At y = 0.3 the middle of the hose is still in front of the arm, so the arm has moved it by 0.3 m.
    CHECK(world.state().position[20].y() > 0.3);
  }
}

TEST_CASE("a hose laid on the floor lies still and the floor carries its weight") {
  const Rod rod(hose(40));
  const Equilibrium start = find_equilibrium(rod, hanging);
  WorldSettings settings;
  settings.floor = true;
  World world(rod, settings, start.state, {});
  // Both clamps move down until their height is the hose's radius.
  const auto clamps = [](double t) {
    ClampFrames frames = hanging;
    const double down = 0.97 * smooth(t / 3);
    frames.base.position.z() -= down, frames.tool.position.z() -= down;
    return frames;
  };
  double depth = 0;
  for (int k = 1; k <= 1200; ++k) {
    const StepReport report = world.advance(clamps(k * 0.005));
    REQUIRE(report.finite);
    depth = std::max(depth, report.max_depth);
  }
  CHECK(depth < deepest);
  double carried = 0, sliding = 0, fastest = 0;
  for (const Contact& c : world.contacts()) {
    carried += c.normal_force;
    if (c.normal_force > 1e-6) sliding = std::max(sliding, c.sliding_speed);
  }
  for (const Vector3& v : world.state().velocity) fastest = std::max(fastest, v.norm());
  const RodState& state = world.state();
  const double weight = 9.81 * 5, held = state.link_force.back().z() - state.link_force.front().z();
  const double balance = 1e-5;  // of the weight; the remaining creep is slower than at_rest
  CHECK(carried + held == Approx(weight).epsilon(balance));
  CHECK(fastest < 1e-6);
  CHECK(sliding < at_rest);
}

TEST_CASE("a hose across a box rests on it without rocking") {
  const Rod rod(hose(30));
  const Equilibrium start = find_equilibrium(rod, hanging);
  const Frame below{{0.7, 0, lowest(start.state) - 0.2}, Quaternion::Identity()};
  World world(rod, {}, start.state, std::span(&below, 1));
  world.add(0, BoxShape{{}, {0.5, 0.5, 0.2}});
  const Run r = run(
      world, 5, [](double) { return hanging; },
      [&](double t) {
        return Frame{below.position + Vector3(0, 0, 0.2 * smooth(t / 2)), below.orientation};
      });
  CHECK(r.depth < deepest);
  CHECK(r.sliding < at_rest);
  CHECK(r.fastest < 1e-6);
  CHECK(r.force.z() > 10);
}

TEST_CASE("a hose on a slope steeper than its friction slides as a block") {
  // Gravity is tilted instead of the floor. The base clamp moves with the block's own acceleration, so its force is zero.
  const double angle = 0.4, friction = 0.3, g = 9.81;
  RodProperties p = hose(10);
  p.tool_end = End::free;
  p.length = 0.5;
  p.gravity = {g * std::sin(angle), 0, -g * std::cos(angle)};
  const Rod rod(p);
  WorldSettings settings;
  settings.floor = true;
  settings.friction = friction;
  const Frame base = planar_frame(0, p.diameter / 2, 0);
  World world(rod, settings, rod.straight(base));
  const double slide = g * (std::sin(angle) - friction * std::cos(angle)), h = settings.time_step;
  for (int k = 1; k <= 100; ++k) {
    const double t = k * h;
    ClampFrames clamps{base, base};
    clamps.base.position.x() += 0.5 * slide * t * (t + h);  // the parabola of the leapfrog scheme
    REQUIRE(world.advance(clamps).finite);
  }
  double along = 0, across = 0;
  for (const Contact& c : world.contacts()) along -= c.friction_force.x(), across += c.normal_force;
  const double weight = g * p.mass_per_length * p.length;
  const double tolerance = 1e-3;  // stretch waves of the chain, damped within the half second
  CHECK(across == Approx(weight * std::cos(angle)).epsilon(tolerance));
  CHECK(along == Approx(friction * across).epsilon(tolerance));
  CHECK(std::abs(world.state().link_force[0].x()) < 1e-2 * weight);
  CHECK(world.state().velocity[9].x() == Approx(slide * 100 * h).epsilon(tolerance));
}

TEST_CASE("the link that holds the clamp does not push the piece of hose at the clamp") {
  const Rod rod(hose(40));
  const Equilibrium start = find_equilibrium(rod, hanging);
  const Frame at_clamp = start.state.clamps.base;
  for (const bool clamped : {true, false}) {
    WorldSettings settings;
    settings.base_link = clamped ? 0 : no_link;
    World world(rod, settings, start.state, std::span(&at_clamp, 1));
    // The flange: a ball about the clamp that contains the first 20 mm of the hose.
    world.add(0, CapsuleShape{{0, 0, 0}, {0, 0, 0}, 0.02});
    const StepReport report = world.advance(hanging, std::span(&at_clamp, 1));
    CHECK((report.touching == 0) == clamped);
  }
}

TEST_CASE("a clamp holds one diameter of hose, whatever the number of segments") {
  for (int segments = 30; segments < 60; ++segments) {
    const Rod rod(hose(segments));
    const Equilibrium start = find_equilibrium(rod, hanging);
    const double diameter = rod.spans().front().properties.diameter;
    for (const bool base : {true, false}) {
      const Frame at_clamp = base ? start.state.clamps.base : start.state.clamps.tool;
      WorldSettings settings;
      (base ? settings.base_link : settings.tool_link) = 0;
      for (const double at : {0.3, 1.1}) {  // [diameters] from the clamp
        World world(rod, settings, start.state, std::span(&at_clamp, 1));
        // A small ball beneath the surface of the hose.
        const double s = (base ? at : -at) * diameter;
        const Vector3 place = s * Vector3::UnitZ() + 0.45 * diameter * Vector3::UnitX();
        world.add(0, CapsuleShape{place, place, 0.05 * diameter});
        INFO(segments << " segments, " << at);
        CHECK((world.advance(hanging, std::span(&at_clamp, 1)).touching > 0) == (at > 1));
      }
    }
  }
}
