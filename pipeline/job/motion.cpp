#include "pipeline/job/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/job/shapes.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, MotionStep& step) {
  f.place(step.where);
  f.text("text", step.text, Need::optional, "A description of the step for reports.");
  f.choice("path", step.path, "The path of a move to its target.");
  f.numbers("joints_deg", step.joints, Need::optional, "The target of a move: one angle per axis.");
  f.numbers("position_mm", step.position, Need::optional,
            "The target of the tool in the work object: x, y, z. It replaces joints_deg.");
  f.numbers("quaternion", step.quaternion, Need::optional, "The orientation of the tool at the target: w, x, y, z.");
  f.numbers("via_position_mm", step.via_position, Need::optional, "A point on the path of a circular move.");
  f.numbers("circle_joints_deg", step.circle_joints, Need::optional,
            "The joint angles at a further point of the circle, before the start or behind the end of a "
            "circular move to joints_deg.");
  f.text("configuration", step.configuration, Need::optional,
         "The configuration of the arm at the pose: abb CF1 CF4 CF6 CFX, kuka S T, fanuc NUT 0 0 0, motoman "
         "and the first six numbers of RCONF, or near and six angles in deg. Default: the nearest one.");
  f.numbers("external_axes", step.external_axes, Need::optional,
            "The targets of the external axes in mm or deg. Default: the axes do not move.");
  f.text("tool", step.tool, Need::optional, "A name of tools. Default: the flange.");
  f.text("work_object", step.work_object, Need::optional, "A name of work_objects. Default: the robot's base frame.");
  f.maybe_number("speed_percent", step.speed_percent, between(0.1, 100),
                 "The speed of the move, as a share of the highest speed of each axis.");
  f.maybe_number("speed_deg_per_s", step.speed, above(0),
                 "The speed of the axis with the longest way, instead of a percentage.");
  f.maybe_number("speed_mm_per_s", step.tool_speed, above(0), "The highest speed of the tool.");
  f.maybe_number("turn_deg_per_s", step.turn_speed, above(0), "The highest speed of the tool's rotation on a path.");
  f.maybe_number("duration_s", step.duration, above(0), "The duration of the whole move, instead of a speed.");
  f.maybe_number("acceleration_percent", step.acceleration_percent, between(0.1, 150),
                 "The acceleration of this move. It multiplies the one of the program.");
  f.maybe_number("jerk_percent", step.jerk_percent, between(1, 100),
                 "The rate at which the acceleration of this move builds up, as the second argument of "
                 "AccSet in RAPID and as $GEAR_JERK or $JERK.CP in KRL.");
  f.maybe_number("acceleration_deg_per_s2", step.acceleration, above(0),
                 "The highest acceleration of the axis with the longest way. The limits of the axes hold as "
                 "well.");
  f.maybe_number("acceleration_mm_per_s2", step.tool_acceleration, above(0),
                 "The highest acceleration of the tool along its path. The limits of the axes hold as well.");
  f.maybe_number("zone_mm", step.tool_zone, at_least(0),
                 "The distance to the target at which the tool leaves its path. 0: the robot stops.");
  f.maybe_number("zone_turn_deg", step.turn_zone, at_least(0),
                 "The angle to the target's orientation at which the tool leaves its turn, beside zone_mm (zone_ori "
                 "in RAPID). Without it the turn is cut by the same share as the path.");
  f.maybe_number("zone_percent", step.stop_zone, between(0, 100),
                 "The share of the braking distance at which the next move begins.");
  f.maybe_number("zone_deg", step.zone, at_least(0),
                 "The distance of every axis to the target at which the next move begins. 0: the robot "
                 "stops.");
  f.number("dwell_s", step.dwell, Need::optional, at_least(0), "The duration of a standstill. It replaces a move.");
  f.integer("repeat", step.repeat, Need::optional, at_least(0),
            "The number of runs of the block of `steps`. 0: this step is no block.");
  f.list("steps", step.steps, Need::optional, "The steps of the block.");
}

void describe(Fields& f, MotionFrame& frame) {
  f.text("name", frame.name, Need::required, "The name of the tool or work object.");
  f.vector("position_mm", frame.position, Need::optional, "The position of its origin.");
  f.numbers("quaternion", frame.quaternion, Need::optional, "Its orientation: w, x, y, z.");
  f.place_of("quaternion", frame.quaternion_where);
  std::vector<double> angles;  // read only: kept and written as the quaternion
  f.numbers(
      "wpr_deg", angles, Need::optional,
      "Its orientation as W, P, R of a Fanuc controller, instead of `quaternion`: turns about the fixed axes x, y "
      "and z, in this order.");
  f.place_of("wpr_deg", frame.wpr_where);
  if (angles.size() == 3) {
    const Eigen::Quaterniond q = from_roll_pitch_yaw({angles[0], angles[1], angles[2]});
    frame.quaternion = {q.w(), q.x(), q.y(), q.z()};
  } else if (!angles.empty()) {
    frame.quaternion.clear();  // refused by check_frames()
  }
  f.boolean("stationary", frame.stationary, Need::optional,
            "Whether the tool stands still and the robot holds the work object.");
}

