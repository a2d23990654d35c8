// Loops of a motion: rounds of equal length after which the robot is in the same pose.
#include "sim/robot/loops.h"

#include "tests/catch.h"
#include "tests/sim/simple_job.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

JointMotion motion_of(const std::vector<pipeline::MotionStep>& steps) {
  pipeline::Job job = simple_job();
  job.motion.steps = steps;
  return JointMotion(job.motion, job.robot);
}

pipeline::MotionStep repeated(int repeats, const std::vector<pipeline::MotionStep>& steps) {
  pipeline::MotionStep loop;
  loop.repeat = repeats;
  loop.steps = steps;
  return loop;
}

TEST_CASE(
    "loops: the rounds of a repeated block between other moves are found, and the robot is in the same pose in each") {
  const JointMotion motion = motion_of(
      {move_to(0), repeated(7, {move_to(2), dwell_for(0.4), move_to(-1), move_to(1)}), move_to(-2), move_to(0)});
  const std::vector<MotionLoop> loops = loops_of(motion);
  REQUIRE(loops.size() == 1);
  const MotionLoop& loop = loops.front();
  CHECK(loop.rounds >= 6);  // the first round begins with another move
  CHECK(loop.end() <= motion.duration());
  for (const double within : {0.0, 0.3, 0.7, 0.99})
    for (int round = 0; round < loop.rounds; ++round)
      CHECK(motion.position(loop.begin + (round + within) * loop.round)[0] ==
            Approx(motion.position(loop.begin + within * loop.round)[0]).margin(1e-9));
}

TEST_CASE("loops: two loops, the second one with a loop inside") {
  const JointMotion motion =
      motion_of({move_to(0), repeated(5, {move_to(1), move_to(0)}), dwell_for(1),
                 repeated(4, {move_to(3), repeated(2, {move_to(2), move_to(2.5)}), move_to(0)})});
  const std::vector<MotionLoop> loops = loops_of(motion);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].end() <= loops[1].begin);
  CHECK(loops[1].rounds >= 3);
  CHECK(motion.duration() - loops[1].end() < loops[1].round);
}

TEST_CASE("loops: rounds that differ, or have different moves between them, are no loop") {
  std::vector<pipeline::MotionStep> different{move_to(0)}, jogged{move_to(0)};
  for (int round = 0; round < 8; ++round) {
    different.insert(different.end(), {move_to(1 + 0.001 * round), move_to(0)});
    jogged.insert(jogged.end(), {move_to(1), move_to(0), move_to(-0.1 - 0.01 * round), move_to(0)});
  }
  CHECK(loops_of(motion_of(different)).empty());
  CHECK(loops_of(motion_of(jogged)).empty());
}

TEST_CASE("loops: a motion without three equal rounds has none") {
  CHECK(loops_of(motion_of({move_to(0), move_to(1), move_to(0.5), move_to(0)})).empty());
  CHECK(loops_of(motion_of({move_to(0), repeated(2, {move_to(1), move_to(0)})})).empty());
  CHECK(loops_of(motion_of({move_to(0)})).empty());
}

}  // namespace
