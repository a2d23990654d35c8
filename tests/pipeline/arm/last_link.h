// Forward kinematics in a few lines, a reference for the project's own.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "pipeline/job/robot.h"

namespace dresslife::pipeline {

/// Returns the pose of the last link, computed from the joints only.
inline Eigen::Isometry3d pose(const Robot& robot, const std::vector<double>& joints) {
  Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const Joint& joint = robot.joints[k];
    at.translate(joint.origin);
    at.rotate(Eigen::AngleAxisd(joint.orientation.z(), Vector3d::UnitZ()) *
              Eigen::AngleAxisd(joint.orientation.y(), Vector3d::UnitY()) *
              Eigen::AngleAxisd(joint.orientation.x(), Vector3d::UnitX()));
    at.rotate(Eigen::AngleAxisd(joints[k], joint.axis.normalized()));
  }
  return at;
}

}  // namespace dresslife::pipeline
