#include "pipeline/arm/other_arms.h"

#include <Eigen/Geometry>
#include <set>

#include "pipeline/arm/other_turns.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/arm/last_link.h"

namespace dresslife::pipeline {
namespace {

Job shipped() {
  return read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml", {"motion=hard"});
}

}  // namespace

TEST_CASE("other configurations of the arm: the same pose of the flange, and all that there are") {
  Job job = shipped();
  Robot& robot = job.robot;
  REQUIRE(has_wrist(robot));
  // Without limits an elbow arm with an offset shoulder has four where it reaches back, two where it does
  // not.
  constexpr double half_a_turn = 3.14159265;
  for (Joint& joint : robot.joints) joint.lower = -half_a_turn, joint.upper = half_a_turn;
  struct Case {
    std::vector<double> joints;
    std::size_t others;
  };
  std::set<std::string_view> kinds;
  for (const auto& [joints, others] :
       {Case{{0.1, -0.2, 0.3, 0.5, 0.6, -0.7}, 3}, Case{{-0.4, 0.1, -0.9, -1, -0.5, 1.2}, 1},
        Case{{0.3, 0, 0.2, 0, 0, 0.4}, 3}}) {
    const std::vector<OtherArm> arms = other_arms(robot, joints);
    CHECK(arms.size() == others);
    for (const OtherArm& arm : arms) {
      kinds.insert(arm.what);
      constexpr double reached = 1e-8;  // the wrist's centre to a millionth of a millimetre
      CHECK(pose(robot, arm.joints).isApprox(pose(robot, joints), reached));
      CHECK((Vector3d(arm.joints.data()) - Vector3d(joints.data())).norm() > 0.1);
    }
  }
  CHECK(kinds.size() == 3);
  // Within the limits fewer remain, and none beyond.
  robot = shipped().robot;
  for (const OtherArm& arm : other_arms(robot, {-0.4, 0.1, -0.9, -1, -0.5, 1.2}))
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(arm.joints[k] >= robot.joints[k].lower);
      CHECK(arm.joints[k] <= robot.joints[k].upper);
    }
}

TEST_CASE("turns of wrist and arm keep the pose, a robot without such a wrist has none") {
  Job job = shipped();
  Robot& robot = job.robot;
  const std::vector<double> joints{0.1, -0.2, 0.3, 0.5, 0.6, -0.7};
  int found = 0;
  for (const NamedTurn& turn : other_turns(robot))
    if (const auto other = turn.turn(joints)) {
      INFO(turn.name);
      constexpr double reached = 1e-8;  // the wrist's centre to a millionth of a millimetre
      CHECK(pose(robot, *other).isApprox(pose(robot, joints), reached));
      CHECK(within_limits(robot, *other));
      ++found;
    }
  CHECK(found >= 4);
  robot.joints[4].origin.y() += 0.1;  // axis 5 no longer meets axis 4
  CHECK(other_turns(robot).empty());
}

}  // namespace dresslife::pipeline
