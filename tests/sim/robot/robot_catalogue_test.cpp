// The shipped robots: the reach in their names, their zero poses, and the arm that each maker's configuration words select.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "pipeline/base/constants.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/urdf_request.h"
#include "pipeline/settings/fields.h"
#include "sim/robot/inverse_kinematics.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
void describe(Fields& f, Robot& robot);
}

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

pipeline::Robot shipped(const std::string& name) {
  pipeline::Robot robot;
  pipeline::read_fields(pipeline::catalogue_entry("robots", name, {}, {}), robot);
  return robot;
}

/// Makers measure reach horizontally from axis 1 to the wrist centre (axis 5), at its maximum within the joint limits.
struct Shipped {
  const char* name;
  double reach;     ///< according to the type's name [m]
  double rounding;  ///< of its last digit [m]
  ArmConfiguration::Kind words;
};

const Shipped robots[] = {
    {"abb_irb6640_185_280", 2.80, 0.005, ArmConfiguration::Kind::abb},
    {"abb_irb6700_235_265", 2.65, 0.005, ArmConfiguration::Kind::abb},
    {"abb_irb4600_60_205", 2.05, 0.005, ArmConfiguration::Kind::abb},
    {"abb_irb2600_12_165", 1.65, 0.005, ArmConfiguration::Kind::abb},
    {"kuka_kr210_l150", 3.100, 0.005, ArmConfiguration::Kind::kuka},  // "3100 mm", rounded to 10 mm
    {"kuka_kr16_2", 1.611, 0.0005, ArmConfiguration::Kind::kuka},
    {"fanuc_m20ia", 1.811, 0.001, ArmConfiguration::Kind::fanuc},     // 1811.6 mm: the digits are truncated
    {"motoman_ms210", 2.702, 0.0005, ArmConfiguration::Kind::fanuc},  // tested with Fanuc's words: the axes turn alike
};

double wrist_distance(const RobotKinematics& robot, VectorXd& joints, std::vector<Frame>& frames) {
  robot.link_frames({joints.data(), 6}, frames);
  return std::hypot(frames[5].position.x() - frames[1].position.x(), frames[5].position.y() - frames[1].position.y());
}

/// Returns the maximum over axes 2 and 3, by a grid and then finer and finer grids around its best point.
double reach_of(const pipeline::Robot& description) {
  const RobotKinematics robot(description);
  std::vector<Frame> frames(7);
  VectorXd joints = VectorXd::Zero(6);
  const auto& axes = description.joints;
  double low[] = {axes[1].lower, axes[2].lower}, high[] = {axes[1].upper, axes[2].upper};
  double best = 0, at[2] = {0, 0};
  for (int round = 0; round < 6; ++round) {
    constexpr int points = 60;
    for (int i = 0; i <= points; ++i)
      for (int k = 0; k <= points; ++k) {
        joints[1] = low[0] + (high[0] - low[0]) * i / points;
        joints[2] = low[1] + (high[1] - low[1]) * k / points;
        if (const double reach = wrist_distance(robot, joints, frames); reach > best)
          best = reach, at[0] = joints[1], at[1] = joints[2];
      }
    for (int axis = 0; axis < 2; ++axis) {
      const double span = (high[axis] - low[axis]) / 20;
      low[axis] = std::max(axes[axis + 1].lower, at[axis] - span);
      high[axis] = std::min(axes[axis + 1].upper, at[axis] + span);
    }
  }
  return best;
}

double pose_distance(const Frame& a, const Frame& b) {
  return (a.position - b.position).norm() + rotation_vector(a.orientation.conjugate() * b.orientation).norm();
}

}  // namespace

TEST_CASE(
    "shipped robots: the range of accelerations that dresslife new names is that of the catalogue, rounded outward") {
  double least = HUGE_VAL, largest = 0;
  for (const Shipped& each : robots)
    for (const pipeline::Joint& joint : shipped(each.name).joints)
      least = std::min(least, joint.acceleration / degree), largest = std::max(largest, joint.acceleration / degree);
  double low = 0, high = 0;
  std::string words = pipeline::shipped_accelerations;
  std::erase(words, ',');
  REQUIRE(std::sscanf(words.c_str(), "%lf to %lf deg/s2", &low, &high) == 2);
  CHECK((low <= least * 1.001 && low > 0.9 * least));  // rounded to three digits
  CHECK((high >= largest * 0.999 && high < 1.1 * largest));
}

