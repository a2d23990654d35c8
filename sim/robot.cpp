#include "sim/robot.h"

#include <cassert>
#include <numbers>

namespace dresslife::sim {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Degrees in a file become radians and come back with a rounding error; a limit may be used to the full.
constexpr double limit_rounding = 1e-9;  // [rad]

}  // namespace

Quaternion from_roll_pitch_yaw(const Vector3& angles) {
  return rotation({0, 0, angles.z()}) * rotation({0, angles.y(), 0}) * rotation({angles.x(), 0, 0});
}

RobotKinematics::RobotKinematics(const pipeline::Robot& robot)
    : base_{robot.base_position, from_roll_pitch_yaw(robot.base_orientation)} {
  assert(robot.links.size() == robot.joints.size() + 1);
  for (const pipeline::Joint& joint : robot.joints) {
    assert(joint.axis.norm() > 0);
    joint_frame_.push_back({joint.origin, from_roll_pitch_yaw(joint.orientation)});
    axis_.push_back(joint.axis.normalized());
  }
}

void RobotKinematics::link_frames(std::span<const double> joints, std::span<Frame> frames) const {
  assert(joints.size() == axis_.size() && frames.size() == axis_.size() + 1);
  frames[0] = base_;
  for (size_t k = 0; k < axis_.size(); ++k) {  // (R1)
    const double half = joints[k] / 2;
    const Vector3 v = std::sin(half) * axis_[k];
    frames[k + 1] = frames[k] * joint_frame_[k];
    frames[k + 1].orientation *= Quaternion(std::cos(half), v.x(), v.y(), v.z());
  }
}

void check_joint_limits(const pipeline::Robot& robot, std::span<const double> joints, const std::string& what,
                        const pipeline::Where& where) {
  if (joints.size() != robot.joints.size())
    throw pipeline::InputError(
        where, fmt::format("{} has {} joint angles", what, joints.size()),
        fmt::format("{} has {} joints: give one angle for each", robot.name, robot.joints.size()));
  for (size_t k = 0; k < joints.size(); ++k) {
    const pipeline::Joint& joint = robot.joints[k];
    if (joints[k] >= joint.lower - limit_rounding && joints[k] <= joint.upper + limit_rounding) continue;
    throw pipeline::InputError(
        where,
        fmt::format("{} turns {} to {:.6g} deg (must be within {:.6g} .. {:.6g} deg)", what, joint.name,
                    joints[k] * degrees, joint.lower * degrees, joint.upper * degrees),
        fmt::format("move it inside the limits of {}", robot.name));
  }
}

int find_link(const pipeline::Robot& robot, const std::string& name, const pipeline::Where& where) {
  std::string names;
  for (size_t k = 0; k < robot.links.size(); ++k) {
    if (robot.links[k].name == name) return static_cast<int>(k);
    names += (k ? ", " : "") + robot.links[k].name;
  }
  throw pipeline::InputError(where, fmt::format("{} has no link '{}'", robot.name, name),
                             fmt::format("use one of {}", names));
}

}  // namespace dresslife::sim
