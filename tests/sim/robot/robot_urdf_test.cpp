// A robot written as URDF and read again has the same poses, with any fixed joints in between.
#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "pipeline/resolve/catalogue.h"
#include "pipeline/settings/fields.h"
#include "pipeline/urdf/urdf.h"
#include "sim/robot/robot.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
void describe(Fields& f, Robot& robot);
}

namespace dresslife::sim {
namespace {

constexpr double rounding = 1e-9;  // the URDF below is written with 12 digits

std::string numbers(const Vector3& v) { return fmt::format("{:.12g} {:.12g} {:.12g}", v.x(), v.y(), v.z()); }

/// Returns the robot as URDF. Before every joint is a fixed joint with a random part of its origin.
std::string urdf_of(const pipeline::Robot& robot, std::mt19937& random) {
  std::string text = "<robot name=\"copy\">\n<link name=\"root\"/>\n";
  std::string parent = "root";
  std::uniform_real_distribution<double> part(-1, 1);
  for (const pipeline::Joint& joint : robot.joints) {
    const Vector3 angles{part(random), part(random), part(random)}, shift{part(random), part(random), part(random)};
    // F = (shift, angles) rest: the moved joint compensates the fixed joint.
    const Frame fixed{shift, from_roll_pitch_yaw(angles)};
    const Quaternion back = fixed.orientation.conjugate();
    const Frame whole{joint.origin, from_roll_pitch_yaw(joint.orientation)};
    const Frame rest{back * Vector3(whole.position - shift), back * whole.orientation};
    const Eigen::Matrix3d r = rest.orientation.toRotationMatrix();
    const Vector3 rpy{std::atan2(r(2, 1), r(2, 2)), std::asin(-r(2, 0)), std::atan2(r(1, 0), r(0, 0))};
    text += fmt::format(
        "<link name=\"{0}_plate\"/>\n<joint name=\"{0}_bolts\" type=\"fixed\"><parent link=\"{1}\"/>"
        "<child link=\"{0}_plate\"/><origin xyz=\"{2}\" rpy=\"{3}\"/></joint>\n"
        "<link name=\"{0}_link\"/>\n<joint name=\"{0}\" type=\"revolute\"><parent link=\"{0}_plate\"/>"
        "<child link=\"{0}_link\"/><origin xyz=\"{4}\" rpy=\"{5}\"/><axis xyz=\"{6}\"/>"
        "<limit lower=\"{7:.12g}\" upper=\"{8:.12g}\" effort=\"0\" velocity=\"{9:.12g}\"/></joint>\n",
        joint.name, parent, numbers(shift), numbers(angles), numbers(rest.position), numbers(rpy), numbers(joint.axis),
        joint.lower, joint.upper, joint.speed);
    parent = joint.name + "_link";
  }
  return text + fmt::format(
                    "<link name=\"tool0\"/>\n<joint name=\"end\" type=\"fixed\"><parent link=\"{}\"/>"
                    "<child link=\"tool0\"/><origin xyz=\"{}\" rpy=\"{}\"/></joint>\n</robot>\n",
                    parent, numbers(robot.flange_position), numbers(robot.flange_orientation));
}

Frame flange(const pipeline::Robot& robot, const std::vector<double>& axes) {
  std::vector<Frame> frames(robot.links.size());
  RobotKinematics(robot).link_frames(axes, frames);
  return frames.back() * Frame{robot.flange_position, from_roll_pitch_yaw(robot.flange_orientation)};
}

}  // namespace

TEST_CASE("robot urdf: a shipped robot written as URDF reads back to the same frames and limits") {
  std::mt19937 random(5);
  for (const char* name : {"abb_irb6640_185_280", "kuka_kr210_l150", "fanuc_m20ia", "motoman_ms210"}) {
    CAPTURE(name);
    pipeline::Robot robot, copy;
    pipeline::read_fields(pipeline::catalogue_entry("robots", name, {}, {}), robot);
    pipeline::UrdfRequest request;
    request.urdf = "copy.urdf";
    request.accelerations.assign(6, 1);
    pipeline::read_fields(pipeline::robot_from_urdf(request, urdf_of(robot, random)), copy);
    REQUIRE(copy.joints.size() == 6);
    for (int round = 0; round < 50; ++round) {
      std::vector<double> axes;
      for (const pipeline::Joint& joint : robot.joints)
        axes.push_back(std::uniform_real_distribution<double>(joint.lower, joint.upper)(random));
      const Frame expected = flange(robot, axes), read = flange(copy, axes);
      CHECK((read.position - expected.position).norm() < rounding);
      CHECK(rotation_vector(read.orientation.conjugate() * expected.orientation).norm() < rounding);
    }
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(copy.joints[k].lower == Approx(robot.joints[k].lower).epsilon(rounding));
      CHECK(copy.joints[k].speed == Approx(robot.joints[k].speed).epsilon(rounding));
    }
  }
}

