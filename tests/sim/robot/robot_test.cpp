#include "sim/robot/robot.h"

#include <Eigen/Geometry>
#include <random>

#include "pipeline/base/constants.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

/// Some ten roundings of 1e-16 in lengths of up to 3 m.
constexpr double rounding = 1e-14;

pipeline::Robot two_joint_arm() {
  pipeline::Robot robot;
  robot.name = "arm";
  pipeline::Joint shoulder, elbow;
  shoulder.name = "shoulder";
  shoulder.origin = {0, 0, 1};
  shoulder.axis = {0, 0, 2};  // need not be of unit length
  shoulder.lower = -pi / 2;
  shoulder.upper = pi / 2;
  elbow.name = "elbow";
  elbow.origin = {2, 0, 0};
  elbow.orientation = {0, pi / 2, 0};  // joint frame z = world x
  elbow.axis = {0, 0, 1};
  elbow.lower = -4 * pi;
  elbow.upper = 4 * pi;
  robot.joints = {shoulder, elbow};
  robot.links = {{"base", {}}, {"upper", {}}, {"lower", {}}};
  return robot;
}

TEST_CASE("robot: links stand where plane geometry puts them") {
  const RobotKinematics robot(two_joint_arm());
  std::vector<Frame> frames(3);
  robot.link_frames(std::vector{pi / 2, 0.0}, frames);
  CHECK((frames[0].position).norm() == 0);
  CHECK((frames[1].position - Vector3(0, 0, 1)).norm() < rounding);
  CHECK((frames[2].position - Vector3(0, 2, 1)).norm() < rounding);
  CHECK((frames[2].orientation * Vector3::UnitZ() - Vector3(0, 1, 0)).norm() < rounding);
}

TEST_CASE("robot: roll, pitch and yaw turn about fixed axes") {
  const Vector3 angles(0.3, -0.7, 1.9);
  const Matrix3 expected =
      (Eigen::AngleAxisd(angles.z(), Vector3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vector3::UnitY()) *
       Eigen::AngleAxisd(angles.x(), Vector3::UnitX()))
          .toRotationMatrix();
  CHECK((from_roll_pitch_yaw(angles).toRotationMatrix() - expected).norm() < rounding);
}

TEST_CASE("robot: frames agree with homogeneous matrices multiplied out") {
  pipeline::Robot robot;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  robot.base_position = vector();
  robot.base_orientation = vector();
  robot.links.resize(7);
  std::vector<double> angles;
  Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
  const auto place = [&](const Vector3& origin, const Vector3& turn) {
    expected = expected * Eigen::Translation3d(origin) * Eigen::AngleAxisd(turn.z(), Vector3::UnitZ()) *
               Eigen::AngleAxisd(turn.y(), Vector3::UnitY()) * Eigen::AngleAxisd(turn.x(), Vector3::UnitX());
  };
  place(robot.base_position, robot.base_orientation);
  for (int k = 0; k < 6; ++k) {
    pipeline::Joint joint;
    joint.origin = vector();
    joint.orientation = 2 * vector();
    joint.axis = vector();
    angles.push_back(6 * uniform(random));
    place(joint.origin, joint.orientation);
    expected = expected * Eigen::AngleAxisd(angles.back(), joint.axis.normalized());
    robot.joints.push_back(joint);
  }
  std::vector<Frame> frames(7);
  RobotKinematics(robot).link_frames(angles, frames);
  CHECK((frames[6].position - expected.translation()).norm() < rounding);
  CHECK((frames[6].orientation.toRotationMatrix() - expected.linear()).norm() < rounding);
}

TEST_CASE("robot: a quaternion keeps its sign through two whole turns") {
  const RobotKinematics robot(two_joint_arm());
  std::vector<Frame> frames(3);
  Quaternion before;
  double closest = 1;
  for (int k = 0; k <= 1440; ++k) {
    robot.link_frames(std::vector{0.0, k * pi / 360}, frames);
    if (k > 0) closest = std::min(closest, frames[2].orientation.dot(before));
    before = frames[2].orientation;
  }
  CHECK(closest > 0.99999);  // cos(half of half a degree) = 0.9999905
}

TEST_CASE("robot: angles beyond the limits are named") {
  const pipeline::Robot robot = two_joint_arm();
  const pipeline::Where where{"job.yaml", 12, 7};
  CHECK_NOTHROW(check_joint_limits(robot, std::vector{pi / 2, -4 * pi}, "waypoint 'home'", where));
  CHECK_THROWS_WITH(check_joint_limits(robot, std::vector{pi / 2 + 0.01, 0.0}, "waypoint 'home'", where),
                    "job.yaml:12:7: error: waypoint 'home' turns shoulder to 90.573 deg (must be within -90 .. "
                    "90 deg); turn it 0.573 deg less, inside the limits of arm");
  CHECK_THROWS_WITH(check_joint_limits(robot, std::vector{0.0}, "waypoint 'home'", where),
                    "job.yaml:12:7: error: waypoint 'home' has 1 joint angles; arm has 2 axes: give one angle "
                    "for each");
}

TEST_CASE("robot: a link is found by its name, a wrong name lists those that exist") {
  const pipeline::Robot robot = two_joint_arm();
  CHECK(find_link(robot, "lower", {}) == 2);
  CHECK_THROWS_WITH(find_link(robot, "wrist", {"job.yaml", 3, 1}),
                    "job.yaml:3:1: error: arm has no link 'wrist'; use one of base, upper, lower");
}

}  // namespace
