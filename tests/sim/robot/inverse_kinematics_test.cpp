#include "sim/robot/inverse_kinematics.h"

#include <Eigen/Geometry>
#include <random>

#include "pipeline/base/constants.h"
#include "pipeline/job/robot.h"
#include "tests/catch.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double pose_rounding = 1e-11;  // [m] and quaternion parts after a dozen rotations of 3 m
constexpr double joint_rounding = 1e-7;  // [rad]: acos near its limits halves the number of digits

struct Axis {
  Vector3 origin, axis;
  double lower, upper;  // [deg]
};

/// Returns a robot from facts of its type's data sheet, in the form of ROS-Industrial's support packages.
pipeline::Robot robot_of(const std::vector<Axis>& axes, const Vector3& flange_rpy) {
  pipeline::Robot robot;
  robot.name = "robot";
  robot.links.resize(axes.size() + 1);
  for (const Axis& a : axes) {
    pipeline::Joint joint;
    joint.name = "joint_" + std::to_string(robot.joints.size() + 1);
    joint.origin = a.origin;
    joint.axis = a.axis;
    joint.lower = a.lower * pi / 180;
    joint.upper = a.upper * pi / 180;
    joint.speed = 2;
    joint.acceleration = 5;
    robot.joints.push_back(joint);
  }
  robot.flange_orientation = flange_rpy;
  return robot;
}

const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();

pipeline::Robot irb6640() {
  return robot_of({{{0, 0, .780}, z, -170, 170},
                   {{.320, 0, 0}, y, -65, 85},
                   {{0, 0, 1.075}, y, -180, 70},
                   {{0, 0, .200}, x, -300, 300},
                   {{1.392, 0, 0}, y, -120, 120},
                   {{.200, 0, 0}, x, -360, 360}},
                  {0, pi / 2, 0});
}
pipeline::Robot kr16() {
  return robot_of({{{0, 0, .675}, -z, -185, 185},
                   {{.26, 0, 0}, y, -155, 35},
                   {{.68, 0, 0}, y, -130, 154},
                   {{.67, 0, -.035}, -x, -350, 350},
                   {{0, 0, 0}, y, -130, 130},
                   {{0, 0, 0}, -x, -350, 350}},
                  {0, pi / 2, 0});
}
pipeline::Robot m20ia() {
  return robot_of({{{0, 0, .525}, z, -170, 170},
                   {{.15, 0, 0}, y, -100, 160},
                   {{0, 0, .79}, -y, -185, 273},
                   {{0, 0, .25}, -x, -200, 200},
                   {{.835, 0, 0}, -y, -140, 140},
                   {{.1, 0, 0}, -x, -270, 270}},
                  {pi, -pi / 2, 0});
}

VectorXd random_joints(const pipeline::Robot& robot, std::mt19937& random) {
  VectorXd joints(6);
  for (int i = 0; i < 6; ++i)
    joints[i] = std::uniform_real_distribution<double>(robot.joints[i].lower, robot.joints[i].upper)(random);
  return joints;
}

double distance(const Frame& a, const Frame& b) {
  return (a.position - b.position).norm() + rotation_vector(a.orientation.conjugate() * b.orientation).norm();
}

}  // namespace

TEST_CASE("inverse kinematics: every arm found reaches the flange, and the arm it came from is among them") {
  std::mt19937 random(3);
  for (const pipeline::Robot& robot : {irb6640(), kr16(), m20ia()}) {
    const InverseKinematics arm(robot);
    REQUIRE(arm.unsupported() == "");
    for (int round = 0; round < 300; ++round) {
      const VectorXd joints = random_joints(robot, random);
      const Frame flange = arm.flange(joints);
      const std::vector<VectorXd> arms = arm.arms(flange, joints);
      double nearest = 10;
      for (const VectorXd& found : arms) {
        CHECK(distance(arm.flange(found), flange) < pose_rounding * 100);
        double off = 0;
        for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(std::remainder(found[i] - joints[i], 2 * pi)));
        nearest = std::min(nearest, off);
      }
      CHECK(nearest < joint_rounding);
      CHECK(arms.size() >= 2);
    }
  }
}

