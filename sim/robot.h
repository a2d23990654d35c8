// Where a serial robot's links are: forward kinematics, and the check of joint limits.
//
// (R1) F_0 = base,   F_k = F_{k-1} (o_k, R_k) (0, exp(q_k u_k)),   k = 1..J
// o_k: joint origin [m], R_k: its frame (roll, pitch, yaw about fixed axes x, y, z), u_k: unit axis, q_k:
// angle [rad]. The factor exp(q u) is the quaternion (cos q/2, u sin q/2), smooth in q over any number of
// turns, so a link's quaternion never jumps in sign along a motion.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/job.h"
#include "sim/rotation.h"

namespace dresslife::sim {

class RobotKinematics {
 public:
  /// Precondition: links = joints + 1 and every axis longer than 0 (the job reader checks both).
  explicit RobotKinematics(const pipeline::Robot& robot);

  int joints() const { return static_cast<int>(axis_.size()); }
  int links() const { return joints() + 1; }

  /// Frames of all links in the world at these joint angles [rad]. Precondition: one angle per joint, one
  /// frame per link.
  void link_frames(std::span<const double> joints, std::span<Frame> frames) const;

 private:
  Frame base_;
  std::vector<Frame> joint_frame_;  // (o_k, R_k)
  std::vector<Vector3> axis_;       // u_k
};

/// Quaternion of roll, pitch, yaw about the fixed axes x, y, z [rad]: yaw after pitch after roll.
Quaternion from_roll_pitch_yaw(const Vector3& angles);

/// Throws InputError at `where` when the number of angles is not the robot's or an angle [rad] lies outside
/// its joint's limits; names the joint, its angle and its limits in degrees. `what`: "waypoint 'home'".
void check_joint_limits(const pipeline::Robot& robot, std::span<const double> joints, const std::string& what,
                        const pipeline::Where& where);

/// Index of the link of this name; throws InputError at `where` with the names that exist.
int find_link(const pipeline::Robot& robot, const std::string& name, const pipeline::Where& where);

}  // namespace dresslife::sim