void describe(Fields& f, BranchAssumption& assumption) {
  f.text("line", assumption.line, Need::required, "The line of the branch: FILE:LINE, or LINE alone.");
  f.text("take", assumption.take, Need::optional,
         "The decision of the branch: then or else. For a choice among several (TEST, SWITCH, SELECT): the "
         "value that decides.");
}

void describe(Fields& f, ProgramValue& value) {
  f.text("name", value.name, Need::required,
         "The name of an input, a register, a variable or a position, as in the program: di5, $IN[3], R[1], "
         "PR[2].");
  f.text("value", value.value, Need::required,
         "The value, as in the program, a list in quotes: TRUE, 3, '[[0,0,100],[1,0,0,0]]'.");
}

void describe(Fields& f, ProgramFile& file) { f.path("file", file.file, Need::required, "A module or data file."); }

void describe(Fields& f, Motion& motion) {
  f.place(motion.where);
  f.text("name", motion.name, Need::optional, "The name of the program.");
  f.text("source", motion.source, Need::optional, "The author of the program.");
  f.number("speed_percent", motion.speed_percent, Need::optional, between(0.1, 100),
           "The speed of moves without a speed of their own.");
  f.number(
      "override_percent", motion.override_percent, Need::optional, between(1, 100),
      "The speed override of the controller. It multiplies all speeds of the program and of the axes, and divides the times of "
      "moves that have times. Accelerations and waits stay.");
  f.number("acceleration_percent", motion.acceleration_percent, Need::optional, between(1, 100),
           "The acceleration of all moves, as a share of the highest one of each axis.");
  f.number("ramp_percent", motion.ramp_percent, Need::optional, between(1, 50),
           "The share of each change of speed in a joint move in which the acceleration builds up, and "
           "again in which it ends. At 50 it is never constant. ESTIMATE (config/defaults.md, ramps of controllers).");
  f.maybe_number("jerk_deg_per_s3", motion.jerk, above(0),
                 "The highest jerk of each axis in a joint move, instead of ramp_percent. KUKA: $AXIS_JERK of "
                 "$machine.dat.");
  f.number("path_smoothing_ms", motion.path_smoothing, Need::optional, between(1, 200),
           "The smoothing of tool paths. The acceleration builds up within twice this time. ESTIMATE "
           "(config/defaults.md, ramps of controllers).");
  f.maybe_number("path_jerk_m_per_s3", motion.path_jerk, above(0),
                 "The jerk with which the acceleration of the tool along its path builds up, instead of "
                 "path_smoothing_ms. KUKA: $JERK_MA.CP of $machine.dat.");
  f.number("zone_deg", motion.zone, Need::optional, at_least(0),
           "The zone of moves without a zone of their own. 0: the robot stops at each target.");
  f.text(
      "hold_joint", motion.hold_joint, Need::optional,
      "The name of a joint that stands still at the middle of its way while the others move as the program says. The life "
      "without its motion, divided by the life with it, is what the joint costs.");
  f.list("steps", motion.steps, Need::optional,
         "The steps of the program. The robot starts at rest at the target of the first step.");
  f.list("tools", motion.tools, Need::optional,
         "The tools in the flange's frame, also those that a program uses without a definition: [{name: gun, "
         "position_mm: [0, 0, 350]}].");
  f.list("work_objects", motion.work_objects, Need::optional,
         "The work objects in the robot's base frame, also those that a program uses without a definition.");
  f.path("program", motion.program, Need::optional,
         "A robot program instead of steps: RAPID (.mod, .prg, .sys, .pgf), KRL (.src), Fanuc (.ls), INFORM "
         "(.jbi), URScript (.script), joints (.csv), ROS (.yaml, .json), or the folder of a controller's "
         "backup.");
  f.list("modules", motion.modules, Need::optional,
         "Further files of the program: modules, .dat files and called programs.");
  f.text("routine", motion.routine, Need::optional,
         "The routine to run, with its arguments if it takes some: name(1, p20). Default: main, or the first "
         "routine.");
  f.list("assume", motion.assume, Need::optional, "The decisions of branches that depend on inputs.");
  f.list("values", motion.values, Need::optional,
         "The values of inputs, registers, variables and positions that the files of the program do not "
         "contain.");
  f.choice(
      "rows", motion.rows,
      "The motion between joint angles with times. blended: straight lines, with the accelerations of the axes at each row. "
      "spline: a cubic spline through the rows, which keeps the times and no limits of the axes.");
  f.integer("passes", motion.passes, Need::optional, at_least(0),
            "The number of passes of the program's endless main loop. 0: until it repeats itself.");
  f.number("spot_time_s", motion.spot_time, Need::optional, at_least(0), "The dwell at each spot weld of the program.");
  f.place_of("spot_time_s", motion.spot_time_where);
  f.path("clamp_poses", motion.clamp_poses, Need::optional,
         "A CSV file with the poses of both clamps instead of steps: t, then x y z qw qx qy qz of base and "
         "tool clamp (s, m).");
  f.path("deformation", motion.deformation, Need::optional,
         "A CSV file with curvature, twist and elongation of the dresspack over time instead of steps. No "
         "simulation runs (section Prescribed deformation of sim/README.md).");
  f.maybe_group("rig", motion.rig, "A test rig that bends or twists the dresspack, instead of steps.");
}

