#include "pipeline/arm/other_arms.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>

#include "pipeline/arm/other_turns.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/arm/last_link.h"

namespace dresslife::pipeline {
namespace {

Job shipped() { return read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml", {"motion=hard"}); }

}  // namespace

TEST_CASE("other configurations of the arm: the same pose of the flange, and all that there are") {
  Job job = shipped();
  Robot& robot = job.robot;
  REQUIRE(has_wrist(robot));
  // Without limits an elbow arm with an offset shoulder has four solutions where it can reach backward, otherwise two.
  constexpr double half_a_turn = 3.14159265;
  for (Joint& joint : robot.joints) joint.lower = -half_a_turn, joint.upper = half_a_turn;
  struct Case {
    std::vector<double> joints;
    std::size_t others;
  };
  std::set<std::string_view> kinds;
  for (const auto& [joints, others] : {Case{{0.1, -0.2, 0.3, 0.5, 0.6, -0.7}, 3},
                                       Case{{-0.4, 0.1, -0.9, -1, -0.5, 1.2}, 1}, Case{{0.3, 0, 0.2, 0, 0, 0.4}, 3}}) {
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
  // Within the limits fewer solutions remain, none beyond.
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
  robot.joints[4].origin.y() += 0.1;  // axis 5 does not meet axis 4
  CHECK(other_turns(robot).empty());
}

TEST_CASE("other configurations: what they are called, the wrist next to the one before, and every limit kept") {
  Robot robot = shipped().robot;
  for (Joint& joint : robot.joints) joint.lower = -6.5, joint.upper = 6.5;
  for (const std::size_t axis : {1, 2}) robot.joints[axis].lower = -3.1, robot.joints[axis].upper = 3.1;
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::set<std::string_view> kinds;
  for (int round = 0; round < 12; ++round) {
    std::vector<double> joints(6);
    for (double& angle : joints) angle = between(-1.5, 1.5);
    const std::vector<OtherArm> free = other_arms(robot, joints);
    REQUIRE_FALSE(free.empty());
    for (const OtherArm& arm : free) {
      kinds.insert(arm.what);
      CHECK(pose(robot, arm.joints).isApprox(pose(robot, joints), 1e-8));
      const double turn = arm.joints[0] - joints[0];
      CHECK((arm.what.find("turned round") != std::string_view::npos) == (std::cos(turn) < 0));
      if (arm.what == arm_configurations[3]) CHECK(std::abs(turn) == Approx(2 * std::numbers::pi));
      if (arm.what == arm_configurations[0]) CHECK(turn == Approx(0).margin(1e-6));
      // No wrist of the same pose within the limits is nearer.
      const auto off = [&](double four, double five, double six) {
        return std::hypot(four - joints[3], five - joints[4], six - joints[5]);
      };
      const double chosen = off(arm.joints[3], arm.joints[4], arm.joints[5]), pi = std::numbers::pi;
      for (const double flip : {0.0, pi})
        for (double four = arm.joints[3] + flip - 6 * pi; four < 6.5; four += 2 * pi)
          for (double six = arm.joints[5] + flip - 6 * pi; six < 6.5; six += 2 * pi)
            if (four > -6.5 && six > -6.5)
              CHECK(off(four, flip == 0 ? arm.joints[4] : -arm.joints[4], six) >= chosen - 1e-6);
    }
    // Each limit in turn excludes the solutions beyond it and no others.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Robot narrow = robot;
      narrow.joints[axis].upper = joints[axis] + 0.5;
      for (const OtherArm& arm : other_arms(narrow, joints)) CHECK(arm.joints[axis] <= narrow.joints[axis].upper);
      narrow = robot;
      narrow.joints[axis].lower = joints[axis] - 0.5;
      for (const OtherArm& arm : other_arms(narrow, joints)) CHECK(arm.joints[axis] >= narrow.joints[axis].lower);
    }
    for (std::size_t axis = 3; axis < 6; ++axis) {
      Robot narrow = robot;
      narrow.joints[axis].lower = joints[axis] - 0.5, narrow.joints[axis].upper = joints[axis] + 0.5;
      for (const OtherArm& arm : other_arms(narrow, joints)) CHECK(within_limits(narrow, arm.joints));
    }
  }
  CHECK(kinds.size() >= 3);
}

TEST_CASE("turns of the wrist are those in their names") {
  Robot robot = shipped().robot;
  for (Joint& joint : robot.joints) joint.lower = -7, joint.upper = 7;
  const std::vector<double> joints{0.1, -0.2, 0.3, 0.5, 0.6, -0.7};
  int wrists = 0;
  for (const NamedTurn& turn : other_turns(robot)) {
    if (turn.name.starts_with("other arm")) continue;
    const auto named = [&](const std::string& axis) {
      const std::size_t at = turn.name.find(axis);
      return at == std::string::npos ? 0 : std::stod(turn.name.substr(at + axis.size())) * std::numbers::pi / 180;
    };
    const auto found = turn.turn(joints);
    INFO(turn.name);
    REQUIRE(found);
    CHECK((*found)[3] - joints[3] == Approx(named("axis 4 ")));
    CHECK((*found)[5] - joints[5] == Approx(named("axis 6 ")));
    CHECK((*found)[4] == (turn.name.starts_with("wrist over") ? -joints[4] : joints[4]));
    ++wrists;
  }
  CHECK(wrists == 8);
  std::vector<double> at_limit(6, 7.0);
  CHECK(within_limits(robot, at_limit));
  for (std::size_t axis = 0; axis < 6; ++axis)
    for (const double beyond : {7.001, -7.001}) {
      std::vector<double> off(6, 0.0);
      off[axis] = beyond;
      CHECK_FALSE(within_limits(robot, off));
    }
}

TEST_CASE("a wrist whose axes do not cross in one point at right angles is none") {
  const Robot robot = shipped().robot;
  const Vector3d along = robot.joints[3].axis.normalized(), five = robot.joints[4].axis.normalized();
  const auto is_one = [&](const std::function<void(Robot&)>& change) {
    Robot changed = robot;
    change(changed);
    return has_wrist(changed);
  };
  CHECK(is_one([](Robot&) {}));
  CHECK(is_one(
      [&](Robot& r) { r.joints[4].origin += 0.1 * along, r.joints[5].origin -= 0.1 * along, r.joints[5].axis *= -1; }));
  for (const double sign : {-1.0, 1.0}) {
    CHECK_FALSE(is_one([&](Robot& r) { r.joints[4].axis += sign * 1e-4 * along; }));
    CHECK_FALSE(is_one([&](Robot& r) { r.joints[5].axis += sign * 1e-4 * five; }));
    CHECK_FALSE(is_one([&](Robot& r) { r.joints[4].origin += sign * 1e-4 * five; }));
    CHECK_FALSE(is_one([&](Robot& r) { r.joints[5].origin += sign * 1e-4 * five; }));
    CHECK_FALSE(is_one([&](Robot& r) { r.joints[4].orientation.z() += sign * 1e-4; }));
    CHECK_FALSE(is_one([&](Robot& r) { r.joints[5].orientation.y() += sign * 1e-4; }));
  }
  CHECK_FALSE(is_one([](Robot& r) { r.joints.pop_back(); }));
  CHECK_FALSE(is_one([](Robot& r) { r.joints.push_back(r.joints.back()); }));
  CHECK_FALSE(is_one([](Robot& r) { r.joints[2].follows = r.joints[1].name; }));
}

}  // namespace dresslife::pipeline
