// Forward kinematics of a serial robot's links, and the check of joint limits.
//
// (R1) F_0 = tracks base,   F_k = F_{k-1} (o_k, R_k) (0, exp(q_k u_k)),   k = 1..J
// o_k: joint origin [m], R_k: its frame (roll, pitch, yaw about fixed axes x, y, z), u_k: unit axis, q_k:
// angle [rad]. The factor exp(q u) is the quaternion (cos q/2, u sin q/2), smooth in q over any number of
// turns, so a link's quaternion never changes its sign by a jump along a motion. A joint that follows joint j has
// q_k = ratio q_j + offset. tracks: for each external axis that carries the robot, (o, R) and its translation or
// rotation.
//
// Order of the axes of a robot in all functions: its driven joints, then its external axes [rad, m].
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// A driven axis: a joint [rad], or an external axis [rad or m].
struct Axis {
  std::string name;
  bool turns = true;
  double lower = 0, upper = 0, speed = 0, acceleration = 0;
};

std::vector<Axis> axes_of(const pipeline::Robot& robot);

class RobotKinematics {
 public:
  /// Precondition: links = joints + 1 and every axis longer than 0 (the job reader checks both).
  explicit RobotKinematics(const pipeline::Robot& robot);

  int axes() const { return axes_; }
  int links() const { return static_cast<int>(joints_.size()) + 1; }

  /// Computes the frames of all links in the world. Precondition: one value per axis, one frame per link.
  void link_frames(std::span<const double> axes, std::span<Frame> frames) const;

 private:
  struct Moving {
    Frame frame;   // (o_k, R_k)
    Vector3 axis;  // u_k
    int source;    // index of the axis that moves it
    double ratio = 1, offset = 0;
    bool turns = true;

    Frame at(std::span<const double> axes) const;
  };
  Frame base_;
  std::vector<Moving> tracks_, joints_;
  int axes_ = 0;
};

/// Returns the quaternion of roll, pitch, yaw about the fixed axes x, y, z [rad]: yaw after pitch after roll.
Quaternion from_roll_pitch_yaw(const Vector3& angles);

struct LimitFault {
  std::string what, remedy;
  int axis = -1;      ///< driven axis; -1: another number of angles than the robot has axes
  double excess = 0;  ///< [rad]
};

/// Tolerance of a joint limit for rounding errors [rad, m]: degrees and millimetres in a file become radians and metres,
/// and come back with a rounding error. The full range of a joint may be used.
constexpr double limit_rounding = 1e-9;

/// Returns the reason why these angles [rad] are not valid for the robot: another number than its driven joints, or
/// an angle outside its joint's limits, with angle and limits in degrees. Absent: they are valid. `what`: "waypoint 'home'".
std::optional<LimitFault> limit_fault(const pipeline::Robot& robot, std::span<const double> joints,
                                      const std::string& what);
/// Returns such a fault for each axis outside of its limits.
std::vector<LimitFault> limit_faults(const pipeline::Robot& robot, std::span<const double> joints,
                                     const std::string& what);

/// Throws the fault of limit_fault() as InputError at `where`.
void check_joint_limits(const pipeline::Robot& robot, std::span<const double> joints, const std::string& what,
                        const pipeline::Where& where);

/// Returns the index of the link of this name. Errors: InputError at `where` with the existing names.
int find_link(const pipeline::Robot& robot, const std::string& name, const pipeline::Where& where);

}  // namespace dresslife::sim