namespace {

void check_pose(const std::vector<double>& position, const std::vector<double>& quaternion, const Where& where) {
  if (position.size() != 3)
    throw InputError(where, fmt::format("position_mm has {} numbers", position.size()), "give x, y, z");
  double squares = 0;
  for (double part : quaternion) squares += part * part;
  constexpr double rounding = 1e-3;  // limit for quaternions with four decimals
  if (quaternion.size() != 4 || std::abs(std::sqrt(squares) - 1) > rounding)
    throw InputError(where, "quaternion is not four numbers w, x, y, z of length 1",
                     "give the orientation of the pose");
}

void check_move(const MotionStep& step, const Robot& robot) {
  const Where& where = step.where;
  if (!step.joints.empty() && step.joints.size() != robot.axes())
    throw InputError(where,
                     fmt::format("joints_deg has {} angles (the robot has {} axes)", step.joints.size(), robot.axes()),
                     "give one angle per axis");
  if (!step.joints.empty() && !step.position.empty())
    throw InputError(where, "both joints_deg and position_mm are given", "keep one of the two");
  if (!step.position.empty()) check_pose(step.position, step.quaternion, where);
  const bool circle = !step.circle_joints.empty();
  if (has_via(step.path) != (circle || !step.via_position.empty()) || (circle && !step.via_position.empty()) ||
      (!step.via_position.empty() && step.via_position.size() != 3) ||
      (circle && step.circle_joints.size() != robot.axes()))
    throw InputError(where,
                     "via_position_mm or circle_joints_deg belongs to a circular move, which must have one of them",
                     "give x, y, z or one angle per axis, or change the path");
  if (step.speed.has_value() + step.speed_percent.has_value() + step.duration.has_value() > 1)
    throw InputError(
        where,
        step.duration ? "duration_s is given beside a speed" : "both speed_percent and speed_deg_per_s are given",
        "keep one of the two");
  if (step.zone.has_value() + step.tool_zone.has_value() + step.stop_zone.has_value() > 1)
    throw InputError(where, "more than one of zone_deg, zone_mm, zone_percent is given", "keep one of them");
  if (step.turn_zone && !step.tool_zone)
    throw InputError(where, "zone_turn_deg is given without zone_mm", "give both, or take zone_turn_deg out");
}

/// Removes the keys whose values are those of `defaults`.
void leave_out_defaults(Node& map, const Node& defaults) {
  std::erase_if(map.entries, [&](const auto& entry) {
    const Node* const same = defaults.find(entry.key);
    return same && to_yaml(*same) == to_yaml(entry.value);
  });
}

/// Checks one step without the steps of its block.
void check_lone_step(const MotionStep& step, const Robot& robot) {
  const bool move = step.is_move(), dwell = step.dwell > 0, block = step.repeat > 0 || !step.steps.empty();
  if (move + dwell + block != 1)
    throw InputError(step.where,
                     "a step must be one of: joints_deg or position_mm (a move), dwell_s, repeat with steps",
                     "split it into steps");
  if (block && (step.repeat < 1 || step.steps.empty()))
    throw InputError(step.where, "a block needs both repeat (at least 1) and steps", "give both");
  if (move) return check_move(step, robot);
  Node map = echo_fields(step);
  leave_out_defaults(map, echo_fields(MotionStep{}));
  for (const Entry& entry : map.entries)
    if (entry.key != "text" && entry.key != "dwell_s" && entry.key != "repeat" && entry.key != "steps")
      throw InputError(step.where, fmt::format("{} belongs to a move", entry.key), "take it out of this step");
}

void check_steps(const std::vector<MotionStep>& steps, const Robot& robot, Problems& problems) {
  for (const MotionStep& step : steps) {
    problems.attempt("", step.where, [&] { check_lone_step(step, robot); });
    check_steps(step.steps, robot, problems);
  }
}

void check_frames(const Motion& motion) {
  for (const std::vector<MotionFrame>* frames : {&motion.tools, &motion.work_objects})
    for (const MotionFrame& frame : *frames) {
      if (frame.wpr_where.line > 0 && frame.quaternion_where.line > 0)
        throw InputError(frame.wpr_where, "both quaternion and wpr_deg are given", "keep one of the two");
      if (frame.wpr_where.line > 0 && frame.quaternion.empty())
        throw InputError(frame.wpr_where, "wpr_deg is not three angles W, P, R", "give the three");
      check_pose({0, 0, 0}, frame.quaternion, motion.where);
    }
}

void check_held_joint(const Motion& motion, const Robot& robot) {
  if (motion.hold_joint.empty()) return;
  const std::vector<std::string> axes = robot.axis_names();
  if (std::ranges::find(axes, motion.hold_joint) != axes.end()) return;
  const Joint* const held = find_in(robot.joints, &Joint::name, motion.hold_joint);
  throw InputError(motion.where,
                   held ? fmt::format("hold_joint: '{}' follows {} and cannot be held alone", held->name, held->follows)
                        : fmt::format("hold_joint: the robot has no joint '{}'", motion.hold_joint),
                   fmt::format("name one of {}", joined(axes, ", ")));
}

/// Refuses keys of a robot's program in a motion without a robot. source: the key of that motion.
void check_robotless(const Motion& motion, const std::string& source) {
  Node map = echo_fields(motion);
  leave_out_defaults(map, echo_fields(Motion{}));
  std::vector<std::string> without_effect;
  for (const Entry& entry : map.entries)
    if (entry.key != source && entry.key != "name" && entry.key != "source") without_effect.push_back(entry.key);
  if (!without_effect.empty())
    throw InputError(motion.where,
                     fmt::format("keys beside motion.{}, which moves no robot, have no effect: {}", source,
                                 joined(without_effect, ", ")),
                     "leave them out");
}

}  // namespace

