#include "sim/robot/joint_slip.h"

#include <functional>
#include <numbers>
#include <vector>

#include "pipeline/job/motion.h"
#include "tests/catch.h"
#include "tests/sim/robot/small_arm.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

pipeline::Motion timed(const std::vector<std::vector<double>>& targets) {
  pipeline::Motion motion;
  for (const std::vector<double>& joints : targets) {
    pipeline::MotionStep step;
    step.joints = joints;
    step.duration = 1;
    motion.steps.push_back(step);
  }
  return motion;
}

TEST_CASE("joint slip: exactly one exchange, sign or unit that keeps all limits is named") {
  pipeline::Robot robot = small_arm();
  for (std::size_t k = 0; k < 6; ++k)
    robot.joints[k].lower = -0.1 - 0.01 * static_cast<double>(k), robot.joints[k].upper = 1, robot.joints[k].speed = 2;
  robot.joints[2].lower = -1, robot.joints[2].upper = 0.1;  // the only axis that turns far to the negative side
  const auto slip = [&](const std::function<void(std::vector<double>&)>& wrong) {
    pipeline::Motion motion = timed({{0.5, 0.2, -0.8, 0.5, 0.6, 0.7}, {0.6, 0.8, -0.9, 0.8, 0.9, 1}});
    for (pipeline::MotionStep& step : motion.steps) wrong(step.joints);
    return joint_slip(motion, robot);
  };
  CHECK(slip([](auto& joints) { std::swap(joints[1], joints[2]); }) == "the angles of axis_2 and axis_3 are exchanged");
  CHECK(slip([](auto& joints) { joints[4] *= -1; }) == "the sign of axis_5 is inverted");
  CHECK(slip([](auto& joints) {
          for (double& angle : joints) angle *= 180 / std::numbers::pi;
        }) == "the angles are degrees, read as radians");
  pipeline::Motion mixed = timed({{0.5, 0.2, -0.8, 0.5, 0.6, 0.7}, {30, 40, -50, 40, 45, 50}});
  robot.joints[1].lower = 0.1;  // radians of the first target, taken as degrees, are below it
  for (const char* program : {"cell.script", "cell.urscript"}) {
    mixed.steps.front().where.file = program;
    CHECK(joint_slip(mixed, robot) == "the angles are degrees, read as radians (write d2r(50) for 50)");
  }
  robot.joints[1].lower = -0.11;
  CHECK(slip([](auto& joints) { joints[4] *= -1, joints[3] *= -1; }).empty());  // one correction is not enough
  robot.joints[0].speed = 0.2;  // the others move too fast for this axis
  CHECK(slip([](auto& joints) { std::swap(joints[0], joints[1]); }) == "the angles of axis_1 and axis_2 are exchanged");
  robot.joints[5].lower = -1;  // then an exchange with axis 6 explains the sign of axis 5, too
  CHECK(slip([](auto& joints) { joints[4] *= -1; }).empty());
}

}  // namespace