TEST_CASE("inverse kinematics: a configuration brings back the very angles, turns included") {
  std::mt19937 random(5);
  using Kind = ArmConfiguration::Kind;
  const std::pair<pipeline::Robot, Kind> cases[] = {
      {irb6640(), Kind::abb}, {kr16(), Kind::kuka}, {m20ia(), Kind::fanuc}, {m20ia(), Kind::motoman}};
  for (const auto& [robot, kind] : cases) {
    const InverseKinematics arm(robot);
    const VectorXd elsewhere = VectorXd::Zero(6);
    for (int round = 0; round < 300; ++round) {
      const VectorXd joints = random_joints(robot, random);
      // KUKA's turn bits contain only signs: they do not distinguish turns of an axis that can turn more than once.
      if (kind == Kind::kuka && joints.cwiseAbs().maxCoeff() > pi) continue;
      // No controller's words contain turns of axes 2 and 3.
      if (std::abs(joints[2]) > pi) continue;
      if (std::abs(joints[4]) < 0.05) continue;  // near the singular wrist q4 and q6 are not separable
      std::string reason;
      const auto found = arm.solve(arm.flange(joints), arm.configuration(joints, kind), elsewhere, reason);
      INFO(joints.transpose() << " " << arm.configuration(joints, kind).text() << " " << reason);
      REQUIRE(found.has_value());
      if (kind == Kind::kuka)
        CHECK(distance(arm.flange(*found), arm.flange(joints)) < pose_rounding * 100);
      else
        CHECK((*found - joints).cwiseAbs().maxCoeff() < 1e-5);
    }
  }
}

TEST_CASE("inverse kinematics: the words of the controllers at poses that can be checked by eye") {
  const InverseKinematics abb(irb6640()), kuka(kr16()), fanuc(m20ia());
  const auto at = [](std::vector<double> degrees) {
    VectorXd joints(6);
    for (int i = 0; i < 6; ++i) joints[i] = degrees[i] * pi / 180;
    return joints;
  };
  CHECK(abb.configuration(at({10, 0, 0, -20, 40, 100}), ArmConfiguration::Kind::abb).text() == "abb 0 -1 1 0");
  CHECK(abb.configuration(at({-100, 0, 0, 200, -40, -100}), ArmConfiguration::Kind::abb).text() == "abb -2 2 -2 1");
  CHECK(abb.configuration(at({0, -60, -150, 0, 30, 0}), ArmConfiguration::Kind::abb).numbers[3] >=
        4);  // inclined over backward
  // The home position of every KUKA: arm up, forearm forward.
  CHECK(kuka.configuration(at({0, -90, 90, 0, 0, 0}), ArmConfiguration::Kind::kuka).text() == "kuka 2 2");
  CHECK(kuka.configuration(at({-10, -90, 90, 0, -10, -5}), ArmConfiguration::Kind::kuka).text() == "kuka 6 51");
  // Fanuc's: the tool points down.
  CHECK(fanuc.configuration(at({0, 0, 0, 0, -90, 0}), ArmConfiguration::Kind::fanuc).text() == "fanuc NUT 0 0 0");
  CHECK(fanuc.configuration(at({0, 0, 0, 190, 90, -200}), ArmConfiguration::Kind::fanuc).text() == "fanuc FUT 0 1 -1");
  // The axes of a Motoman turn like Fanuc's.
  CHECK(fanuc.configuration(at({0, 0, 0, 0, -90, 0}), ArmConfiguration::Kind::motoman).text() == "motoman 0 0 0 0 0 0");
  CHECK(fanuc.configuration(at({0, 0, 0, 185, 90, -200}), ArmConfiguration::Kind::motoman).text() ==
        "motoman 1 0 0 1 1 0");
  const Frame down = fanuc.flange(at({0, 0, 0, 0, -90, 0}));
  CHECK((down.orientation * z + z).norm() < pose_rounding);
}

