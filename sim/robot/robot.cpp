#include "sim/robot/robot.h"

#include <cassert>
#include <map>
#include <numbers>

namespace dresslife::sim {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

}  // namespace

Quaternion from_roll_pitch_yaw(const Vector3& angles) {
  return rotation({0, 0, angles.z()}) * rotation({0, angles.y(), 0}) * rotation({angles.x(), 0, 0});
}

std::vector<Axis> axes_of(const pipeline::Robot& robot) {
  std::vector<Axis> axes;
  for (const pipeline::Joint& joint : robot.joints)
    if (joint.follows.empty())
      axes.push_back({joint.name, true, joint.lower, joint.upper, joint.speed, joint.acceleration});
  for (const pipeline::ExternalAxis& axis : robot.external_axes)
    axes.push_back({axis.name, axis.kind == pipeline::ExternalAxis::Kind::rotary, axis.lower, axis.upper, axis.speed,
                    axis.acceleration});
  return axes;
}

RobotKinematics::RobotKinematics(const pipeline::Robot& robot)
    : base_{robot.base_position, from_roll_pitch_yaw(robot.base_orientation)} {
  assert(robot.links.size() == robot.joints.size() + 1);
  std::map<std::string, int> driver;
  for (const pipeline::Joint& joint : robot.joints) {
    assert(joint.axis.norm() > 0);
    const Frame frame{joint.origin, from_roll_pitch_yaw(joint.orientation)};
    joints_.push_back({frame, joint.axis.normalized(), axes_, joint.ratio, joint.offset});
    if (!joint.follows.empty()) continue;
    joints_.back().ratio = 1, joints_.back().offset = 0;
    driver[joint.name] = axes_++;
  }
  for (size_t k = 0; k < joints_.size(); ++k)
    if (const std::string& name = robot.joints[k].follows; !name.empty()) joints_[k].source = driver.at(name);
  for (const pipeline::ExternalAxis& axis : robot.external_axes) {
    const int source = axes_++;
    if (axis.carries == pipeline::ExternalAxis::Carries::robot)
      tracks_.push_back({{axis.origin, from_roll_pitch_yaw(axis.orientation)},
                         axis.axis.normalized(),
                         source,
                         1,
                         0,
                         axis.kind == pipeline::ExternalAxis::Kind::rotary});
  }
}

Frame RobotKinematics::Moving::at(std::span<const double> axes) const {
  const double q = ratio * axes[source] + offset;
  if (!turns) return frame * Frame{q * axis, Quaternion::Identity()};
  const Vector3 v = std::sin(q / 2) * axis;
  Frame moved = frame;
  moved.orientation *= Quaternion(std::cos(q / 2), v.x(), v.y(), v.z());
  return moved;
}

void RobotKinematics::link_frames(std::span<const double> axes, std::span<Frame> frames) const {
  assert(static_cast<int>(axes.size()) == axes_ && static_cast<int>(frames.size()) == links());
  Frame on_track;
  for (const Moving& track : tracks_) on_track = on_track * track.at(axes);
  frames[0] = on_track * base_;
  for (size_t k = 0; k < joints_.size(); ++k) frames[k + 1] = frames[k] * joints_[k].at(axes);  // (R1)
}

std::optional<LimitFault> limit_fault(const pipeline::Robot& robot, std::span<const double> joints,
                                      const std::string& what) {
  const std::vector<LimitFault> faults = limit_faults(robot, joints, what);
  return faults.empty() ? std::nullopt : std::optional(faults.front());
}

std::vector<LimitFault> limit_faults(const pipeline::Robot& robot, std::span<const double> joints,
                                     const std::string& what) {
  const std::vector<Axis> axes = axes_of(robot);
  if (joints.size() != robot.axes())
    return {{fmt::format("{} has {} joint angles", what, joints.size()),
             fmt::format("{} has {} axes: give one angle for each", robot.name, robot.axes())}};
  std::vector<LimitFault> faults;
  for (size_t k = 0; k < joints.size(); ++k) {
    const Axis& axis = axes[k];
    if (joints[k] >= axis.lower - limit_rounding && joints[k] <= axis.upper + limit_rounding) continue;
    const bool above = joints[k] > axis.upper;
    const double excess = above ? joints[k] - axis.upper : axis.lower - joints[k];
    faults.push_back({fmt::format("{} turns {} to {:.6g} deg (must be within {:.6g} .. {:.6g} deg)", what, axis.name,
                                  joints[k] * degrees, axis.lower * degrees, axis.upper * degrees),
                      fmt::format("turn it {:.4g} deg {}, inside the limits of {}", degrees * excess,
                                  above ? "less" : "more", robot.name),
                      static_cast<int>(k), excess});
  }
  return faults;
}

void check_joint_limits(const pipeline::Robot& robot, std::span<const double> joints, const std::string& what,
                        const pipeline::Where& where) {
  if (const auto fault = limit_fault(robot, joints, what))
    throw pipeline::InputError(where, fault->what, fault->remedy);
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