TEST_CASE("shipped robots: each reaches as far as its name says") {
  for (const Shipped& robot : robots) {
    CAPTURE(robot.name);
    CHECK(reach_of(shipped(robot.name)) == Approx(robot.reach).margin(robot.rounding).epsilon(0));
  }
}

TEST_CASE("shipped robots: the maker's zero pose stands as in its drawings") {
  const auto wrist = [](const char* name, std::vector<double> degrees) {
    VectorXd joints(6);
    for (int i = 0; i < 6; ++i) joints[i] = degrees[i] * degree;
    std::vector<Frame> frames(7);
    RobotKinematics(shipped(name)).link_frames({joints.data(), 6}, frames);
    return frames[5].position;
  };
  constexpr double drawing = 1e-3;  // KR 210: its origins were measured to some tenths of a millimetre
  // A KUKA at A1 .. A6 = 0 is stretched forward: 350 + 1250 + 1500 mm, with axis 4 55 mm above the elbow. A3 = +90 brings the
  // forearm upright with axis 4 below.
  CHECK((wrist("kuka_kr210_l150", {0, 0, 0, 0, 0, 0}) - Vector3(0.350 + 1.250 + 1.500, 0, 0.750 - 0.055)).norm() <
        drawing);
  CHECK((wrist("kuka_kr210_l150", {0, -90, 90, 0, 0, 0}) - Vector3(0.350 + 1.500, 0, 0.750 + 1.250 - 0.055)).norm() <
        drawing);
  // A1 turns clockwise seen from above.
  CHECK(wrist("kuka_kr210_l150", {90, 0, 0, 0, 0, 0}).y() < -3);
  CHECK((wrist("kuka_kr16_2", {0, 0, 0, 0, 0, 0}) - Vector3(0.26 + 0.68 + 0.67, 0, 0.675 - 0.035)).norm() < 1e-12);
  // ABB, Fanuc and Motoman are upright at 0, with the forearm forward.
  CHECK((wrist("abb_irb4600_60_205", {0, 0, 0, 0, 0, 0}) - Vector3(0.175 + 0.96, 0, 0.495 + 0.9 + 0.175)).norm() <
        1e-12);
  CHECK((wrist("fanuc_m20ia", {0, 0, 0, 0, 0, 0}) - Vector3(0.15 + 0.835, 0, 0.525 + 0.79 + 0.25)).norm() < 1e-12);
  // Fanuc's elbow turns the other way: positive joint_3 lifts the forearm.
  CHECK(wrist("fanuc_m20ia", {0, 0, 30, 0, 0, 0}).z() > wrist("fanuc_m20ia", {0, 0, 0, 0, 0, 0}).z());
}

TEST_CASE("shipped robots: the maker's configuration words bring back the arm with its turns") {
  std::mt19937 random(11);
  constexpr double pose_rounding = 1e-9;   // metres and radians, arms of 3 m
  constexpr double joint_rounding = 1e-6;  // [rad]: acos near its limits halves the number of digits
  constexpr double clear = 0.01;  // distance from configurations where the words change or two arms coincide [rad]
  for (const Shipped& type : robots) {
    CAPTURE(type.name);
    const pipeline::Robot robot = shipped(type.name);
    const InverseKinematics arm(robot);
    REQUIRE(arm.unsupported() == "");
    int compared = 0;
    for (int round = 0; round < 200; ++round) {
      VectorXd joints(6), elsewhere(6);
      bool near_edge = false;
      for (int i = 0; i < 6; ++i) {
        std::uniform_real_distribution<double> angle(robot.joints[i].lower, robot.joints[i].upper);
        joints[i] = angle(random);
        elsewhere[i] = angle(random);
        near_edge |= std::abs(std::remainder(joints[i], std::numbers::pi / 2)) < clear;
      }
      // No controller's words contain the turns of axis 3, which can turn more than once on the M-20iA.
      elsewhere[2] = joints[2];
      std::string reason;
      const Frame flange = arm.flange(joints);
      const auto found = arm.solve(flange, arm.configuration(joints, type.words), elsewhere, reason);
      CAPTURE(joints.transpose(), reason);
      REQUIRE(found);
      CHECK(pose_distance(arm.flange(*found), flange) < pose_rounding);
      CHECK(arm.configuration(*found, type.words) == arm.configuration(joints, type.words));
      if (near_edge) continue;
      ++compared;
      CHECK((*found - joints).lpNorm<Eigen::Infinity>() < joint_rounding);
    }
    CHECK(compared > 100);
  }
}

}  // namespace dresslife::sim
