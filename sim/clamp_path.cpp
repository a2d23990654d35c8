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
      free_tool_end_(job.routing.tool_end == pipeline::ToolEnd::free),
      mounting_pose_(motion_.position(0)) {
  const auto add = [&](const pipeline::Clamp& clamp) {
    clamp_links_.push_back(find_link(job.robot, clamp.link, clamp.where));
    clamps_.push_back(clamp_frame(clamp));
  };
  add(*job.routing.base_clamp);
  for (const pipeline::IntermediateClamp& between : job.routing.clamps) add(between.clamp);
  if (!free_tool_end_) add(*job.routing.tool_clamp);
  for (const pipeline::GuideRing& ring : job.routing.rings) {
    ring_links_.push_back(find_link(job.robot, ring.link, ring.where));
    rings_.push_back(clamp_frame({ring.link, ring.position, ring.direction, {}, ring.where}));
  }
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
  const auto placed = [&](size_t k) { return pose.links[clamp_links_[k]] * clamps_[k]; };
  const size_t last = clamps_.size() - (free_tool_end_ ? 0 : 1);
  pose.clamps.base = placed(0);
  for (size_t k = 1; k < last; ++k) pose.clamps.between.insert(pose.clamps.between.end(), 2, placed(k));
  pose.clamps.tool = placed(clamps_.size() - 1);  // a free end has none of its own and does not use it
  for (size_t k = 0; k < rings_.size(); ++k) pose.rings.push_back(pose.links[ring_links_[k]] * rings_[k]);
  return pose;
}

void RobotPath::turn_clamp(int k, double roll) { clamps_[k] = rolled(clamps_[k], roll); }

}  // namespace dresslife::sim
