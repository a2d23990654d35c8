// The motion: a program's moves and dwells, a robot program as it lies on a controller, recorded clamp poses,
// or how the dresspack deforms: prescribed, or by a test rig.
#pragma once

#include <Eigen/Core>
#include <filesystem>
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
/// Whether the tool's origin follows a path in space; else the axes move straight to their targets.
constexpr bool leads_tool(PathKind value) { return value != PathKind::joint; }
/// Whether a point on the way belongs to it.
constexpr bool has_via(PathKind value) { return value == PathKind::circular; }

/// How the robot gets from one row of recorded joint angles to the next.
enum class RecordedRows { blended, spline };
constexpr std::string_view word(RecordedRows value) { return word_at({"blended", "spline"}, value); }

/// One line of a robot program: a move, a dwell, or a block repeated `repeat` times. A move leads to joint
/// angles or to a pose of the tool in the work object.
struct MotionStep {
  PathKind path = PathKind::joint;    ///< how a move gets there; linear and circular: by a pose
  std::vector<double> joints;         ///< target of a joint move [rad]; empty: a pose, or not a move
  std::vector<double> position;       ///< target of the tool: x, y, z [m]; empty: none
  std::vector<double> quaternion;     ///< of the tool: w, x, y, z
  std::vector<double> via_position;   ///< of a circular move: a point on the way [m]
  std::vector<double> circle_joints;  ///< the same of a move by joints: a point of its circle outside the move [rad]
  std::string configuration;          ///< "abb 0 -1 0 1", "kuka 2 35", "fanuc NUT 0 0 0", "motoman 0 0 0 0 0 0", "near 0 -90 90 0 90 0"; empty: the nearest
  std::vector<double> external_axes;  ///< as programmed: mm or deg, in the order of the robot's
  std::string tool, work_object;      ///< names in Motion; empty: flange, robot base
  std::optional<double> speed_percent;         ///< of each axis' largest speed [%]
  std::optional<double> speed;                 ///< of the fastest axis [rad/s]
  std::optional<double> tool_speed;            ///< largest of the tool's origin [m/s]
  std::optional<double> turn_speed;            ///< largest of the tool's rotation [rad/s]
  std::optional<double> duration;              ///< of the whole move [s]
  std::optional<double> acceleration_percent;  ///< of each axis' largest acceleration, besides Motion's [%]
  std::optional<double> acceleration;          ///< largest of the fastest axis [rad/s2]
  std::optional<double> tool_acceleration;     ///< largest of the tool's origin along its path [m/s2]
  std::optional<double> jerk_percent;          ///< of the rate at which the acceleration builds up [%]
  std::optional<double> zone;  ///< blending begins this far from the target, largest axis [rad]; 0 = stop
  std::optional<double> tool_zone;  ///< blending begins this far from the target, tool [m]; 0 = stop
  std::optional<double>
      stop_zone;     ///< blending begins at this share of the way in which the robot would stop [%]
  double dwell = 0;  ///< [s]
  int repeat = 0;    ///< 0: not a block
  std::vector<MotionStep> steps;  ///< of a block
  std::string text;               ///< what the step is, for reports
  Where where;

  bool is_move() const { return !joints.empty() || !position.empty(); }
};

/// A tool in the flange's frame, or a work object in the frame of the robot's base.
struct MotionFrame {
  std::string name;
  Vector3d position = Vector3d::Zero();  ///< [m]
  std::vector<double> quaternion{1, 0, 0, 0};
  bool stationary = false;  ///< a tool that stands in the base frame while the flange carries the work object
};

/// A line of a program on which a branch depends on what is known only while the robot runs.
struct BranchAssumption {
  std::string line;           ///< "file.mod:12" or "12"
  std::string take = "then";  ///< "then", "else"; of a choice among several: the value that it depends on
};

/// What a program does not say: an input, a register, persistent data, a position register.
struct ProgramValue {
  std::string name, value;  ///< both as the language writes them
};

struct ProgramFile {
  std::filesystem::path file;
};

struct Motion {
  std::string name, source;
  double speed_percent = 100;  ///< default of the moves [%]
  double override_percent = 100;  ///< of the controller: all speeds are multiplied by it [%]
  double acceleration_percent = 100;
  double ramp_percent = 25;      ///< of a joint move's change of speed: the acceleration builds up [%]
  double path_smoothing = 0.015; ///< of tool paths: the acceleration builds up within twice this time [s]
  std::optional<double> jerk;       ///< largest of each axis in joint moves, instead of ramp_percent [rad/s3]
  std::optional<double> path_jerk;  ///< with which the tool's acceleration builds up, instead of path_smoothing [m/s3]
  double zone = 0;               ///< default of the moves [rad]
  std::string hold_joint;        ///< name of a joint of the robot that stands still; empty: none
  std::vector<MotionFrame> tools, work_objects;
  std::vector<MotionStep> steps;  ///< the first is a move: the robot starts there, at rest
  /// A robot program instead of steps (sim/program), or the folder of one; empty: none.
  std::filesystem::path program;
  std::vector<ProgramFile> modules;  ///< more files of the program
  std::string routine;               ///< of the program, "name" or "name(arguments)"; empty: its start
  std::vector<BranchAssumption> assume;
  std::vector<ProgramValue> values;
  int passes = 0;                     ///< of the program's endless main loop; 0: until it repeats itself
  RecordedRows rows = RecordedRows::blended;  ///< of steps with durations
  double spot_time = 1;               ///< dwell of a spot weld in a program [s]
  std::filesystem::path clamp_poses;  ///< CSV with both clamps' poses instead of steps; empty: none
  std::filesystem::path deformation;  ///< CSV with the dresspack's own deformation instead; empty: none
  std::optional<Rig> rig;             ///< that deforms it instead
  /// Of steps that were read from a program: what was left out there and may move the robot. Of any: numbers that
  /// another unit explains (pipeline/resolve/plausible_job.h).
  std::vector<Warning> left_out;
  Where where;

  /// Whether the deformation is given, so that nothing is simulated.
  bool is_prescribed() const { return !deformation.empty() || rig.has_value(); }
  /// Whether a robot carries the clamps.
  bool needs_robot() const { return clamp_poses.empty() && !is_prescribed(); }
};

void describe(Fields& f, MotionStep& step);
void describe(Fields& f, MotionFrame& frame);
void describe(Fields& f, BranchAssumption& assumption);
void describe(Fields& f, ProgramValue& value);
void describe(Fields& f, ProgramFile& file);
void describe(Fields& f, Motion& motion);

/// Errors: InputError at the step that is no whole move, dwell or block, or that the robot's axes do not fit.
void check_motion(const Motion& motion, const Robot& robot);

/// One motion as YAML without keys that have their defaults, and from a document that holds nothing else (checked key by key, not against a robot).
std::string motion_text(const Motion& motion);
Motion motion_from(const Node& document);

}  // namespace dresslife::pipeline
