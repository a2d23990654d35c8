// Poses of the clamps and of the robot's links at any time of a motion: from a robot and its routing, or
// from a file of recorded clamp poses.
//
// (R2) clamp = F_link (p, R_clamp): p [m] and the direction d are in the link's frame, and the z axis of
//      R_clamp is d.
// (R3) The x axis of R_clamp at roll 0 is e - (e d) d, normalised; e is the link's z axis, or its x axis
//      if d is within 8 deg of z. Roll is a rotation about d.
// (R4) A recorded pose between its rows: a C2 cubic spline (spline.h) through the positions and one through
//      the quaternions' four components, normalised: q = s/|s|. The signs of the rows' quaternions are chosen so that
//      neighbours are closest. For rows at distance h the error is of order h^4, as is 1 - |s|.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/job/motion.h"
#include "pipeline/job/robot.h"
#include "pipeline/job/routing.h"
#include "sim/contact/contact.h"
#include "sim/robot/motion.h"
#include "sim/robot/robot.h"
#include "sim/robot/spline.h"
#include "sim/rod/rod.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// Poses that a motion prescribes at one time.
struct Pose {
  ClampFrames clamps;
  std::vector<Frame> links;  ///< links of the robot; empty without a robot
  std::vector<Frame> rings;  ///< guide rings, z = their axes
  Eigen::VectorXd joints;    ///< axes of the robot, then its external axes (robot.h); empty without a robot
};

class ClampPath {
 public:
  virtual ~ClampPath() = default;
  virtual double duration() const = 0;  ///< [s], from time 0
  virtual Pose at(double time) const = 0;
  virtual int step(double time) const = 0;  ///< program line, index into step_texts()
  virtual const std::vector<std::string>& step_texts() const = 0;
  /// Returns the time of the program for a time of this path, in which long waits may be shortened [s].
  virtual double program_time(double time) const { return time; }
  double program_duration() const { return program_time(duration()); }  ///< [s]
  std::string moment(double time) const;  ///< "at 1.2 s, program step 3 'text'", in the time of the program
};

/// Motion::longest_wait of checks, screenings and proposals [s]. A hose swings at about 2 Hz with a damping ratio of 0.15
/// (0.06 .. 0.33). After this time its swing has decayed to exp(-0.06 * 2 pi * 2 Hz * 10 s) = 5e-4 or less; at 1 Hz to 2 % or
/// less, below the error of bend radii with few segments (same_radius in quick_checks.cpp).
inline constexpr double settled_after = 10;

struct RunMotion;  // sim/program/import.h

/// The clamps on a robot that runs a joint program.
class RobotPath final : public ClampPath {
 public:
  /// Throws InputError: joint limits, wrong links. Precondition: the job has clamps.
  explicit RobotPath(const pipeline::Setup& setup);

  double duration() const override { return motion_.duration(); }
  Pose at(double time) const override { return pose(motion_.position(time)); }
  int step(double time) const override { return motion_.step(time); }
  double program_time(double time) const override { return motion_.program_time(time); }
  const std::vector<std::string>& step_texts() const override { return motion_.step_texts(); }

  const JointMotion& motion() const { return motion_; }
  /// Returns warnings about the robot program (Motion::left_out, external axes that the robot does not have) and unusual steps.
  const std::vector<pipeline::Warning>& doubts() const { return doubts_; }
  /// Returns whether the place of a clamp is probably in the frame of the world; doubts() contains the warning.
  bool clamps_in_world() const { return clamps_in_world_; }
  const std::string& note() const { return note_; }  ///< note of a run about its program; empty: none
  const std::vector<std::string>& assumed() const { return assumed_; }  ///< RunMotion::assumed
  /// Origins of the motion's tools in the flange's frame [m].
  const std::vector<Vector3>& tools() const { return tools_; }
  Pose pose(const Eigen::VectorXd& joints) const;
  /// Returns, (end, in the order of ClampFrames), the index of the link with the clamp; no_link: a free end.
  const std::vector<int>& end_links() const { return end_links_; }
  /// Returns the links of all dresspacks' rings, in their order.
  const std::vector<int>& ring_links() const { return ring_links_; }
  /// Returns the frame of each ring in its link's frame.
  const std::vector<Frame>& rings() const { return rings_; }
  /// Returns the joint angles at which the dresspacks were clamped [rad].
  const Eigen::VectorXd& mounting_pose() const { return mounting_pose_; }
  /// Rotates the clamp at an end about its direction by roll [rad] permanently. A clamp between two spans belongs to
  /// both.
  void turn_clamp(int end, double roll);

 private:
  RobotPath(const pipeline::Setup& setup, const RunMotion& run);
  void hold_joint(const pipeline::Setup& setup);
  /// Warns of a clamp farther from its link than `usual` [m] that is beside it if the numbers are a place in the world.
  void doubt_frame(const pipeline::Robot& robot, const std::string& key, const pipeline::Clamp& clamp, double usual);
  void add_dresspack(const pipeline::Setup& setup, const pipeline::Routing& routing);

  RobotKinematics kinematics_;
  JointMotion motion_;
  std::vector<pipeline::Warning> doubts_;
  std::string note_;
  std::vector<std::string> assumed_;
  std::vector<Vector3> tools_;
  std::vector<int> end_links_, ring_links_;
  std::vector<int> end_clamps_;  // (end) index into clamps_; for a free end the previous clamp
  std::vector<int> clamp_links_;
  std::vector<Frame> clamps_, rings_;  // in their links' frames (R2)
  Eigen::VectorXd mounting_pose_;
  bool clamps_in_world_ = false;
};

/// Clamp poses recorded by another program, columns t [s], x y z [m], qw qx qy qz of the base clamp, then of
/// the tool clamp (z axis of a clamp = direction from base to tool).
class RecordedPath final : public ClampPath {
 public:
  /// Reads a CSV file; a header line, blank lines and lines that begin with # are allowed. Throws InputError
  /// with line and column (character) of a bad cell: not a finite number, too few or too many cells,
  /// times that do not start at 0 and increase, a quaternion with a length error above 1e-3, a rotation of
  /// more than 120 deg from one row to the next (its direction would be ambiguous).
  explicit RecordedPath(const std::filesystem::path& file);

  double duration() const override { return duration_; }
  Pose at(double time) const override;
  int step(double) const override { return 0; }
  const std::vector<std::string>& step_texts() const override { return step_texts_; }

 private:
  double duration_ = 0;
  std::vector<std::string> step_texts_;
  std::unique_ptr<CubicSpline> poses_;
};

/// Returns the path of a job's motion: recorded clamps, or those of its robot. Errors: those of the constructors.
std::unique_ptr<ClampPath> path_of(const pipeline::Setup& setup);

/// Returns the frame of a clamp in the frame of its link (R2), (R3); roll [rad] is added to the clamp's roll (absent = 0).
Frame clamp_frame(const pipeline::Clamp& clamp);

}  // namespace dresslife::sim
