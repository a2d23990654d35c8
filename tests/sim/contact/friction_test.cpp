// Coulomb's cone is round: a block slides with equal force in every direction of the floor, and straight.
#include "sim/contact/world.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

TEST_CASE("a hose on a slope slides alike in every direction of the slope") {
  // Gravity is tilted toward each direction. The base clamp moves with the block's acceleration, so its force is zero.
  const double slope = 0.4, friction = 0.3, g = 9.81;
  for (const double direction : {0.0, 0.3, pi / 4, 1.2}) {
    CAPTURE(direction);
    const Vector3 down(std::cos(direction), std::sin(direction), 0);
    RodProperties p = hose(8, 0.4);
    p.tool_end = End::free;
    p.gravity = g * std::sin(slope) * down - Vector3(0, 0, g * std::cos(slope));
    const Rod rod(p);
    WorldSettings settings;
    settings.floor = true;
    settings.friction = friction;
    const Frame base{{0, 0, p.diameter / 2}, turn_between(Vector3::UnitZ(), down)};
    World world(rod, settings, rod.straight(base));
    const double slide = g * (std::sin(slope) - friction * std::cos(slope)), h = settings.time_step;
    for (int k = 1; k <= 100; ++k) {
      const double t = k * h;
      ClampFrames clamps{base, base};
      clamps.base.position += 0.5 * slide * t * (t + h) * down;  // the parabola of the leapfrog scheme
      REQUIRE(world.advance(clamps).finite);
    }
    Vector3 rubbing = Vector3::Zero();
    double pressing = 0;
    for (const Contact& c : world.contacts()) {
      rubbing += c.friction_force, pressing += c.normal_force;
      CHECK(c.friction_force.norm() <= friction * c.normal_force * (1 + 1e-9));
    }
    const double tolerance = 1e-3;  // stretch waves of the chain, damped within the half second
    CHECK((rubbing + friction * pressing * down).norm() < tolerance * pressing);
  }
}

TEST_CASE("a hose that is lifted while it slides leaves its friction on the floor") {
  // Along the first and the second tangent of the floor the other component of friction is exactly 0.
  for (const Vector3& along : {Vector3(1, 0, 0), Vector3(0, 1, 0)}) {
    CAPTURE(along.transpose());
    const double friction = 0.3;
    RodProperties p = hose(8, 0.4);
    p.tool_end = End::free;
    const Rod rod(p);
    WorldSettings settings;
    settings.floor = true;
    settings.friction = friction;
    const Frame base{{0, 0, p.diameter / 2}, turn_between(Vector3::UnitZ(), along)};
    World world(rod, settings, rod.straight(base));
    bool released = false;
    for (int k = 1; k <= 200; ++k) {
      const double t = k * settings.time_step;
      ClampFrames clamps{base, base};
      clamps.base.position += 0.2 * smooth(t / 0.25) * along + Vector3(0, 0, 0.3 * smooth((t - 0.25) / 0.5));
      REQUIRE(world.advance(clamps).finite);
      for (const Contact& c : world.contacts()) {
        released |= c.normal_force == 0;
        CHECK(c.friction_force.norm() <= friction * c.normal_force * (1 + 1e-9));
      }
    }
    CHECK(released);
  }
}
