// Rubbing work and largest forces of a dragged block against closed forms.
#include "sim/contact/touch.h"

#include "sim/contact/world.h"
#include "tests/catch.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

TEST_CASE("a hose dragged over the floor rubs by weight times friction times way") {
  RodProperties p = hose(10, 0.5);
  p.tool_end = End::free;
  const Rod rod(p);
  // Along x, half a diameter above the floor, so that it rests on it.
  const Frame base{{0, 0, 0.03}, turn_between(Vector3::UnitZ(), Vector3::UnitX())};
  WorldSettings settings;
  settings.floor = true, settings.friction = 0.4;
  World world(rod, settings, rod.straight(base));
  Touch touch(rod.segments(), {"bench"});
  CHECK(touch.obstacles() == std::vector<std::string>{"bench", "floor", "dresspack", "cell"});
  const double speed = -0.2, h = settings.time_step;
  const int steps = 500;
  double since = 0, pressed = 0;
  for (int k = 1; k <= steps; ++k) {
    ClampFrames clamps{base, base};
    clamps.base.position.x() += speed * k * h;
    REQUIRE(world.advance(clamps).finite);
    touch.add(world.contacts(), h);
    if (k == steps - 100) touch.begin_sample();
    if (k > steps - 100)
      for (const Contact& contact : world.contacts()) pressed += contact.normal_force * h;
  }
  double work = 0;
  for (int i = 0; i < rod.segments(); ++i) {
    work += touch.work()[4 * i + 1];
    since += touch.sample_work()[i];
    CHECK(touch.sample_obstacle()[i] == 1);
    CHECK(touch.sample_force()[i] <= touch.largest_force()[4 * i + 1]);
    CHECK(touch.work()[4 * i] + touch.work()[4 * i + 2] + touch.work()[4 * i + 3] == 0);
  }
  const double weight = 9.81 * 1.25, power = 0.4 * weight * 0.2;
  const double start = 1e-2;  // the jerk of the start stretches the hose and its forces oscillate
  CHECK(work == Approx(power * steps * h).epsilon(start));
  const double steady = 1e-4;  // rest of the stretching after 2 s
  CHECK(since == Approx(0.4 * pressed * 0.2).epsilon(steady));
}

TEST_CASE("the hose's work on itself is shared by both pieces") {
  Touch touch(4, {});
  Contact contact;
  contact.segment = 0, contact.other = 3, contact.obstacle = hose_obstacle;
  contact.normal_force = 10, contact.friction_force = {3, 0, 4}, contact.sliding_speed = 0.1;
  touch.add({contact, contact}, 0.01);
  // Columns: floor, dresspack, cell. Two contacts of the pair: 2 * 5 N * 0.1 m/s * 0.01 s.
  CHECK(touch.work()[0 * 3 + 1] == Approx(0.005));
  CHECK(touch.work()[3 * 3 + 1] == Approx(0.005));
  CHECK(touch.largest_force()[3 * 3 + 1] == 20);
  CHECK(touch.sample_force()[0] == 20);
  CHECK(touch.sample_obstacle()[1] == -1);
}
