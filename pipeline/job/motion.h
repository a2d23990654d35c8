// The motion: moves and dwells, a robot program in the language of a controller, recorded clamp poses, or a prescribed
// deformation of the dresspack, from a file or a test rig.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/base/words.h"
#include "pipeline/job/rig.h"
#include "pipeline/job/robot.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

enum class PathKind { joint, linear, circular };
constexpr std::string_view word(PathKind value) { return word_at({"joint", "linear", "circular"}, value); }
/// Returns whether the tool's origin follows a path in space; otherwise the axes move straight to their targets.
constexpr bool leads_tool(PathKind value) { return value != PathKind::joint; }
/// Returns whether the path has an intermediate point.
constexpr bool has_via(PathKind value) { return value == PathKind::circular; }

/// Motion of the robot between rows of recorded joint angles.
enum class RecordedRows { blended, spline };
constexpr std::string_view word(RecordedRows value) { return word_at({"blended", "spline"}, value); }

/// One line of a robot program: a move, a dwell, or a block repeated `repeat` times. A move leads to joint angles or to a pose of
/// the tool in the work object.
struct MotionStep {
  PathKind path = PathKind::joint;    ///< type of a move's path; linear and circular need a pose
  std::vector<double> joints;         ///< target of a joint move [rad]; empty: a pose, or not a move
  std::vector<double> position;       ///< target of the tool: x, y, z [m]; empty: none
  std::vector<double> quaternion;     ///< of the tool: w, x, y, z
  std::vector<double> via_position;   ///< of a circular move: a point of the path [m]
  std::vector<double> circle_joints;  ///< of a circular move by joints: a point of its circle beyond the move [rad]
  std::string
      configuration;  ///< "abb 0 -1 0 1", "kuka 2 35", "fanuc NUT 0 0 0", "motoman 0 0 0 0 0 0", "near 0 -90 90 0 90 0"; empty: the nearest
  std::vector<double> external_axes;    ///< as programmed, in mm or deg, in the order of the robot's external axes
  std::string tool, work_object;        ///< names in Motion; empty: flange, robot base
  std::optional<double> speed_percent;  ///< share of each axis' largest speed [%]
  std::optional<double> speed;          ///< of the fastest axis [rad/s]
  std::optional<double> tool_speed;     ///< largest speed of the tool's origin [m/s]
  std::optional<double> turn_speed;     ///< largest rotation speed of the tool [rad/s]
  std::optional<double> duration;       ///< of the whole move [s]
  std::optional<double>
      acceleration_percent;            ///< share of each axis' largest acceleration, multiplied with that of Motion [%]
  std::optional<double> acceleration;  ///< largest of the fastest axis [rad/s2]
  std::optional<double> tool_acceleration;  ///< largest acceleration of the tool's origin along its path [m/s2]
  std::optional<double> jerk_percent;       ///< share of the usual rate at which acceleration increases [%]
  std::optional<double> zone;  ///< blending begins at this distance of the farthest axis from its target [rad]; 0: stop
  std::optional<double> tool_zone;  ///< blending begins at this distance of the tool from its target [m]; 0: stop
  std::optional<double>
      turn_zone;  ///< beside tool_zone: blending of the tool's turn begins at this angle from its target [rad]
  std::optional<double> stop_zone;  ///< blending begins at this share of the stopping distance [%]
  double dwell = 0;                 ///< [s]
  int repeat = 0;                   ///< 0: not a block
  std::vector<MotionStep> steps;    ///< of a block
  std::string text;                 ///< description of the step for reports
  Where where;
  Where speed_where, acceleration_where, tool_where,
      object_where;  ///< of the lines of a program that assign them; line 0: not known

  bool is_move() const { return !joints.empty() || !position.empty(); }
};

/// A tool in the flange's frame, or a work object in the frame of the robot's base.
struct MotionFrame {
  std::string name;
  Vector3d position = Vector3d::Zero();  ///< [m]
  std::vector<double> quaternion{1, 0, 0, 0};
  bool stationary = false;  ///< a tool that is fixed in the base frame while the flange carries the work object
  Where quaternion_where{}, wpr_where{};  ///< of these keys; line 0: not given
};

