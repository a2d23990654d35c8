#include "pipeline/arm/other_arms.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/base/constants.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;

/// Returns the transform from the frame of the preceding link to that of the joint's link.
Isometry3d step_of(const Joint& joint, double angle) {
  Isometry3d step = Isometry3d::Identity();
  step.translate(joint.origin);
  step.rotate(from_roll_pitch_yaw(joint.orientation));
  step.rotate(Eigen::AngleAxisd(angle, joint.axis.normalized()));
  return step;
}

/// Returns the frame in which axis 4 turns, at angle 0 of axis 4. arm: axes 1 to 3.
Isometry3d forearm(const Robot& robot, const Vector3d& arm) {
  Isometry3d frame = Isometry3d::Identity();
  for (int k = 0; k < 3; ++k) frame = frame * step_of(robot.joints[static_cast<std::size_t>(k)], arm[k]);
  return frame * step_of(robot.joints[3], 0);
}

/// Returns the wrist's centre. It is on axis 4, so the angle of axis 4 has no effect.
Vector3d centre(const Robot& robot, const Vector3d& arm) { return forearm(robot, arm) * robot.joints[4].origin; }

/// Returns dc/dq by central differences. The functions are smooth, so with this step the error is that of rounding.
Matrix3d jacobian(const Robot& robot, const Vector3d& arm) {
  constexpr double h = 1e-5;
  Matrix3d columns;
  for (int k = 0; k < 3; ++k) {
    const Vector3d off = h * Vector3d::Unit(k);
    columns.col(k) = (centre(robot, arm + off) - centre(robot, arm - off)) / (2 * h);
  }
  return columns;
}

bool within_limits(const Robot& robot, std::size_t axis, double angle) {
  return angle >= robot.joints[axis].lower && angle <= robot.joints[axis].upper;
}

/// Solves for the arm from one start. std::nullopt: the target is not reached, or a limit of an axis is exceeded.
std::optional<Vector3d> arm_at(const Robot& robot, const Vector3d& target, Vector3d arm) {
  constexpr int most_steps = 30;
  constexpr double longest_step = 0.5, reached = 1e-9;  // [rad, m]
  for (int k = 0; k < most_steps; ++k) {
    const Vector3d off = target - centre(robot, arm);
    if (off.norm() < reached) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!within_limits(robot, axis, arm[static_cast<Eigen::Index>(axis)])) return std::nullopt;
      return arm;
    }
    const Vector3d step = jacobian(robot, arm).fullPivLu().solve(off);
    if (!step.allFinite()) return std::nullopt;
    arm += step * std::min(1.0, longest_step / step.norm());
  }
  return std::nullopt;
}

/// Returns starts such that each configuration of the arm is near to some of them.
std::vector<Vector3d> starts(const Robot& robot, double first) {
  constexpr int places = 6;
  const auto at = [&](std::size_t axis, int k) {
    const Joint& joint = robot.joints[axis];
    return joint.lower + (k + 0.5) / places * (joint.upper - joint.lower);
  };
  std::vector<Vector3d> all;
  for (const double turn : {0.0, -pi, pi})
    for (int i = 0; within_limits(robot, 0, first + turn) && i < places; ++i)
      for (int j = 0; j < places; ++j) all.emplace_back(first + turn, at(1, i), at(2, j));
  return all;
}

/// Returns (q4, q5, q6) nearest to `before` within the limits, among both solutions and whole turns. rotation: of the flange in
/// forearm().
std::optional<Vector3d> wrist_at(const Robot& robot, const Matrix3d& rotation, const Vector3d& before) {
  const Vector3d a = robot.joints[3].axis.normalized(), b = robot.joints[4].axis.normalized(), e = b.cross(a);
  const double sign = robot.joints[5].axis.dot(a) > 0 ? 1 : -1;
  const Vector3d tip = rotation * a;
  constexpr double aligned = 1e-9;  // axes 4 and 6 turn about one line, and axis 4 does not move
  const double lean = std::hypot(tip.dot(e), tip.dot(a.cross(e)));
  std::optional<Vector3d> nearest;
  for (const double side : {1.0, -1.0}) {
    const double four = lean < aligned ? before[0] : std::atan2(side * tip.dot(a.cross(e)), side * tip.dot(e));
    const double five = std::atan2(side * lean, tip.dot(a));
    const Matrix3d rest =
        (Eigen::AngleAxisd(four, a) * Eigen::AngleAxisd(five, b)).toRotationMatrix().transpose() * rotation;
    const double six = sign * std::atan2((rest * e).dot(a.cross(e)), (rest * e).dot(e));
    for (const double turn4 : {-2 * pi, 0.0, 2 * pi})
      for (const double turn6 : {-2 * pi, 0.0, 2 * pi}) {
        const Vector3d wrist(four + turn4, five, six + turn6);
        if (!within_limits(robot, 3, wrist[0]) || !within_limits(robot, 4, wrist[1]) ||
            !within_limits(robot, 5, wrist[2]))
          continue;
        if (!nearest || (wrist - before).norm() < (*nearest - before).norm()) nearest = wrist;
      }
  }
  return nearest;
}

}  // namespace

bool has_wrist(const Robot& robot) {
  constexpr double exact = 1e-6;
  if (robot.joints.size() != 6 || robot.axes() != 6) return false;
  const Joint &four = robot.joints[3], &five = robot.joints[4], &six = robot.joints[5];
  const Vector3d axis = four.axis.normalized();
  const auto along = [&](const Vector3d& v) { return v.cross(axis).norm() < exact; };
  return five.orientation.norm() < exact && six.orientation.norm() < exact && along(six.axis) &&
         std::abs(five.axis.dot(axis)) < exact && along(five.origin) && along(six.origin);
}

std::vector<OtherArm> other_arms(const Robot& robot, const std::vector<double>& joints) {
  constexpr double apart = 0.02;  // [rad]: nearer ones count as equal
  const Vector3d arm(joints[0], joints[1], joints[2]), wrist(joints[3], joints[4], joints[5]);
  Matrix3d rotation = forearm(robot, arm).linear();
  for (std::size_t k = 3; k < 6; ++k)
    rotation = rotation * Eigen::AngleAxisd(joints[k], robot.joints[k].axis.normalized());
  const Vector3d target = centre(robot, arm);
  const double side = jacobian(robot, arm).determinant();
  std::vector<Vector3d> known{arm};
  std::vector<OtherArm> others;
  for (const Vector3d& start : starts(robot, joints[0])) {
    const std::optional<Vector3d> found = arm_at(robot, target, start);
    if (!found) continue;
    const auto same = [&](const Vector3d& one) { return (one - *found).cwiseAbs().maxCoeff() < apart; };
    if (std::ranges::any_of(known, same)) continue;
    known.push_back(*found);
    const std::optional<Vector3d> turned =
        wrist_at(robot, forearm(robot, *found).linear().transpose() * rotation, wrist);
    if (!turned) continue;
    const bool round = std::cos((*found)[0] - arm[0]) < 0;
    const bool flipped = (jacobian(robot, *found).determinant() * side < 0) != round;
    const std::string_view what = arm_configurations[round ? (flipped ? 2 : 1) : flipped ? 0 : 3];
    others.push_back({what, {(*found)[0], (*found)[1], (*found)[2], (*turned)[0], (*turned)[1], (*turned)[2]}});
  }
  return others;
}

}  // namespace dresslife::pipeline
