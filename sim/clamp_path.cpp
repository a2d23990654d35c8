#include "sim/clamp_path.h"

#include <cassert>

#include "sim/program/import.h"

namespace dresslife::sim {

Frame clamp_frame(const pipeline::Clamp& clamp) {
  constexpr double nearly_parallel = 0.99;  // cos 8 deg
  const Vector3 z = clamp.direction.normalized();
  const Vector3 reference = std::abs(z.z()) < nearly_parallel ? Vector3::UnitZ() : Vector3::UnitX();
  Matrix3 axes;
  axes.col(0) = (reference - reference.dot(z) * z).normalized();  // (R3)
  axes.col(1) = z.cross(axes.col(0));
  axes.col(2) = z;
  return rolled({clamp.position, Quaternion(axes)}, clamp.roll.value_or(0));
}

RobotPath::RobotPath(const pipeline::Job& job)
    : kinematics_(job.robot),
      motion_(resolved_motion(job.motion), job.robot),
      base_link_(find_link(job.robot, job.routing.base_clamp->link, job.routing.base_clamp->where)),
      tool_link_(find_link(job.robot, job.routing.tool_clamp->link, job.routing.tool_clamp->where)),
      base_clamp_(clamp_frame(*job.routing.base_clamp)),
      tool_clamp_(clamp_frame(*job.routing.tool_clamp)),
      mounting_pose_(motion_.position(0)) {
  const std::vector<double>& mounting = job.routing.mounting_pose;
  if (mounting.empty()) return;
  check_joint_limits(job.robot, mounting, "routing.mounting_pose_deg", job.routing.where);
  mounting_pose_.head(static_cast<long>(mounting.size())) =  // external axes: as at the start
      Eigen::Map<const Eigen::VectorXd>(mounting.data(), static_cast<long>(mounting.size()));
}

Pose RobotPath::pose(const Eigen::VectorXd& joints) const {
  Pose pose;
  pose.joints = joints;
  pose.links.resize(kinematics_.links());
  kinematics_.link_frames({joints.data(), static_cast<size_t>(joints.size())}, pose.links);
  pose.clamps = {pose.links[base_link_] * base_clamp_, pose.links[tool_link_] * tool_clamp_};
  return pose;
}

void RobotPath::turn_tool_clamp(double roll) { tool_clamp_ = rolled(tool_clamp_, roll); }

}  // namespace dresslife::sim