/// A branch of a program whose condition is known only while the robot runs.
struct BranchAssumption {
  std::string line;           ///< line of the branch: "file.mod:12" or "12"
  std::string take = "then";  ///< "then", "else"; for a choice of several cases: the value of the expression
};

/// A value that a program does not contain: an input, a register, persistent data, a position register.
struct ProgramValue {
  std::string name, value;  ///< in the syntax of the robot's language
};

struct ProgramFile {
  std::filesystem::path file;
};

struct Motion {
  std::string name, source;
  double speed_percent = 100;     ///< default for the moves [%]
  double override_percent = 100;  ///< of the controller: factor of all speeds [%]
  double acceleration_percent = 100;
  double ramp_percent = 25;         ///< share of a joint move's change of speed during which acceleration increases [%]
  double path_smoothing = 0.015;    ///< of tool paths: acceleration increases within twice this time [s]
  std::optional<double> jerk;       ///< largest jerk of each axis in joint moves, replaces ramp_percent [rad/s3]
  std::optional<double> path_jerk;  ///< jerk of tool paths, replaces path_smoothing [m/s3]
  double zone = 0;                  ///< default for the moves [rad]
  std::string hold_joint;           ///< name of a joint of the robot that does not move; empty: none
  std::vector<MotionFrame> tools, work_objects;
  std::vector<MotionStep> steps;  ///< the first step is a move; the robot starts at its target, at rest
  /// A robot program, or a folder with one (sim/program), instead of steps; empty: none.
  std::filesystem::path program;
  std::vector<ProgramFile> modules;  ///< more files of the program
  std::string routine;               ///< of the program, "name" or "name(arguments)"; empty: the start of the program
  std::vector<BranchAssumption> assume;
  std::vector<ProgramValue> values;
  int passes = 0;                             ///< of the program's endless main loop; 0: until it repeats
  RecordedRows rows = RecordedRows::blended;  ///< for steps with durations
  double spot_time = 1;                       ///< dwell of a spot weld in a program [s]
  Where spot_time_where{};                    ///< of this key; line 0: not given
  std::filesystem::path clamp_poses;          ///< CSV with the poses of both clamps, instead of steps; empty: none
  std::filesystem::path deformation;  ///< CSV with the deformation of the dresspack, instead of steps; empty: none
  std::optional<Rig> rig;             ///< test rig that deforms the dresspack, instead of steps
  /// Warnings about skipped instructions of a program that may move the robot, and about numbers that seem to be in another unit
  /// (pipeline/resolve/plausible_job.h).
  std::vector<Warning> left_out;
  /// Longest standstill that is simulated, no key: the checks shorten longer ones (sim/run/clamp_path.h) [s].
  double longest_wait = std::numeric_limits<double>::infinity();
  Where where;

  /// Returns whether the deformation is given, so that no simulation is needed.
  bool is_prescribed() const { return !deformation.empty() || rig.has_value(); }
  /// Returns whether a robot carries the clamps.
  bool needs_robot() const { return clamp_poses.empty() && !is_prescribed(); }
};

void describe(Fields& f, MotionStep& step);
void describe(Fields& f, MotionFrame& frame);
void describe(Fields& f, BranchAssumption& assumption);
void describe(Fields& f, ProgramValue& value);
void describe(Fields& f, ProgramFile& file);
void describe(Fields& f, Motion& motion);

/// Errors: InputErrors at each step that is no complete move, dwell or block, or that does not fit the robot's axes.
void check_motion(const Motion& motion, const Robot& robot);

/// motion_text returns a motion as YAML, without keys that have default values. motion_from reads it back; it checks each key,
/// but not the robot.
std::string motion_text(const Motion& motion);
Motion motion_from(const Node& document);

}  // namespace dresslife::pipeline