TEST_CASE(
    "inverse kinematics: a Motoman's wrist is given by axis R or by the sign of axis B, and any arm by its angles") {
  std::mt19937 random(23);
  const InverseKinematics arm(m20ia());
  const VectorXd elsewhere = VectorXd::Zero(6);
  for (int round = 0; round < 200; ++round) {
    const VectorXd joints = random_joints(m20ia(), random);
    if (std::abs(joints[2]) > pi || std::abs(joints[4]) < 0.05) continue;
    std::string reason;
    ArmConfiguration by_sign = arm.configuration(joints, ArmConfiguration::Kind::motoman);
    by_sign.numbers[0] = joints[4] < 0 ? 3 : 2;
    const auto found = arm.solve(arm.flange(joints), by_sign, elsewhere, reason);
    REQUIRE(found.has_value());
    CHECK((*found - joints).cwiseAbs().maxCoeff() < 1e-5);
    by_sign.numbers[0] = 5 - by_sign.numbers[0];  // the other wrist
    const auto other = arm.solve(arm.flange(joints), by_sign, elsewhere, reason);
    if (other) CHECK((*other)[4] * joints[4] < 0);
    const auto near =
        arm.solve(arm.flange(joints), arm.configuration(joints, ArmConfiguration::Kind::near), elsewhere, reason);
    REQUIRE(near.has_value());
    CHECK((*near - joints).cwiseAbs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("inverse kinematics: out of reach, out of limits and wrong geometry are reported") {
  const InverseKinematics arm(irb6640());
  std::string reason;
  Frame far = arm.flange(VectorXd::Zero(6));
  far.position.x() += 3;
  CHECK_FALSE(arm.solve(far, {}, VectorXd::Zero(6), reason).has_value());
  CHECK(reason == "is out of reach");
  VectorXd joints = VectorXd::Zero(6);
  joints[4] = 0.5;
  CHECK_FALSE(arm.solve(arm.flange(joints), *arm_configuration("abb 1 0 0 0"), joints, reason).has_value());
  CHECK(reason.starts_with("is not reached in configuration abb 1 0 0 0 (but in abb "));
  pipeline::Robot bent = irb6640();
  bent.joints[5].origin.z() = 0.05;
  CHECK(InverseKinematics(bent).unsupported() == "");
  CHECK(InverseKinematics(bent).without_closed_form() == "axes 4, 5 and 6 do not meet in one point");
}

namespace {

/// Returns the Universal Robots UR10 from facts of its data sheet (Denavit-Hartenberg, lengths in m). Its last three axes do
/// not meet: they are 115.7 mm and 92.2 mm apart.
pipeline::Robot ur10() {
  return robot_of({{{0, 0, .1273}, z, -360, 360},
                   {{0, .220941, 0}, y, -360, 360},
                   {{.612, -.1719, 0}, y, -180, 180},
                   {{.5723, 0, 0}, y, -360, 360},
                   {{0, .1149, 0}, -z, -360, 360},
                   {{0, 0, -.1157}, y, -360, 360}},
                  {-pi / 2, 0, 0});
}

/// Returns the same arm with right angles written as `right_angle`, such as 1.57, in its joints' frames.
pipeline::Robot rounded(pipeline::Robot robot, double right_angle) {
  robot.joints[3].orientation = {0, right_angle, 0};  // the following axes are written in a turned frame
  const Quaternion turned = from_roll_pitch_yaw({0, pi / 2, 0}).conjugate();
  robot.joints[3].axis = turned * robot.joints[3].axis;
  robot.joints[4].origin = turned * robot.joints[4].origin;
  robot.joints[4].axis = turned * robot.joints[4].axis;
  robot.joints[5].origin = turned * robot.joints[5].origin;
  robot.joints[5].axis = turned * robot.joints[5].axis;
  return robot;
}

constexpr double place_rounding = 1e-9;  // [m, rad]: NumericalInverse::rounding times lengths and external turns

}  // namespace

TEST_CASE("inverse kinematics: an arm whose wrist axes do not meet reaches every place that it can stand in") {
  std::mt19937 random(11);
  const InverseKinematics arm(ur10());
  REQUIRE(arm.unsupported() == "");
  REQUIRE(arm.without_closed_form() != "");
  const VectorXd elsewhere = VectorXd::Constant(6, 0.3);
  int own = 0;
  constexpr int rounds = 100;
  for (int round = 0; round < rounds; ++round) {
    const VectorXd joints = random_joints(ur10(), random);
    const Frame flange = arm.flange(joints);
    const std::vector<VectorXd> arms = arm.arms(flange, elsewhere);
    CHECK(arms.size() >= 1);
    bool found_own = false;
    for (const VectorXd& found : arms) {
      CHECK(distance(arm.flange(found), flange) < place_rounding);
      double off = 0;
      for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(std::remainder(found[i] - joints[i], 2 * pi)));
      found_own |= off < 1e-5;  // near a singularity the error is the root of the rounding
    }
    own += found_own;
    std::string reason;
    const auto near = arm.solve(flange, {}, joints, reason);  // the solution near its own angles is the same arm
    REQUIRE(near.has_value());
    CHECK((*near - joints).cwiseAbs().maxCoeff() < 1e-5);
  }
  CHECK(own >= rounds - 5);  // the search may miss an arm in a narrow region (numerical_inverse.h)
}

TEST_CASE(
    "inverse kinematics: a UR arm from ROS has the poses of its controller, whose base is turned by 180 degrees") {
  pipeline::Robot robot = ur10();
  robot.program_orientation = {0, 0, pi};
  robot.flange_position = {0, .0922, 0};
  robot.flange_orientation = {-pi / 2, pi, 0};
  const InverseKinematics arm(robot);
  // Denavit-Hartenberg as published by the maker: turn q and shift d along z, shift a and turn along x.
  const double d[] = {.1273, 0, 0, .163941, .1157, .0922}, a[] = {0, -.612, -.5723, 0, 0, 0},
               alpha[] = {pi / 2, 0, 0, pi / 2, -pi / 2, 0};
  std::mt19937 random(29);
  for (int round = 0; round < 50; ++round) {
    const VectorXd joints = random_joints(robot, random);
    Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 6; ++i)
      expected = expected * Eigen::AngleAxisd(joints[i], z) * Eigen::Translation3d(a[i], 0, d[i]) *
                 Eigen::AngleAxisd(alpha[i], x);
    const Frame found = arm.flange(joints);
    CHECK((found.position - expected.translation()).norm() < 1e-12);  // a dozen roundings of a metre
    CHECK((found.orientation.toRotationMatrix() - expected.linear()).norm() < 1e-12);
    std::string reason;
    const auto near = arm.solve(found, {}, joints, reason);
    REQUIRE(near.has_value());
    CHECK((*near - joints).cwiseAbs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("inverse kinematics: the iteration finds the arms that the closed form finds") {
  std::mt19937 random(17);
  const pipeline::Robot robot = irb6640();
  const InverseKinematics closed(robot);
  // The same arm by its axes at zero angles, as if the axes did not meet.
  std::array<Vector3, 6> points, axes;
  NumericalInverse::Angles lower, upper;
  Vector3 at = Vector3::Zero();
  for (int i = 0; i < 6; ++i) {
    points[i] = at += robot.joints[i].origin;
    axes[i] = robot.joints[i].axis;
    lower[i] = -pi;
    upper[i] = pi;
  }
  const NumericalInverse open(points, axes, closed.flange(VectorXd::Zero(6)), lower, upper);
  int expected = 0, found = 0;
  for (int round = 0; round < 40; ++round) {
    const VectorXd joints = random_joints(robot, random);
    const Frame flange = closed.flange(joints);
    CHECK(distance(open.flange(joints), flange) < pose_rounding);
    const auto arms = closed.arms(flange, joints);
    const auto sought = open.arms(flange, joints);
    const auto same = [](const auto& a, const auto& b) {
      double off = 0;
      for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(std::remainder(a[i] - b[i], 2 * pi)));
      return off < 1e-5;
    };
    for (const auto& one : sought)  // every solution found is correct
      CHECK(std::any_of(arms.begin(), arms.end(), [&](const auto& other) { return same(one, other); }));
    for (const auto& one : arms)
      found += std::any_of(sought.begin(), sought.end(), [&](const auto& other) { return same(one, other); });
    expected += static_cast<int>(arms.size());
  }
  CHECK(found > 0.97 * expected);  // numerical_inverse.h: some regions are narrow
}

TEST_CASE("inverse kinematics: a path is followed on its branch, there and back") {
  const InverseKinematics arm(ur10());
  const VectorXd begin = (VectorXd(6) << 0.2, -1.3, 1.6, -1.7, -1.4, 0.4).finished();
  const Frame start = arm.flange(begin);
  VectorXd joints = begin;
  std::string reason;
  const auto walk = [&](double from, double to) {
    constexpr int steps = 400;
    for (int k = 1; k <= steps; ++k) {
      Frame place = start;
      const double u = from + (to - from) * k / steps;
      place.position += u * Vector3(-0.3, 0.25, 0.2);
      const auto next = arm.follow(place, joints, reason);
      REQUIRE(next.has_value());
      CHECK((*next - joints).cwiseAbs().maxCoeff() < 0.02);
      CHECK(distance(arm.flange(*next), place) < place_rounding);
      joints = *next;
    }
  };
  walk(0, 1);
  CHECK((joints - begin).norm() > 0.1);
  walk(1, 0);
  CHECK((joints - begin).cwiseAbs().maxCoeff() < 1e-7);
}

TEST_CASE("inverse kinematics: singular arms are reported") {
  const InverseKinematics arm(ur10());
  CHECK(arm.singular((VectorXd(6) << 0, -1, 0, 0, 1, 0).finished()));  // the elbow is stretched
  CHECK(arm.singular((VectorXd(6) << 0, -1, 1, 0, 0, 0).finished()));  // axes 4 and 6 are parallel
  CHECK_FALSE(arm.singular((VectorXd(6) << 0, -1, 1, 0.5, 1, 0).finished()));
}

TEST_CASE(
    "inverse kinematics: right angles written by hand leave the arm solvable, and exact on the robot as "
    "written") {
  std::mt19937 random(23);
  for (const double right_angle : {1.57, 1.571, 1.5707, 1.57076, 1.570796, pi / 2}) {
    const pipeline::Robot robot = rounded(irb6640(), right_angle);
    const InverseKinematics arm(robot);
    INFO(right_angle);
    REQUIRE(arm.unsupported() == "");
    REQUIRE(arm.without_closed_form() == "");
    for (int round = 0; round < 50; ++round) {
      VectorXd joints = random_joints(robot, random);
      if (std::abs(joints[2]) > pi || std::abs(joints[4]) < 0.05) continue;
      const Frame flange = arm.flange(joints);
      std::string reason;
      const auto found =
          arm.solve(flange, arm.configuration(joints, ArmConfiguration::Kind::abb), VectorXd::Zero(6), reason);
      INFO(joints.transpose() << " " << reason);
      REQUIRE(found.has_value());
      CHECK(distance(arm.flange(*found), flange) < place_rounding);
      CHECK((*found - joints).cwiseAbs().maxCoeff() < 1e-5);
    }
  }
}

}  // namespace dresslife::sim
