// Places where a dragged hose is rubbed: normal force times sliding distance, distributed over the touching surface.
#include "sim/contact/rubbing.h"

#include "sim/contact/world.h"
#include "tests/catch.h"
#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

namespace {

struct Dragged {
  std::vector<RubbedPatch> patches;
  double pressed = 0, length = 0.5;  // [N s], [m]
};

/// A hose of 0.5 m that lies along x on the floor and is dragged at 0.2 m/s for 2.5 s.
Dragged dragged(int segments) {
  Dragged result;
  RodProperties p = hose(segments, result.length);
  p.tool_end = End::free;
  const Rod rod(p);
  const Frame base{{0, 0, p.diameter / 2}, turn_between(Vector3::UnitZ(), Vector3::UnitX())};
  WorldSettings settings;
  settings.floor = true, settings.friction = 0.4;
  World world(rod, settings, rod.straight(base));
  Rubbing rubbing(rod);
  const double h = settings.time_step;
  for (int k = 1; k <= 500; ++k) {
    ClampFrames clamps{base, base};
    clamps.base.position.x() -= 0.2 * k * h;
    REQUIRE(world.advance(clamps).finite);
    rubbing.add(world.contacts(), world.state(), h);
    for (const Contact& contact : world.contacts()) result.pressed += contact.normal_force * h;
  }
  rubbing.end_sample(2.5);
  result.patches = rubbing.patches(Touch(rod.segments(), {"bench"}));
  return result;
}

}  // namespace

TEST_CASE("a hose dragged over the floor is rubbed evenly along its underside, at any number of segments") {
  const double below = 1e-2;  // of all forces; the jerk of the start
  for (const int segments : {10, 20}) {
    CAPTURE(segments);
    const Dragged run = dragged(segments);
    double work = 0, largest = 0;
    for (const RubbedPatch& patch : run.patches) {
      CHECK(patch.obstacle == 1);  // bench, floor, ..
      CHECK(patch.time == 2.5);
      CHECK(patch.angle == Approx(run.patches[0].angle));
      work += patch.work;
      if (patch.position > 0.1 && patch.position < 0.4) largest = std::max(largest, patch.work / patch.length);
    }
    CHECK(work == Approx(run.pressed * 0.2).epsilon(below));
    // Without distribution, contacts at the segments' ends would give one cell all of a segment's work.
    const double uneven = 0.1;  // the refinement that fatigue/wear.h states
    CHECK(largest == Approx(work / run.length).epsilon(uneven));
  }
}

TEST_CASE("a contact's work lies evenly over a segment's length about where it was before the step, in its sector") {
  const RodProperties p = hose(10, 1);
  const Rod rod(p);
  const double h = 0.01, length = 0.1;
  const int cells = int(std::lround(length / std::max(1e-3, p.diameter / 12)));
  const double cell = length / cells;
  for (const int moved : {0, 3})                      // cells in the step
    for (const int at : {0, 2, 17, 100, 10 * cells})  // from the base, in half cells; the last is the middle
      for (const double degrees : {102.0, -31.0}) {
        CAPTURE(moved, at, degrees);
        const double place = at * cell / 2, angle = degrees * pi / 180;
        RodState state = rod.straight({});
        for (Vector3& velocity : state.velocity) velocity = {0, 0, moved * cell / h};
        const Vector3 toward(std::cos(angle), std::sin(angle), 0);
        Contact contact;
        contact.obstacle = 0, contact.segment = std::min(int(place / length), 9), contact.other = -1;
        contact.point = p.diameter / 2 * toward + Vector3(0, 0, place - moved * cell);
        contact.normal = -toward, contact.normal_force = 10, contact.sliding_speed = 0.1;
        Rubbing rubbing(rod);
        rubbing.add({contact}, state, h);
        double work = 0, mean = 0, least = 10, most = 0;
        for (const RubbedPatch& patch : rubbing.patches(Touch(10, {"bench", "floor"}))) {
          CHECK(patch.length == Approx(cell));
          CHECK(patch.angle == Approx((degrees > 0 ? 102.5 : 327.5) * pi / 180));
          CHECK(patch.width == Approx(5 * pi / 180));
          CHECK(patch.work <= 0.01 / cells * (1 + 1e-9));
          work += patch.work, mean += patch.work * patch.position / 0.01;
          least = std::min(least, patch.position - cell / 2), most = std::max(most, patch.position + cell / 2);
        }
        CHECK(work == Approx(0.01));
        const double middle = std::max(place, length / 2);  // limited by the end
        // Half cells at both ends count at their middles; the errors cancel.
        CHECK(mean == Approx(middle));
        CHECK(least >= middle - length / 2 - cell / 2 - 1e-9);
        CHECK(most <= middle + length / 2 + cell / 2 + 1e-9);
      }
}

TEST_CASE("a contact rubs the side that faces the obstacle, and with a ring the place that it touches") {
  RodProperties p = hose(10, 1);
  const Rod rod(p);
  const RodState state = rod.straight({});
  Contact contact;
  contact.obstacle = first_ring, contact.segment = 4, contact.other = 5, contact.share = 0.25;
  contact.normal = {0, -1, 0}, contact.normal_force = 10, contact.sliding_speed = 0.1;
  Rubbing rubbing(rod);
  rubbing.add({contact}, state, 0.01);
  rubbing.end_sample(1);
  contact.normal_force = 5;
  rubbing.add({contact}, state, 0.01);
  rubbing.end_sample(2);
  const auto patches = rubbing.patches(Touch(10, {"bench"}, 1));
  REQUIRE(patches.size() == 1);
  CHECK(std::abs(patches[0].position - 0.475) <= patches[0].length / 2 * (1 + 1e-9));
  CHECK(std::abs(patches[0].angle - pi / 2) <= patches[0].width / 2 * (1 + 1e-9));
  CHECK(patches[0].work == Approx(0.015));
  CHECK(patches[0].time == 1);
  CHECK(patches[0].obstacle == 4);  // bench, floor, dresspack, cell, ring 1
}

TEST_CASE("where a hose rubs on itself both places wear alike, on the sides that face each other") {
  const Rod rod(hose(10, 1));
  const RodState state = rod.straight({});
  Contact contact;
  contact.obstacle = hose_obstacle, contact.segment = 1, contact.other = 8;
  contact.point = (state.position[1] + state.position[8]) / 2;
  contact.normal = {1, 0, 0}, contact.normal_force = 10, contact.sliding_speed = 0.1;
  Rubbing rubbing(rod);
  rubbing.add({contact}, state, 0.01);
  double one = 0, other = 0;
  for (const RubbedPatch& patch : rubbing.patches(Touch(10, {}))) {
    (patch.position < 0.5 ? one : other) += patch.work;
    CHECK(std::cos(patch.angle) * (patch.position < 0.5 ? -1 : 1) > 0.99);
  }
  CHECK(one == Approx(0.01));
  CHECK(other == Approx(0.01));
}
