#include "pipeline/job/motion.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, MotionStep& step) {
  f.place(step.where);
  f.text("text", step.text, Need::optional, "what the step is, for reports");
  f.choice("path", step.path, "how a move gets to its target");
  f.numbers("joints_deg", step.joints, Need::optional, "target of a joint move, one angle per axis");
  f.numbers("position_mm", step.position, Need::optional,
            "target of the tool in the work object: x, y, z, instead of joints_deg");
  f.numbers("quaternion", step.quaternion, Need::optional, "orientation of the tool there: w, x, y, z");
  f.numbers("via_position_mm", step.via_position, Need::optional, "of a circular move: a point on the way");
  f.numbers("circle_joints_deg", step.circle_joints, Need::optional,
            "of a circular move to joints_deg: angles at another point of its circle, before its start or behind its "
            "end");
  f.text(
      "configuration", step.configuration, Need::optional,
      "which arm reaches the pose: abb CF1 CF4 CF6 CFX, kuka S T, fanuc NUT 0 0 0, motoman and the first six numbers "
      "of RCONF, near and six angles in deg; without it the nearest");
  f.numbers("external_axes", step.external_axes, Need::optional,
            "targets of external axes, mm or deg; without them they stay");
  f.text("tool", step.tool, Need::optional, "a name of tools; without it the flange");
  f.text("work_object", step.work_object, Need::optional,
         "a name of work_objects; without it the robot's base frame");
  f.maybe_number("speed_percent", step.speed_percent, between(0.1, 100),
                 "speed of the move, of each axis' highest");
  f.maybe_number("speed_deg_per_s", step.speed, above(0),
                 "speed of the axis that moves farthest, instead of a percentage");
  f.maybe_number("speed_mm_per_s", step.tool_speed, above(0), "highest speed of the tool");
  f.maybe_number("turn_deg_per_s", step.turn_speed, above(0),
                 "highest speed of the tool's rotation on a path");
  f.maybe_number("duration_s", step.duration, above(0), "of the whole move, instead of a speed");
  f.maybe_number("acceleration_percent", step.acceleration_percent, between(1, 150),
                 "of this move, besides the program's");
  f.maybe_number("jerk_percent", step.jerk_percent, between(10, 100),
                 "of the rate at which the acceleration of this move builds up, as the second argument of RAPID's AccSet");
  f.maybe_number("acceleration_deg_per_s2", step.acceleration, above(0),
                 "highest of the axis that moves farthest, besides the axes' own");
  f.maybe_number("acceleration_mm_per_s2", step.tool_acceleration, above(0),
                 "highest of the tool along its path, besides the axes' own");
  f.maybe_number("zone_mm", step.tool_zone, at_least(0),
                 "the tool leaves its path this near to the target; 0: stop");
  f.maybe_number("zone_percent", step.stop_zone, between(0, 100),
                 "the next move begins at this share of the way in which the robot would stop");
  f.maybe_number("zone_deg", step.zone, at_least(0),
                 "the next move begins when every axis is this near; 0: stop");
  f.number("dwell_s", step.dwell, Need::optional, at_least(0), "standstill instead of a move");
  f.integer("repeat", step.repeat, Need::optional, at_least(0),
            "how often the block of `steps` runs; 0: not a block");
  f.list("steps", step.steps, Need::optional, "the block");
}

void describe(Fields& f, MotionFrame& frame) {
  f.text("name", frame.name, Need::required, "name of the tool or work object");
  f.vector("position_mm", frame.position, Need::optional, "of its origin");
  f.numbers("quaternion", frame.quaternion, Need::optional, "its orientation: w, x, y, z");
  f.boolean("stationary", frame.stationary, Need::optional,
            "the tool stands still and the robot carries the work object");
}

void describe(Fields& f, BranchAssumption& assumption) {
  f.text("line", assumption.line, Need::required, "of the branch: FILE:LINE, or LINE alone");
  f.text(
      "take", assumption.take, Need::optional,
      "what the branch does: then, else; of a choice among several (TEST, SWITCH, SELECT): the value that it "
      "hangs on");
}

void describe(Fields& f, ProgramValue& value) {
  f.text("name", value.name, Need::required,
         "of an input, a register, a variable or a position, as the program writes it: di5, $IN[3], R[1], "
         "PR[2]");
  f.text("value", value.value, Need::required, "likewise: TRUE, 3, [[0,0,100],[1,0,0,0]]");
}

void describe(Fields& f, ProgramFile& file) {
  f.path("file", file.file, Need::required, "a module or data file");
}