void check_motion(const Motion& motion, const Robot& robot) {
  std::vector<std::string> has;
  const auto add = [&](const char* key, bool given) {
    if (given) has.emplace_back(key);
  };
  add("steps", !motion.steps.empty());
  add("program", !motion.program.empty());
  add("clamp_poses", !motion.clamp_poses.empty());
  add("deformation", !motion.deformation.empty());
  add("rig", motion.rig.has_value());
  if (has.size() != 1)
    throw InputError(motion.where,
                     fmt::format("motion must have one of steps, program, clamp_poses, deformation or rig (it has {})",
                                 has.empty() ? "none" : joined(has, " and ")),
                     has.empty() ? "give one of the five" : "keep one of them");
  if (!motion.needs_robot()) return check_robotless(motion, has.front());
  Problems problems;
  problems.attempt("", motion.where, [&] { check_frames(motion); });
  problems.attempt("", motion.where, [&] { check_held_joint(motion, robot); });
  check_steps(motion.steps, robot, problems);
  if (!motion.steps.empty() && !motion.steps.front().is_move())
    problems.add(motion.steps.front().where, "the program must begin with a move (where the robot starts)",
                 "begin with joints_deg");
  problems.finish();
}

namespace {

void leave_out_defaults_of_steps(Node& map, const Node& defaults) {
  Node* const steps = map.find("steps");
  if (!steps) return;
  for (Node& step : steps->items) {
    leave_out_defaults_of_steps(step, defaults);
    leave_out_defaults(step, defaults);
  }
}

}  // namespace

std::string motion_text(const Motion& motion) {
  Node map = echo_fields(motion);
  leave_out_defaults_of_steps(map, echo_fields(MotionStep{}));
  for (const char* frames : {"tools", "work_objects"})
    if (Node* const list = map.find(frames))
      for (Node& frame : list->items) leave_out_defaults(frame, echo_fields(MotionFrame{}));
  leave_out_defaults(map, echo_fields(Motion{}));
  return to_yaml(map);
}

Motion motion_from(const Node& document) {
  Motion motion;
  read_fields(document, motion);
  check_frames(motion);
  return motion;
}

}  // namespace dresslife::pipeline
