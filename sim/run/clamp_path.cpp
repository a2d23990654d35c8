#include "sim/run/clamp_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "pipeline/base/joined.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/job/setup.h"
#include "pipeline/resolve/plausible_job.h"
#include "sim/program/import.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/robot/inverse_kinematics.h"
#include "sim/robot/joint_slip.h"

namespace dresslife::sim {

std::string ClampPath::moment(double time) const {
  const int of = step(time);
  return fmt::format("at {:.3f} s, program step {} '{}'", program_time(time), of + 1,
                     step_texts()[static_cast<std::size_t>(of)]);
}

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

namespace {

/// Extends, for each external axis, the range [mm or deg] in which the steps move it.
void add_ways(const std::vector<pipeline::MotionStep>& steps, std::vector<std::pair<double, double>>& ways) {
  for (const pipeline::MotionStep& step : steps) {
    for (std::size_t i = 0; i < step.external_axes.size(); ++i) {
      const double at = step.external_axes[i];
      if (i >= ways.size()) ways.resize(i + 1, {at, at});
      ways[i] = {std::min(ways[i].first, at), std::max(ways[i].second, at)};
    }
    add_ways(step.steps, ways);
  }
}

/// Returns warnings for external axes that the motion moves and the robot does not have. They are assumed to stand still.
std::vector<pipeline::Warning> missing_external_axes(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  std::vector<std::pair<double, double>> ways;
  add_ways(motion.steps, ways);
  std::vector<pipeline::Warning> warnings;
  for (std::size_t i = robot.external_axes.size(); i < ways.size(); ++i)
    if (ways[i].second > ways[i].first)
      warnings.push_back(pipeline::warning_of(
          pipeline::WarningKind::program, "",
          fmt::format("the program moves external axis {} from {:.6g} to {:.6g} (mm or deg), and it does not move here",
                      i + 1, ways[i].first, ways[i].second),
          fmt::format("robot.external_axes has {} of them", robot.external_axes.size()),
          "add the entry that dresslife import proposes to robot.external_axes"));
  return warnings;
}

/// Returns whether the lower arm, from axis 2 to axis 3, is horizontal when all axes are at 0; std::nullopt: it is inclined, or
/// the robot has none.
std::optional<bool> lies_at_zero(const pipeline::Robot& robot) {
  constexpr std::size_t arm = 3;
  constexpr double upright = 0.95, flat = 0.3;  // shares of the arm's length: 18 deg, for arms with an offset
  if (robot.joints.size() < 5) return {};       // SCARA robots and palletizers have no such arm
  Frame frame{robot.base_position, pipeline::from_roll_pitch_yaw(robot.base_orientation)};
  Vector3 begin = Vector3::Zero(), end = begin;
  const Vector3 up = frame.orientation * Vector3::UnitZ();  // valid also for a robot on a wall
  for (std::size_t k = 0; k < arm; ++k) {
    frame = frame * Frame{robot.joints[k].origin, pipeline::from_roll_pitch_yaw(robot.joints[k].orientation)};
    if (k + 2 == arm) begin = frame.position;
    if (k + 1 == arm) end = frame.position;
  }
  const double share = std::abs((end - begin).normalized().dot(up));
  if (share > upright) return false;
  return share < flat ? std::optional(true) : std::nullopt;
}

/// Returns a warning for a program in the language of one maker and a robot of another: zeros and directions of their axes
/// differ.
std::vector<pipeline::Warning> other_maker(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  constexpr std::pair<Language, std::string_view> makers[] = {
      {Language::rapid, "ABB"},      {Language::krl, "KUKA"},       {Language::fanuc, "Fanuc"},
      {Language::inform, "Yaskawa"}, {Language::inform, "Motoman"}, {Language::urscript, "Universal Robots"}};
  if (motion.program.empty()) return {};
  const Language language = language_of(motion);
  std::string_view of_program, of_robot;
  bool same = false;
  for (const auto& [spoken, maker] : makers) {
    if (spoken == language) of_program = maker;
    if (!lower_case(robot.name).starts_with(lower_case(maker))) continue;
    // A name such as 'KUKA KR 16-2' is given by hand. One such as 'kuka_kr16' is that of a URDF, which may have its own zeros.
    if (spoken == language && (language == Language::fanuc || robot.name.starts_with(fmt::format("{} ", maker))))
      return {};
    if (spoken == language)
      same = true;
    else
      of_robot = maker;
  }
  if (of_program.empty()) return {};
  std::string robot_is, cause = "a job of another robot: the zeros and directions of axes differ between makers",
                        remedy = "robot: the one for which the program was written";
  if (!of_robot.empty()) {
    robot_is = robot.name;
  } else if (language == Language::fanuc) {
    robot_is = fmt::format("{}, whose maker is not known; joint_3 is taken as J3 + J2", robot.name);
    cause = "a job of another robot: of other makers no axis 3 counts from the horizontal as J3 does";
    remedy += fmt::format("; or robot.name: Fanuc {}, if it is one of Fanuc", robot.name);
  } else if (const auto lies = lies_at_zero(robot);
             lies && *lies != (language == Language::krl || language == Language::urscript)) {
    robot_is = fmt::format("{}, whose lower arm {} where all axes are at 0", robot.name,
                           *lies ? "lies flat" : "stands upright");
    cause = fmt::format("{}: at 0 the lower arm of a robot of {} {}",
                        same ? "a URDF with other zeros and directions of its axes than those of the controller"
                             : "a job of another robot",
                        of_program, *lies ? "stands upright" : "lies flat");
    if (same)
      remedy =
          "robot: an entry of the catalogue (dresslife new lists them), or a URDF with the controller's zeros and directions";
    remedy += fmt::format("; or robot.name: {} {}, if its controller has these zeros", of_program, robot.name);
  }
  if (robot_is.empty()) return {};
  return {pipeline::warning_of(pipeline::WarningKind::motion, motion.program.filename().string(),
                               fmt::format("the program {} is one of {}, and the robot is {}",
                                           motion.program.filename().string(), of_program, robot_is),
                               cause, remedy)};
}

/// Steps with a given time that is too short for an axis of the robot.
struct TooFast {
  int count = 0, axis = 0;
  double ratio = 0, time = 0,
         speed = 0;  ///< worst step: ratio to the limit, time at its end [s], required speed [rad/s or m/s]
  const pipeline::MotionStep* worst = nullptr;
};

void add_places(const std::vector<pipeline::MotionStep>& steps, const pipeline::Motion& motion,
                std::vector<Vector3>& places) {
  for (const pipeline::MotionStep& step : steps) {
    add_places(step.steps, motion, places);
    if (step.position.size() != 3) continue;
    const Vector3 at(step.position[0], step.position[1], step.position[2]);
    const auto object = std::ranges::find(motion.work_objects, step.work_object, &pipeline::MotionFrame::name);
    if (object == motion.work_objects.end()) {
      places.push_back(at);
      continue;
    }
    const auto& q = object->quaternion;
    places.push_back(object->position + Quaternion(q[0], q[1], q[2], q[3]).normalized() * at);
  }
}

/// Returns a warning for a program whose positions all lie in the robot's foot: in centimetres they are at most a tenth of its
/// reach from its base.
std::vector<pipeline::Warning> in_the_foot(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  std::vector<Vector3> places;
  add_places(motion.steps, motion, places);
  const bool tools_stand = std::ranges::any_of(motion.tools, &pipeline::MotionFrame::stationary);
  double reach = robot.flange_position.norm(), farthest = 0;
  for (std::size_t k = 1; k < robot.joints.size(); ++k) reach += robot.joints[k].origin.norm();
  for (const Vector3& place : places) farthest = std::max(farthest, place.norm());
  constexpr double of_reach = 0.1;
  if (places.size() < 2 || tools_stand || !robot.external_axes.empty() || farthest > of_reach * reach) return {};
  return {pipeline::warning_of(
      pipeline::WarningKind::motion, motion.where.text(),
      fmt::format("all positions of the program lie within {:.3g} mm of the origin of the robot's base "
                  "(limit {:.3g} mm: a tenth of its reach)",
                  1e3 * farthest, 1e3 * of_reach * reach),
      "centimetres instead of millimetres, or work objects that are not given",
      "positions in millimetres, 10 times these numbers if those were centimetres")};
}

/// before: the previous step; null: none. time: begin of the steps [s]. Returns the time at their end.
double add_too_fast(const std::vector<pipeline::MotionStep>& steps, const std::vector<Axis>& axes,
                    const pipeline::MotionStep*& before, double time, TooFast& found) {
  constexpr double rounding = 1.01;  // tolerance for rounded times and angles in recordings
  for (const pipeline::MotionStep& step : steps) {
    if (step.repeat > 0) {
      const double end = add_too_fast(step.steps, axes, before, time, found);
      time += step.repeat * (end - time);
      continue;
    }
    time += step.dwell + step.duration.value_or(0);
    if (!step.is_move()) continue;
    double worst = rounding;
    const std::size_t count =
        before && step.duration.value_or(0) > 0 ? std::min(step.joints.size(), before->joints.size()) : 0;
    for (std::size_t i = 0; i < std::min(count, axes.size()); ++i) {
      const double speed = std::abs(step.joints[i] - before->joints[i]) / *step.duration, ratio = speed / axes[i].speed;
      if (ratio > worst && ratio > found.ratio) found = {found.count, static_cast<int>(i), ratio, time, speed, &step};
      worst = std::max(worst, ratio);
    }
    found.count += worst > rounding;
    before = &step;
  }
  return time;
}

/// Returns a warning for times that the robot cannot keep: there the motion is slower than the program.
std::vector<pipeline::Warning> too_fast(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  TooFast found;
  const std::vector<Axis> axes = axes_of(robot);
  const pipeline::MotionStep* before = nullptr;
  add_too_fast(motion.steps, axes, before, 0, found);
  if (found.count == 0) return {};
  const Axis& axis = axes[static_cast<std::size_t>(found.axis)];
  const std::string slip = joint_slip(motion, robot);
  const double unit = axis.turns ? std::numbers::pi / 180 : 1e-3;
  const char* const name = axis.turns ? "deg/s" : "mm/s";
  return {pipeline::warning_of(
      pipeline::WarningKind::motion, found.worst->where.text(),
      fmt::format("{} is to move at {:.1f} {} up to {:.6g} s (limit {:.1f} {}){}: the robot takes longer", axis.name,
                  found.speed / unit, name, found.time, axis.speed / unit, name,
                  found.count > 1 ? fmt::format(", and {} further steps are too fast", found.count - 1) : ""),
      "times or angles in another unit, or a recording of a faster robot" +
          (slip.empty() ? "" : ", or " + slip + " (then all axes keep their limits and speeds)"),
      "times that the robot can keep, or the axis' limit in robot.joints if it is larger")};
}

struct Waits {
  double time = 0;  ///< [s]
  const pipeline::MotionStep* longest = nullptr;
};

void add_waits(const std::vector<pipeline::MotionStep>& steps, int times, Waits& waits) {
  for (const pipeline::MotionStep& step : steps) {
    add_waits(step.steps, times * std::max(1, step.repeat), waits);
    waits.time += times * step.dwell;
    if (step.dwell > 0 && (!waits.longest || step.dwell > waits.longest->dwell)) waits.longest = &step;
  }
}

/// Returns whether poses exist and all of them are poses of the flange itself. poses: set if a step has a pose.
bool leads_flange(const std::vector<pipeline::MotionStep>& steps, const pipeline::Motion& motion, bool& poses) {
  return std::ranges::all_of(steps, [&](const pipeline::MotionStep& step) {
    if (!leads_flange(step.steps, motion, poses)) return false;
    if (step.position.empty()) return true;
    poses = true;
    const auto tool = std::ranges::find(motion.tools, step.tool, &pipeline::MotionFrame::name);
    return tool == motion.tools.end() || tool->position.isZero();
  });
}

/// Returns the note of a run about its program, and about inputs that may be missing or in another unit.
std::string note_of(const RunMotion& run, double cycle) {
  constexpr double most = 0.5, long_wait = 5,
                   longest_wait =
                       20;  // share of the cycle; [s]: grippers take 0.2 to 1 s, spot welds with their guns up to 4 s
  std::vector<std::string> notes;
  Waits waits;
  add_waits(run.motion.steps, 1, waits);
  if (waits.longest && waits.longest->dwell >= (waits.time > most * cycle ? long_wait : longest_wait))
    notes.push_back(fmt::format(
        "The waits of the program take {:.4g} s, {:.0f} % of its cycle of {:.4g} s; the longest one is {:g} s, at {}. It counts in seconds: "
        "correct it if that was milliseconds or a decimal point is missing",
        waits.time, 100 * waits.time / cycle, cycle, waits.longest->dwell, waits.longest->where.text()));
  if (bool poses = false; leads_flange(run.motion.steps, run.motion, poses) && poses)
    notes.push_back(
        "The poses of the program lead the flange, because their tool is [0, 0, 0]. Was it taught with a tool? Then give that tool's data, "
        "in the program or as motion.tools: without them the flange comes too near to every place");
  if (!run.note.empty()) notes.push_back(run.note);
  return pipeline::joined(notes, ". ");
}

/// Returns the origins of the tools on the flange, in the flange's frame.
std::vector<Vector3> tool_points(const pipeline::Motion& motion) {
  std::vector<Vector3> points;
  for (const pipeline::MotionFrame& tool : motion.tools)
    if (!tool.stationary) points.push_back(tool.position);
  return points;
}

/// Returns the motion as a function of time. Errors: InputError, with the doubts about its program and steps.
JointMotion motion_in_time(const RunMotion& run, const pipeline::Setup& setup) {
  try {
    JointMotion motion(run.motion, setup.robot);
    motion.shorten_waits(setup.motion.longest_wait);
    return motion;
  } catch (const pipeline::InputError& error) {
    std::string words = error.what();
    for (const pipeline::Warning& cause : other_maker(setup.motion, setup.robot))  // of the errors that follow
      words = fmt::format("{}: error: {}\n{}", cause.where, cause.words, words);
    const auto doubts =
        pipeline::joined(in_the_foot(run.motion, setup.robot), pipeline::plausibility_of_steps(run.motion));
    for (const pipeline::Warning& doubt : doubts) words += "\n" + doubt.line();
    throw pipeline::InputError(words);
  }
}

}  // namespace

std::unique_ptr<ClampPath> path_of(const pipeline::Setup& setup) {
  if (!setup.motion.clamp_poses.empty()) return std::make_unique<RecordedPath>(setup.motion.clamp_poses);
  return std::make_unique<RobotPath>(setup);
}

RobotPath::RobotPath(const pipeline::Setup& setup)
    : RobotPath(setup, run_motion_of(setup.motion, flange_at(setup.robot))) {}

RobotPath::RobotPath(const pipeline::Setup& setup, const RunMotion& run)
    : kinematics_(setup.robot),
      motion_(motion_in_time(run, setup)),
      doubts_(pipeline::joined(
          pipeline::joined(pipeline::joined(run.motion.left_out, missing_external_axes(run.motion, setup.robot)),
                           pipeline::joined(pipeline::joined(other_maker(setup.motion, setup.robot),
                                                             in_the_foot(run.motion, setup.robot)),
                                            too_fast(run.motion, setup.robot))),
          setup.motion.program.empty() ? std::vector<pipeline::Warning>{}
                                       : pipeline::plausibility_of_steps(run.motion))),
      note_(note_of(run, program_duration())),
      assumed_(run.assumed),
      tools_(tool_points(run.motion)) {
  hold_joint(setup);
  mounting_pose_ = motion_.position(0);
  for (const pipeline::MountedDresspack& mounted : setup.dresspacks) {
    const pipeline::Routing& routing = mounted.routing;
    add_dresspack(setup, routing);
    if (routing.mounting_pose.empty()) continue;
    check_joint_limits(setup.robot, routing.mounting_pose, "routing.mounting_pose_deg", routing.where);
    const auto axes = static_cast<long>(routing.mounting_pose.size());
    mounting_pose_.head(axes) =  // external axes have their value at the start
        Eigen::Map<const Eigen::VectorXd>(routing.mounting_pose.data(), axes);
  }
  for (const pipeline::MountedDresspack& mounted : setup.dresspacks)
    for (const auto& [key, clamp] :
         {std::pair{"base_clamp", &mounted.routing.base_clamp}, {"tool_clamp", &mounted.routing.tool_clamp}})
      if (*clamp) doubt_frame(setup.robot, key, **clamp, pipeline::usual_distance(mounted.routing, mounted.dresspack));
}

void RobotPath::doubt_frame(const pipeline::Robot& robot, const std::string& key, const pipeline::Clamp& clamp,
                            double usual) {
  const auto away = pipeline::distance_to(robot, clamp.link, clamp.position);
  if (!away || *away <= usual) return;
  for (const auto& [joints, words] : {std::pair<Eigen::VectorXd, const char*>{mounting_pose_, "in the mounting pose"},
                                      {Eigen::VectorXd::Zero(mounting_pose_.size()), "where all axes are at 0"}}) {
    const Frame world = inverse(pose(joints).links[find_link(robot, clamp.link, clamp.where)]);
    const Vector3 at = world.point(clamp.position), to = world.orientation * clamp.direction;
    if (*pipeline::distance_to(robot, clamp.link, at) > usual) continue;
    std::erase_if(doubts_, [&](const pipeline::Warning& doubt) {  // of the same number, with other causes
      return doubt.where == clamp.where.text() && doubt.words.find(key + ".position_m lies ") != std::string::npos;
    });
    doubts_.push_back(pipeline::warning_of(
        pipeline::WarningKind::motion, clamp.where.text(),
        fmt::format(
            "routing.{}.position_m lies {:.3g} m from all shapes of {} (limit {:.3g}), and beside them as a place in the world {}",
            key, *away, clamp.link, usual, words),
        "a place in the frame of the world instead of that of the link",
        fmt::format(
            "position_m: [{:.3f}, {:.3f}, {:.3f}] and direction: [{:.2f}, {:.2f}, {:.2f}], both in the frame of {}",
            at.x(), at.y(), at.z(), to.x(), to.y(), to.z(), clamp.link)));
    clamps_in_world_ = true;
    return;
  }
}

void RobotPath::hold_joint(const pipeline::Setup& setup) {
  const std::vector<Axis> axes = axes_of(setup.robot);
  for (std::size_t k = 0; k < setup.robot.axes(); ++k)
    if (axes[k].name == setup.motion.hold_joint) motion_.hold(k);
}

void RobotPath::add_dresspack(const pipeline::Setup& setup, const pipeline::Routing& routing) {
  const auto add = [&](const pipeline::Clamp& clamp) {
    clamp_links_.push_back(find_link(setup.robot, clamp.link, clamp.where));
    clamps_.push_back(clamp_frame(clamp));
  };
  const auto add_end = [&](bool free = false) {
    end_clamps_.push_back(static_cast<int>(clamps_.size()) - 1);
    end_links_.push_back(free ? no_link : clamp_links_.back());
  };
  const bool free = !is_clamped(routing.tool_end);
  add(*routing.base_clamp);
  add_end();
  for (const pipeline::IntermediateClamp& between : routing.clamps) {
    add(between.clamp);
    add_end(), add_end();
  }
  if (!free) add(*routing.tool_clamp);
  add_end(free);
  for (const pipeline::GuideRing& ring : routing.rings) {
    ring_links_.push_back(find_link(setup.robot, ring.link, ring.where));
    rings_.push_back(clamp_frame({ring.link, ring.position, ring.direction, {}, ring.where}));
  }
}

Pose RobotPath::pose(const Eigen::VectorXd& joints) const {
  Pose pose;
  pose.joints = joints;
  pose.links.resize(kinematics_.links());
  kinematics_.link_frames({joints.data(), static_cast<size_t>(joints.size())}, pose.links);
  const int ends = static_cast<int>(end_clamps_.size());
  pose.clamps.between.resize(ends - 2);
  for (int e = 0; e < ends; ++e)
    pose.clamps.end(e) = pose.links[clamp_links_[end_clamps_[e]]] * clamps_[end_clamps_[e]];
  for (size_t k = 0; k < rings_.size(); ++k) pose.rings.push_back(pose.links[ring_links_[k]] * rings_[k]);
  return pose;
}

void RobotPath::turn_clamp(int end, double roll) {
  Frame& clamp = clamps_[end_clamps_[end]];
  clamp = rolled(clamp, roll);
}

}  // namespace dresslife::sim