TEST_CASE("robot urdf: the frame of the programs is link `base`, however many fixed joints away and turned") {
  std::mt19937 random(7);
  pipeline::Robot robot, copy;
  pipeline::read_fields(pipeline::catalogue_entry("robots", "abb_irb6640_185_280", {}, {}), robot);
  std::string text = urdf_of(robot, random);
  const std::string frame =
      "<link name=\"stand\"/><joint name=\"bolts\" type=\"fixed\"><parent link=\"root\"/><child link=\"stand\"/>"
      "<origin xyz=\"0 0 0.5\" rpy=\"0 0 1.5707963267948966\"/></joint>"
      "<link name=\"base\"/><joint name=\"dowel\" type=\"fixed\"><parent link=\"stand\"/><child link=\"base\"/>"
      "<origin xyz=\"0.2 0 0.1\" rpy=\"0 0 1.5707963267948966\"/></joint></robot>";
  text.replace(text.rfind("</robot>"), std::string::npos, frame);
  pipeline::UrdfRequest request;
  request.urdf = "copy.urdf";
  request.accelerations.assign(6, 1);
  pipeline::read_fields(pipeline::robot_from_urdf(request, text), copy);
  // 0.2 m along the stand's x, which is the root's y; half a turn in total.
  CHECK((copy.program_base - Vector3(0, 0.2, 0.6)).norm() < rounding);
  CHECK((copy.program_orientation - Vector3(0, 0, std::numbers::pi)).norm() < rounding);
}

TEST_CASE("robot urdf: a joint that follows another keeps the wrist level") {
  // A parallelogram: a joint before the hand compensates the angles of joints 2 and 3.
  pipeline::Robot robot;
  const auto joint = [&](const char* name, const Vector3& origin, const Vector3& axis) {
    pipeline::Joint made;
    made.name = name;
    made.origin = origin;
    made.axis = axis;
    robot.joints.push_back(made);
  };
  joint("turn", {0, 0, 0.5}, Vector3::UnitZ());
  joint("lift", {0.3, 0, 0}, Vector3::UnitY());
  joint("arm", {0, 0, 1}, Vector3::UnitY());
  robot.joints.back().follows = "lift";
  robot.joints.back().ratio = -1;
  robot.joints.back().offset = 0.2;
  joint("hand", {1, 0, 0}, Vector3::UnitZ());
  robot.links.resize(5);
  CHECK(robot.axes() == 3);
  CHECK(axes_of(robot)[2].name == "hand");
  const Frame end = flange(robot, {0, 0.7, 0});
  CHECK((end.position - Vector3(0.3 + std::sin(0.7) + std::cos(0.2), 0, 0.5 + std::cos(0.7) - std::sin(0.2))).norm() <
        1e-14);  // a few roundings
  CHECK((rotation_vector(end.orientation) - Vector3(0, 0.2, 0)).norm() < 1e-14);
}

TEST_CASE("robot urdf: a track carries the base from the world on") {
  pipeline::Robot robot;
  pipeline::read_fields(pipeline::catalogue_entry("robots", "kuka_kr16_2", {}, {}), robot);
  const std::vector<double> pose{0.1, -1.2, 1.0, 0.3, 0.4, 0.5};
  const Frame standing = flange(robot, pose);
  pipeline::ExternalAxis track;
  track.name = "track";
  track.orientation = {0, 0, std::numbers::pi / 2};  // along the world's y
  track.origin = {0, 0, 0.4};
  robot.external_axes = {track};
  std::vector<double> axes = pose;
  axes.push_back(2.5);
  const Frame moved = flange(robot, axes);
  // The track's frame turns the robot by 90 deg about z: (x, y) becomes (-y, x).
  const Vector3 expected{-standing.position.y(), standing.position.x() + 2.5, standing.position.z() + 0.4};
  CHECK((moved.position - expected).norm() < 1e-14);
  CHECK(axes_of(robot)[6].turns == false);
}

}  // namespace dresslife::sim