void describe(Fields& f, Motion& motion) {
  f.place(motion.where);
  f.text("name", motion.name, Need::optional, "name of the program");
  f.text("source", motion.source, Need::optional, "who wrote it");
  f.number("speed_percent", motion.speed_percent, Need::optional, between(0.1, 100),
           "speed of moves that name none");
  f.number("acceleration_percent", motion.acceleration_percent, Need::optional, between(1, 100),
           "of each axis' highest acceleration, for all moves");
  f.number("ramp_percent", motion.ramp_percent, Need::optional, between(1, 50),
           "of the duration of each change of speed in a joint move, in which the acceleration builds up, and again in which it "
           "ends; 50: never constant. ESTIMATE, controllers do not publish it");
  f.number("path_smoothing_ms", motion.path_smoothing, Need::optional, between(1, 200),
           "of tool paths: the acceleration builds up within twice this time. ESTIMATE, likewise");
  f.number("zone_deg", motion.zone, Need::optional, at_least(0),
           "zone of moves that name none; 0: stop at each target");
  f.list("steps", motion.steps, Need::optional,
         "the program; it starts at rest at the target of the first step");
  f.list("tools", motion.tools, Need::optional,
         "tools, in the flange's frame; also those that a program names but does not hold");
  f.list("work_objects", motion.work_objects, Need::optional,
         "work objects, in the robot's base frame; likewise");
  f.path("program", motion.program, Need::optional,
         "a robot program instead of steps: RAPID (.mod, .prg, .sys, .pgf), KRL (.src), Fanuc (.ls), INFORM (.jbi), "
         "URScript (.script), joints (.csv), ROS (.yaml, .json), or the folder of a controller's backup");
  f.list("modules", motion.modules, Need::optional,
         "further files of the program: modules, .dat files, called programs");
  f.text(
      "routine", motion.routine, Need::optional,
      "of the program to run, with its arguments where it takes some: name(1, p20); without it main, or the "
      "first");
  f.list("assume", motion.assume, Need::optional, "how branches of the program go that hang on inputs");
  f.list("values", motion.values, Need::optional,
         "what the program asks and only the running robot knows: inputs, registers, variables, positions");
  f.integer("passes", motion.passes, Need::optional, at_least(0),
            "of the program's endless main loop; 0: until it repeats itself");
  f.number("spot_time_s", motion.spot_time, Need::optional, at_least(0),
           "dwell of a spot weld of the program");
  f.path("clamp_poses", motion.clamp_poses, Need::optional,
         "CSV with the poses of both clamps instead of steps: t, then x y z qw qx qy qz of base and tool "
         "clamp (s, m)");
  f.path("deformation", motion.deformation, Need::optional,
         "CSV with curvature, twist and elongation of the dresspack over time instead of steps; nothing is "
         "simulated (sim/README.md, \"Prescribed deformation\")");
  f.maybe_group("rig", motion.rig, "a test rig that bends or twists the dresspack instead of steps");
}

namespace {

void check_pose(const std::vector<double>& position, const std::vector<double>& quaternion,
                const Where& where) {
  if (position.size() != 3)
    throw InputError(where, fmt::format("position_mm has {} numbers", position.size()), "give x, y, z");
  double squares = 0;
  for (double part : quaternion) squares += part * part;
  constexpr double rounding = 1e-3;  // of quaternions written with four decimals
  if (quaternion.size() != 4 || std::abs(std::sqrt(squares) - 1) > rounding)
    throw InputError(where, "quaternion is not four numbers w, x, y, z of length 1",
                     "give the orientation of the pose");
}

void check_move(const MotionStep& step, const Robot& robot) {
  const Where& where = step.where;
  if (!step.joints.empty() && step.joints.size() != robot.axes())
    throw InputError(
        where,
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
    throw InputError(where,
                     step.duration ? "duration_s is given beside a speed"
                                   : "both speed_percent and speed_deg_per_s are given",
                     "keep one of the two");
  if (step.zone.has_value() + step.tool_zone.has_value() + step.stop_zone.has_value() > 1)
    throw InputError(where, "more than one of zone_deg, zone_mm, zone_percent is given", "keep one of them");
}

/// Without the steps of a block.
void check_lone_step(const MotionStep& step, const Robot& robot) {
  const bool move = step.is_move(), dwell = step.dwell > 0, block = step.repeat > 0 || !step.steps.empty();
  if (move + dwell + block != 1)
    throw InputError(step.where,
                     "a step must be one of: joints_deg or position_mm (a move), dwell_s, repeat with steps",
                     "split it into steps");
  if (block && (step.repeat < 1 || step.steps.empty()))
    throw InputError(step.where, "a block needs both repeat (at least 1) and steps", "give both");
  if (move) check_move(step, robot);
  if (!move && (step.speed || step.speed_percent || step.zone || step.tool_speed || step.tool_zone ||
                step.stop_zone || step.duration || step.acceleration || step.tool_acceleration))
    throw InputError(step.where, "speed and zone belong to a move", "take them out of this step");
}

void check_steps(const std::vector<MotionStep>& steps, const Robot& robot, Problems& problems) {
  for (const MotionStep& step : steps) {
    problems.attempt("", step.where, [&] { check_lone_step(step, robot); });
    check_steps(step.steps, robot, problems);
  }
}

void check_frames(const Motion& motion) {
  for (const std::vector<MotionFrame>* frames : {&motion.tools, &motion.work_objects})
    for (const MotionFrame& frame : *frames) check_pose({0, 0, 0}, frame.quaternion, motion.where);
}

}  // namespace

void check_motion(const Motion& motion, const Robot& robot) {
  if (!motion.clamp_poses.empty() + !motion.steps.empty() + !motion.program.empty() +
          !motion.deformation.empty() + motion.rig.has_value() !=
      1)
    throw InputError(motion.where, "motion must have one of steps, program, clamp_poses, deformation or rig",
                     "give one of the five");
  Problems problems;
  problems.attempt("", motion.where, [&] { check_frames(motion); });
  check_steps(motion.steps, robot, problems);
  if (!motion.steps.empty() && !motion.steps.front().is_move())
    problems.add(motion.steps.front().where, "the program must begin with a move (where the robot starts)",
                 "begin with joints_deg");
  problems.finish();
}

std::string motion_text(const Motion& motion) { return to_yaml(echo_fields(motion)); }

Motion motion_from(const Node& document) {
  Motion motion;
  read_fields(document, motion);
  check_frames(motion);
  return motion;
}

}  // namespace dresslife::pipeline
