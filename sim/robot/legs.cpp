#include "sim/robot/legs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "pipeline/base/constants.h"
#include "sim/robot/inverse_kinematics.h"
#include "sim/robot/joint_slip.h"
#include "sim/robot/robot.h"
#include "sim/robot/tool_path.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;
using pipeline::MotionStep;
using pipeline::PathKind;

constexpr double point_distance = 0.01;  // largest distance between points of a path [m]
constexpr double point_turn = 0.035;     // largest rotation between points [rad]
constexpr double point_change = 0.1;     // largest change of any joint between points [rad]
constexpr double shortest = 1e-4;        // share of a path that is not divided further
constexpr double jump = 0.5;       // change of a joint between such points at which the path is not continuous [rad]
constexpr double same_end = 1e-6;  // [rad]: 3 um of the tool at 3 m, less than any robot repeats
constexpr std::size_t most_moves = 200'000;  // in one repeat: five hours at ten moves per second
constexpr int samples = 24;                  // points on a joint move for the tool's speed

/// A line of the program during its conversion to legs.
struct Move {
  const MotionStep* step = nullptr;
  int line = 0;
  double dwell = 0;  // [s]; above 0: this is no move
  VectorXd from, to;
  Tooling tooling;
  std::optional<ToolPath> path;           // path of a linear or circular move
  double cut_before = 0, cut_behind = 0;  // shares of the path that the curves of the corners replace
  int chain = 0;                          // Leg::path

  bool is_path() const { return path.has_value(); }
};

class Layout {
 public:
  Layout(const pipeline::Motion& motion, const pipeline::Robot& robot, const VectorXd& accelerations)
      : motion_(motion), robot_(robot), axes_(axes_of(robot)), accelerations_(accelerations), arm_(robot) {
    if (motion.jerk) jerks_ = jerk_limits(motion, robot);
    for (const pipeline::MotionFrame& frame : motion.tools) tools_[frame.name] = &frame;
    for (const pipeline::MotionFrame& frame : motion.work_objects) objects_[frame.name] = &frame;
  }

  Legs run() {
    if (motion_.steps.empty() || !motion_.steps.front().is_move())
      throw pipeline::InputError(motion_.steps.empty() ? motion_.where : motion_.steps.front().where,
                                 fmt::format("motion '{}' does not begin with a move", motion_.name),
                                 "begin with the joints_deg at which the robot starts");
    number(motion_.steps, "");
    const std::string slip = beyond_.empty() ? "" : joint_slip(motion_, robot_);
    for (const auto& [axis, fault] : beyond_)
      problems_.add(
          fault.where,
          fault.targets == 1
              ? fault.worst.what
              : fmt::format("{}, the farthest of {} targets outside of its limits", fault.worst.what, fault.targets),
          (fault.targets == 1
               ? fault.worst.remedy
               : "the program may be one of another robot, or a URDF has other zeros than the controller: name the program's robot, or " +
                     fault.worst.remedy) +
              (slip.empty() ? "" : "; if " + slip + ", correct that: then all axes keep their limits"));
    throw_if_any();
    int first = 0;
    expand(motion_.steps, first);
    throw_if_any();
    find_paths();
    for (std::size_t k = 0; k + 1 < moves_.size(); ++k) round_corner(k);
    for (std::size_t k = 0; k < moves_.size(); ++k) add_move(k);
    throw_if_any();
    if (!made_.legs.empty()) made_.legs.back().zone = 0;
    made_.place = place_;
    return std::move(made_);
  }

 private:
  // ---- lines ----------------------------------------------------------------------------------------

  /// Numbers every line once, depth first, and checks its waypoint.
  void number(const std::vector<MotionStep>& steps, const std::string& block) {
    for (const MotionStep& step : steps) {
      if (step.repeat > 0) {
        number(step.steps, step.text.empty() ? block : block + step.text + ": ");
        continue;
      }
      const char* kind = step.is_move() ? "move" : "dwell";
      const int line = static_cast<int>(made_.texts.size());
      const std::string text = block + (step.text.empty() ? fmt::format("{} {}", kind, line + 1) : step.text);
      if (!step.joints.empty()) collect_limits(step, text);
      // a loop of the program runs the same line again
      const auto [known, added] = line_of_.try_emplace(
          step.where.line > 0 && step.where.column > 0
              ? fmt::format("{}:{}:{}:{}", step.where.file, step.where.line, step.where.column, text)
              : fmt::format("{}", line),
          line);
      numbers_.push_back(known->second);
      if (added) made_.texts.push_back(text);
    }
  }

  /// Collects for each axis the target that is farthest outside of its limits.
  void collect_limits(const MotionStep& step, const std::string& text) {
    for (const LimitFault& fault : limit_faults(robot_, step.joints, fmt::format("waypoint '{}'", text))) {
      if (fault.axis < 0) {
        problems_.add(step.where, fault.what, fault.remedy);
        continue;
      }
      Beyond& beyond = beyond_[fault.axis];
      if (beyond.targets++ == 0 || fault.excess > beyond.worst.excess) beyond.where = step.where, beyond.worst = fault;
    }
  }

  void expand(const std::vector<MotionStep>& steps, int& line) {
    for (const MotionStep& step : steps) {
      if (step.repeat > 0) {
        const int first = line;
        for (int k = 0; k < step.repeat; ++k) expand(step.steps, line = first);
        continue;
      }
      if (moves_.size() >= most_moves)
        throw pipeline::InputError(step.where,
                                   fmt::format("the program runs more than {} moves and dwells", most_moves),
                                   "give one cycle of it: life is counted in repeats");
      const int shown = numbers_[line++];
      if (step.is_move()) add_move(step, shown);
      if (step.dwell > 0) {
        Move dwell;
        dwell.step = &step;
        dwell.line = shown;
        dwell.dwell = step.dwell;
        dwell.from = dwell.to = place_;
        moves_.push_back(dwell);
      }
    }
  }

  const pipeline::MotionFrame* find(const std::map<std::string, const pipeline::MotionFrame*>& frames,
                                    const std::string& name, const char* what, const MotionStep& step) {
    if (name.empty()) return nullptr;
    const auto found = frames.find(name);
    if (found != frames.end()) return found->second;
    problems_.add(step.where, fmt::format("uses {} '{}', which the motion does not describe", what, name),
                  fmt::format("describe it under {}s", what));
    return nullptr;
  }

  Tooling tooling(const MotionStep& step) {
    Tooling made;
    const auto frame = [](const pipeline::MotionFrame& f) {
      return Frame{f.position,
                   Quaternion(f.quaternion[0], f.quaternion[1], f.quaternion[2], f.quaternion[3]).normalized()};
    };
    if (const auto* tool = find(tools_, step.tool, "tool", step)) {
      made.tool = frame(*tool);
      made.stationary = tool->stationary;
    }
    if (const auto* object = find(objects_, step.work_object, "work_object", step)) made.object = frame(*object);
    return made;
  }

  /// of: the axis outside of its limits, or a text that targets with one cause share; targets with the same one are reported
  /// together, by the target with the largest excess [rad]. Empty: the reason.
  bool refuse(const MotionStep& step, int line, const std::string& reason, const std::string& of = "",
              double excess = 0, const std::string& own_remedy = "") {
    const bool lacks = step.external_axes.size() > axes_.size() - robot_.axes();
    const std::string remedy =
        !own_remedy.empty() ? own_remedy
        : lacks
            ? "check target, tool, work object and configuration; the step also names external axes that "
              "robot.external_axes does not have: without them the robot's base is elsewhere"
            : "check target, tool, work object, configuration and the place of the robot's base; or name the robot of the program";
    const std::string& group = of.empty() ? reason : of;
    const auto same = std::ranges::find_if(
        refused_, [&](const Refused& other) { return other.group == group && other.remedy == remedy; });
    Refused refused{step.where, made_.texts[line], reason, remedy, group, excess, {}};
    if (same == refused_.end()) {
      refused_.push_back(std::move(refused));
    } else if (excess > same->excess) {
      refused.further = std::move(same->further);
      refused.further.insert(refused.further.begin(), same->where);
      *same = std::move(refused);
    } else {
      same->further.push_back(step.where);
    }
    return false;
  }
  bool refuse(const MotionStep& step, int line, const std::string& reason, const InverseKinematics::Excess& excess) {
    return refuse(step, line, reason, excess.axis, excess.angle);
  }

  /// Reports targets that are refused for one reason as one problem.
  void throw_if_any() {
    for (const Refused& refused : refused_) {
      constexpr std::size_t most = 5;
      std::string further;
      for (std::size_t k = 0; k < std::min(most, refused.further.size()); ++k)
        further += fmt::format("{}{}", k == 0 ? "" : ", ", refused.further[k].text());
      if (refused.further.size() > most) further += " ..";
      problems_.add(refused.where,
                    fmt::format("target of '{}' {}{}", refused.text, refused.reason,
                                further.empty() ? ""
                                                : fmt::format(", and {} further target{} ({})", refused.further.size(),
                                                              refused.further.size() == 1 ? "" : "s", further)),
                    refused.remedy);
    }
    refused_.clear();
    problems_.throw_if_any();
  }

  /// Returns all axes: `joints`, and the external axes at the share u of a move.
  VectorXd at_share(const Move& move, double u, VectorXd joints) const {
    const long external = static_cast<long>(axes_.size() - robot_.axes());
    joints.tail(external) = (1 - u) * move.from.tail(external) + u * move.to.tail(external);
    return joints;
  }

  /// Returns the external axes at the end of a step; an axis that the step does not name keeps its value.
  VectorXd externals(const MotionStep& step, int line) {
    const long robot_axes = static_cast<long>(robot_.axes());
    const long count = static_cast<long>(axes_.size()) - robot_axes;
    VectorXd values = place_.size() > 0 ? VectorXd(place_.tail(count)) : VectorXd::Zero(count);
    for (long i = 0; i < count; ++i) {
      const Axis& axis = axes_[robot_axes + i];
      const double unit = axis.turns ? degree : millimetre;
      if (i < static_cast<long>(step.external_axes.size())) values[i] = unit * step.external_axes[i];
      if (values[i] < axis.lower - limit_rounding || values[i] > axis.upper + limit_rounding)
        refuse(step, line,
               fmt::format("moves {} to {:.6g} {} (must be within {:.6g} .. {:.6g})", axis.name, values[i] / unit,
                           axis.turns ? "deg" : "mm", axis.lower / unit, axis.upper / unit));
    }
    return values;
  }

  /// Joins the robot's axes and the external axes.
  static VectorXd joined(const VectorXd& joints, const VectorXd& external) {
    VectorXd whole(joints.size() + external.size());
    whole << joints, external;
    return whole;
  }

  void add_move(const MotionStep& step, int line) {
    Move move;
    move.step = &step;
    move.line = line;
    move.from = place_;
    const Tooling tooling = move.tooling = this->tooling(step);
    const VectorXd external = externals(step, line);
    if (!step.joints.empty()) {
      move.to = joined(Eigen::Map<const VectorXd>(step.joints.data(), static_cast<long>(step.joints.size())), external);
      if (leads_tool(step.path) && place_.size() > 0) {
        move.path = ToolPath(tooling, tooling.pose(arm_.flange(place_)), tooling.pose(arm_.flange(move.to)));
        bend(step, line, move);
        if (!step.circle_joints.empty()) move.path->bend_beside(circle_point(step, tooling, external));
        check_end(step, line, move);
      }
    } else if (!reach(step, line, external, move)) {
      return;
    }
    made_.targets.push_back(move.to);
    if (place_.size() == 0) {  // start of the robot
      place_ = move.to;
      return;
    }
    if (move.to == move.from && !stands(move)) {  // the robot is already at the target: at most a stop
      if (zone_is_stop(step) && !moves_.empty()) stops_.push_back(moves_.size() - 1);
      return;
    }
    place_ = move.to;
    moves_.push_back(std::move(move));
  }

  /// Makes a move circular. Without a circle this is a problem, because controllers stop there.
  void bend(const MotionStep& step, int line, Move& move) {
    const auto& via = step.via_position;
    if (via.empty() || move.path->bend({via[0], via[1], via[2]})) return;
    problems_.add(
        step.where,
        fmt::format("'{}' has no circle: its start, the point on the way and its end lie on a line, or two of "
                    "them are one",
                    made_.texts[line]),
        "correct the point on the way or the end, or write a straight move");
  }

  /// Returns the position of the tool at a step's circle_joints, with the external axes of the move's end.
  Vector3 circle_point(const MotionStep& step, const Tooling& tooling, const VectorXd& external) const {
    const auto& angles = step.circle_joints;
    return tooling
        .pose(
            arm_.flange(joined(Eigen::Map<const VectorXd>(angles.data(), static_cast<long>(angles.size())), external)))
        .position;
  }

  /// Finds the end of a move to a pose. Returns false if it cannot be reached.
  bool reach(const MotionStep& step, int line, const VectorXd& external, Move& move) {
    const auto& p = step.position;
    const auto& q = step.quaternion;
    const Frame target{Vector3(p[0], p[1], p[2]), Quaternion(q[0], q[1], q[2], q[3]).normalized()};
    const bool path = leads_tool(step.path) && place_.size() > 0;
    std::string reason;
    const auto configuration = arm_configuration(step.configuration);
    if (!configuration)
      return refuse(step, line, fmt::format("has a configuration like none that is read: '{}'", step.configuration));
    VectorXd near = joined(VectorXd::Zero(static_cast<long>(robot_.axes())), external);
    if (place_.size() > 0) near.head(place_.size() - external.size()) = place_.head(place_.size() - external.size());
    // On a path the configuration cannot change; the end is found by following the path (lay_path).
    const auto joints =
        arm_.solve(move.tooling.flange(target), path ? ArmConfiguration{} : *configuration, near, reason);
    if (!joints) return refuse(step, line, reason, arm_.excess(move.tooling.flange(target), near));
    move.to = *joints;
    if (!path) return true;
    move.path = ToolPath(move.tooling, move.tooling.pose(arm_.flange(place_)), target);
    bend(step, line, move);
    follow(move);
    if (arm_.unsupported().empty() && !arm_.may_end(move.to, *configuration))
      return refuse(step, line,
                    fmt::format("is reached along its path in configuration {}, not in {}",
                                in_words(arm_.configuration(move.to, configuration->kind)), in_words(*configuration)));
    return true;
  }

  /// Refuses a path to joint angles that ends in another configuration or turn. With a singular wrist, axes 4 and 6 share a
  /// rotation: then the robot stops at the end of the path, and lay_path adds a joint move to the target.
  void check_end(const MotionStep& step, int line, Move& move) {
    const VectorXd given = move.to;
    follow(move);
    long axis = 0;
    const double off = (move.to - given).cwiseAbs().maxCoeff(&axis);
    if (off > jump)
      refuse(step, line,
             fmt::format("is reached along its path with {} at {:.4g} deg, not {:.4g}", axes_[axis].name,
                         move.to[axis] / degree, given[axis] / degree),
             "another end of the path", off, "write the angles at which the path ends, or a joint move to the target");
    if (off > same_end) stops_.push_back(moves_.size());
    move.to = given;
  }

  /// Finds the joint angles at the end of a path by following it.
  void follow(Move& move) {
    VectorXd joints = move.from;
    double u = 0;
    while (u < 1) {
      const auto next = advance(move, u, 1, joints);
      if (!next) return;
      u = next->first;
      joints = next->second;
    }
    move.to = joints;
  }

  /// Returns the next point of a path behind u, near enough for a straight leg; absent: no arm continues the path.
  std::optional<std::pair<double, VectorXd>> advance(const Move& move, double u, double end, const VectorXd& joints) {
    const ToolPath& path = *move.path;
    double step = std::min(
        end - u, 1 / std::max({1.0, std::ceil(path.length() / point_distance), std::ceil(path.turn() / point_turn)}));
    while (true) {
      std::string reason;
      const auto next = arm_.follow(path.flange(u + step), at_share(move, u + step, joints), reason);
      const double change = next ? (*next - joints).lpNorm<Eigen::Infinity>() : INFINITY;
      if (change <= point_change || (step <= shortest && change <= jump)) {
        const double at = end - u - step < 1e-12 ? end : u + step;
        return std::pair{at, *next};
      }
      if (step <= shortest) {
        const std::string why = !next                                ? "it " + reason
                                : arm_.without_closed_form().empty() ? "the wrist would turn over"
                                : arm_.singular(joints)              ? "the arm is singular: its axes would jump"
                                                                     : "its axes would jump into another configuration";
        InverseKinematics::Excess excess;
        if (!next) excess = arm_.excess(path.flange(u + step), at_share(move, u + step, joints));
        refuse(*move.step, move.line, fmt::format("is not reached along its path (at {:.0f} % of it {})", 100 * u, why),
               "path " + (excess.axis.empty() ? why : excess.axis), excess.angle);
        return {};
      }
      step /= 2;
    }
  }

  // ---- corners -------------------------------------------------------------------------------------

  bool zone_is_stop(const MotionStep& step) const {
    if (step.tool_zone) return *step.tool_zone == 0;
    if (step.stop_zone) return *step.stop_zone == 0;
    return step.zone.value_or(motion_.zone) == 0;
  }

  bool stops(std::size_t k) const {
    return k + 1 >= moves_.size() || moves_[k].dwell > 0 || moves_[k + 1].dwell > 0 || zone_is_stop(*moves_[k].step) ||
           std::ranges::find(stops_, k) != stops_.end();
  }

  /// Returns the tool's zone at the end of move k [m].
  double tool_zone(std::size_t k) const {
    const MotionStep& step = *moves_[k].step;
    if (step.tool_zone) return *step.tool_zone;
    if (!step.stop_zone) return 0;
    // Braking distance from the move's speed with the acceleration of its axes, v^2/(2 a).
    const Move& move = moves_[k];
    const double way = tool_way(move);
    const double brake = axis_limit(move.to - move.from, accelerations_) * way;
    const double speed = overridden() * std::min(step.tool_speed.value_or(INFINITY),
                                                 axis_limit(move.to - move.from, speeds(step)) * way);
    return *step.stop_zone / 100 * speed * speed / (2 * brake);
  }

  double tool_way(const Move& move) const {
    if (move.is_path()) return std::max(move.path->length(), 1e-6);
    const Tooling& t = move.tooling;
    return std::max((t.pose(arm_.flange(move.to)).position - t.pose(arm_.flange(move.from)).position).norm(), 1e-6);
  }

  double tool_turn(const Move& move) const {
    if (move.is_path()) return move.path->turn();
    const Tooling& t = move.tooling;
    const Frame from = t.pose(arm_.flange(move.from)), to = t.pose(arm_.flange(move.to));
    return rotation_vector(from.orientation.conjugate() * to.orientation).norm();
  }

  /// Returns the zone of the turn at the end of move k over the turn of a move beside it; infinity: no such zone.
  double turn_cut(std::size_t k, const Move& of) const {
    const std::optional<double>& zone = moves_[k].step->turn_zone;
    const double turn = zone ? tool_turn(of) : 0;
    return turn > 0 ? *zone / turn : INFINITY;
  }

  /// Returns the share of a move that the tool's zone at the end of move k cuts. In joint space the path and the turn are cut
  /// together, so the smaller zone decides.
  double tool_cut(std::size_t k, const Move& of) const {
    const double share = std::min(0.5, tool_zone(k) / tool_way(of));
    return has_tool_corner(k) ? share : std::min(share, turn_cut(k, of));
  }

  /// Returns whether the corner at the end of move k is a curve of the tool (M6), not one in joint space.
  bool has_tool_corner(std::size_t k) const {
    const Move &move = moves_[k], &next = moves_[k + 1];
    return move.is_path() && next.is_path() && move.path->same_tooling(*next.path);
  }

  /// Returns the largest rate of a share of `way` at which no axis exceeds its limit.
  static double axis_limit(const VectorXd& way, const VectorXd& limits) {
    double rate = INFINITY;
    for (long i = 0; i < way.size(); ++i)
      if (way[i] != 0) rate = std::min(rate, limits[i] / std::abs(way[i]));
    return rate;
  }

  /// Returns the controller's speed override, which scales speeds but not accelerations and waits.
  double overridden() const { return motion_.override_percent / 100; }

  VectorXd speeds(const MotionStep& step) const {
    VectorXd limits(static_cast<long>(axes_.size()));
    for (long i = 0; i < limits.size(); ++i) limits[i] = axes_[i].speed;
    if (step.speed) return limits;
    if (step.tool_speed || step.turn_speed || step.duration) return limits * step.speed_percent.value_or(100) / 100;
    return limits * step.speed_percent.value_or(motion_.speed_percent) / 100;
  }

  /// Numbers the chains of moves from stop to stop that contain a path.
  void find_paths() {
    int paths = 0;
    for (std::size_t begin = 0, end; begin < moves_.size(); begin = end) {
      bool path = moves_[begin].is_path();
      for (end = begin + 1; end < moves_.size() && !stops(end - 1); ++end) path |= moves_[end].is_path();
      if (!path) continue;
      ++paths;
      for (std::size_t k = begin; k < end; ++k) moves_[k].chain = paths;
    }
    bool waits = false;
    for (Move& move : moves_) {  // a stand beside a tool path is a wait with a full stop, which divides the chain
      if (move.chain == 0 || !stands(move)) continue;
      move.dwell = *move.step->duration / overridden();
      waits = true;
    }
    if (!waits) return;
    for (Move& move : moves_) move.chain = 0;
    find_paths();
  }

  void round_corner(std::size_t k) {
    Move &move = moves_[k], &next = moves_[k + 1];
    if (stops(k) || move.chain == 0) return;
    const MotionStep& step = *move.step;
    const bool angle = !move.is_path() && !next.is_path() && !step.tool_zone && !step.stop_zone;
    const double zone = step.zone.value_or(motion_.zone);
    const auto cut = [&](const Move& of) {
      return angle ? std::min(0.5, zone / (of.to - of.from).lpNorm<Eigen::Infinity>()) : tool_cut(k, of);
    };
    move.cut_behind = cut(move);
    next.cut_before = cut(next);
  }

  // ---- legs ----------------------------------------------------------------------------------------

  /// Limits of a leg, from its move.
  struct Limits {
    const MotionStep* step;
    int line;
  };

  void add_leg(const VectorXd& from, const VectorXd& to, double distance, double turn, const Limits& limits,
               double duration) {
    const VectorXd way = to - from;
    const double length = way.lpNorm<Eigen::Infinity>();
    constexpr double rounded = 1e-12;  // [rad]: two zones that meet leave a way of 1e-16, which has no direction
    if (length < rounded) return;
    const MotionStep& step = *limits.step;
    Leg leg;
    leg.from = from;
    leg.direction = way / length;
    leg.length = length;
    leg.step = limits.line;
    leg.zone = leg.zone_behind = INFINITY;
    leg.path = chain_;
    leg.cruise = axis_limit(leg.direction, speeds(step));
    leg.acceleration =
        axis_limit(leg.direction, accelerations_) * std::min(1.0, step.acceleration_percent.value_or(100) / 100);
    leg.jerk = step.jerk_percent.value_or(100) / 100;
    if (distance > 0) leg.tool_share = distance / length;
    if (chain_ == 0 && motion_.jerk) {
      leg.acceleration /= 1 - motion_.ramp_percent / 100;  // acceleration a, from A in (M2)
      leg.jerk_limit = leg.jerk * axis_limit(leg.direction, jerks_);
    } else if (chain_ == 0) {
      std::tie(leg.ramp, leg.slowing) = ramp_of(motion_.ramp_percent / 100, leg.jerk);
    }
    leg.acceleration *= leg.slowing;
    if (step.acceleration) leg.acceleration = std::min(leg.acceleration, *step.acceleration);
    if (step.tool_acceleration && distance > 0)
      leg.acceleration = std::min(leg.acceleration, length * *step.tool_acceleration / distance);
    if (step.speed) leg.cruise = std::min(leg.cruise, *step.speed);
    if (step.tool_speed && distance > 0) leg.cruise = std::min(leg.cruise, length * *step.tool_speed / distance);
    if (step.turn_speed && turn > 0) leg.cruise = std::min(leg.cruise, length * *step.turn_speed / turn);
    leg.cruise *= overridden();
    if (duration > 0) leg.cruise = std::min(leg.cruise, length / duration);
    made_.legs.push_back(std::move(leg));
  }

  void add_move(std::size_t k) {
    const Move& move = moves_[k];
    if (move.dwell > 0) {
      if (!made_.legs.empty()) made_.legs.back().zone = 0;
      Leg leg;
      leg.from = move.from;
      leg.direction = VectorXd::Zero(move.from.size());
      leg.dwell = move.dwell;
      leg.step = move.line;
      made_.legs.push_back(leg);
      return;
    }
    chain_ = move.chain;
    const VectorXd begun = k > 0 && moves_[k].cut_before > 0 ? last_ : move.from;
    last_ = begun;
    if (move.is_path())
      lay_path(move);
    else
      lay_joint(move, k);
    if (made_.legs.empty()) return;
    if (stops(k))
      made_.legs.back().zone = 0;
    else if (move.cut_behind > 0)
      lay_corner(k);
  }

  void lay_path(const Move& move) {
    const double end = 1 - move.cut_behind, span = std::max(end - move.cut_before, 1e-12);
    double u = move.cut_before;
    const double duration = move.step->duration.value_or(0) / overridden();
    while (u < end) {
      const auto next = advance(move, u, end, last_);
      if (!next) return;
      const double share = next->first - u;
      add_leg(last_, next->second, share * move.path->length(), share * move.path->turn(), {move.step, move.line},
              duration * share / span);
      u = next->first;
      last_ = next->second;
    }
    if (move.cut_behind > 0 || (move.to - last_).lpNorm<Eigen::Infinity>() < same_end) return;
    if (!made_.legs.empty()) made_.legs.back().zone = 0;
    chain_ = 0;
    add_leg(last_, move.to, 0, 0, {move.step, move.line}, 0);
    last_ = move.to;
  }

  /// Uses for a joint move the tool's distance and rotation in its fastest part, so that no part is too fast.
  void lay_joint(const Move& move, std::size_t k) {
    const VectorXd begin = move.from + move.cut_before * (move.to - move.from),
                   end = move.to - move.cut_behind * (move.to - move.from);
    const MotionStep& step = *move.step;
    double distance = 0, turn = 0;
    if (step.tool_speed || step.turn_speed) {
      const Tooling& t = move.tooling;
      Frame before = t.pose(arm_.flange(begin));
      for (int i = 1; i <= samples; ++i) {
        const Frame now = t.pose(arm_.flange(begin + (end - begin) * (double(i) / samples)));
        distance = std::max(distance, (now.position - before.position).norm() * samples);
        turn = std::max(turn, rotation_vector(before.orientation.conjugate() * now.orientation).norm() * samples);
        before = now;
      }
    }
    double duration = step.duration.value_or(0) / overridden();
    last_ = end;
    const std::size_t before = made_.legs.size();
    if (stands(move)) {
      add_stand(move, duration);
    } else {
      if (duration > 0 && stops(k) && (k == 0 || stops(k - 1))) duration = cruise_time(end - begin, duration);
      add_leg(begin, end, distance, turn, {&step, move.line}, duration);
    }
    if (made_.legs.size() == before) return;
    Leg& leg = made_.legs.back();
    leg.straight = true;
    if (move.cut_behind > 0 || stops(k)) return;
    if (step.zone || (!step.tool_zone && !step.stop_zone)) {
      leg.zone = leg.zone_behind = step.zone.value_or(motion_.zone);
    } else {  // a zone of the tool between two joint moves
      leg.zone = leg.length * tool_cut(k, move);
      const VectorXd way = moves_[k + 1].to - moves_[k + 1].from;
      leg.zone_behind = way.lpNorm<Eigen::Infinity>() * tool_cut(k, moves_[k + 1]);
    }
    if (stands(move)) leg.zone = INFINITY;
    if (stands(moves_[k + 1])) leg.zone_behind = INFINITY;
  }

  /// Returns whether a joint move leads to where the robot is already, in a time of its own, as a row of a recorded wait does.
  static bool stands(const Move& move) {
    return !move.is_path() && move.dwell == 0 && move.step->duration && move.from == move.to;
  }

  /// Adds a leg without a way. Its length is its duration and its speed 1, so that blends at its ends keep the time.
  void add_stand(const Move& move, double duration) {
    Leg leg;
    leg.from = move.from;
    leg.direction = VectorXd::Zero(move.from.size());
    leg.length = duration;
    leg.cruise = 1;
    leg.acceleration = 1e9;  // no axis moves: a change of this speed takes no time
    std::tie(leg.ramp, leg.slowing) = ramp_of(motion_.ramp_percent / 100, 1);
    leg.zone = leg.zone_behind = INFINITY;
    leg.step = move.line;
    made_.legs.push_back(std::move(leg));
  }

  /// Returns the time L/v at the speed v of a move from rest to rest in the time T: L/v + tau(v) = T.
  double cruise_time(const VectorXd& way, double time) const {
    const double length = way.lpNorm<Eigen::Infinity>();
    const double acceleration = axis_limit(way, accelerations_) * length;
    if (motion_.jerk && length > 0) {  // L/v = T - tau(v), iterated from below
      Leg leg;
      leg.acceleration = acceleration / (1 - motion_.ramp_percent / 100);
      leg.jerk_limit = axis_limit(way, jerks_) * length;
      double left = time;
      for (int i = 0; i < 100 && left > 0; ++i) left = time - change_on(leg, length / left).duration;
      return std::max(0.0, left);
    }
    const double root = time * time - 4 * length / acceleration;
    if (root < 0) return 0;  // the axes cannot be faster
    return length / ((time - std::sqrt(root)) * acceleration / 2);
  }

  /// Returns the share of a corner in which the turn is blended (M6). A small turn zone is one of `least` of the corner: then the
  /// turn misses its target by less than least/4 of what the corner cuts.
  double turn_window(std::size_t k) const {
    constexpr double least = 1.0 / 16;
    const double share =
        std::min(turn_cut(k, moves_[k]) / moves_[k].cut_behind, turn_cut(k, moves_[k + 1]) / moves_[k + 1].cut_before);
    return std::clamp(share, least, 1.0);
  }

  /// Adds a corner (M6): from the end of the cut path of move k to the begin of the next cut path.
  void lay_corner(std::size_t k) {
    const Move &move = moves_[k], &next = moves_[k + 1];
    const VectorXd begin = last_, corner = move.to;
    const bool straight = has_tool_corner(k);
    VectorXd end = next.from + next.cut_before * (next.to - next.from);
    if (next.is_path() && !arm_.without_closed_form().empty()) {  // follow the next path on the branch of the corner
      end = corner;
      for (double u = 0; u < next.cut_before;) {
        const auto reached = advance(next, u, next.cut_before, end);
        if (!reached) return;
        u = reached->first;
        end = reached->second;
      }
    } else if (next.is_path()) {
      std::string reason;
      const auto reached =
          arm_.solve(next.path->flange(next.cut_before), {}, at_share(next, next.cut_before, corner), reason);
      if (!reached) return static_cast<void>(refuse(*next.step, next.line, reason));
      end = *reached;
    }
    const double before = move.cut_behind * tool_way(move), behind = next.cut_before * tool_way(next);
    const double window = straight ? turn_window(k) : 1;
    const int points = static_cast<int>(std::ceil(std::max(8 / window, (before + behind) / point_distance)));
    const Tooling& tooling = next.tooling;
    VectorXd joints = begin;
    Frame seen = tooling.pose(arm_.flange(joints));
    for (int i = 1; i <= points; ++i) {
      const double u = double(i) / points;
      VectorXd target = (1 - u) * (1 - u) * begin + 2 * u * (1 - u) * corner + u * u * end;
      if (straight && i < points) {
        std::string reason;
        const Frame pose = bezier(move.path->pose(1 - move.cut_behind), next.path->pose(0),
                                  next.path->pose(next.cut_before), u, window);
        VectorXd near = joints;  // external axes follow the same curve
        const long external = near.size() - static_cast<long>(robot_.axes());
        near.tail(external) = target.tail(external);
        const auto reached = arm_.follow(next.path->tooling().flange(pose), near, reason);
        if (!reached) return static_cast<void>(refuse(*next.step, next.line, reason));
        target = *reached;
      }
      if (i == points) target = end;
      const Frame now = tooling.pose(arm_.flange(target));
      // The way along the move is left, and the way along the next one is begun: at the corner of a flat curve both are equal.
      const Move& driven = (1 - u) * (1 - u) * before >= u * u * behind ? move : next;
      add_leg(joints, target, (now.position - seen.position).norm(),
              rotation_vector(seen.orientation.conjugate() * now.orientation).norm(), {driven.step, driven.line}, 0);
      joints = target;
      seen = now;
    }
    last_ = joints;
  }

  const pipeline::Motion& motion_;
  const pipeline::Robot& robot_;
  const std::vector<Axis> axes_;
  const VectorXd& accelerations_;  // A_i
  VectorXd jerks_;                 // J_i of (M13); empty: no limit
  InverseKinematics arm_;
  std::map<std::string, const pipeline::MotionFrame*> tools_, objects_;
  std::map<std::string, int> line_of_;
  std::vector<int> numbers_;  // numbers of the lines, depth first
  std::vector<Move> moves_;
  std::vector<std::size_t> stops_;  // moves at whose end the robot stops in spite of their zone
  struct Refused {
    pipeline::Where where;  // place of the first target
    std::string text, reason, remedy, group;
    double excess = 0;  // [rad]
    std::vector<pipeline::Where> further;
  };
  struct Beyond {
    int targets = 0;
    pipeline::Where where;  // of the farthest
    LimitFault worst;
  };
  std::map<int, Beyond> beyond_;  // by axis
  std::vector<Refused> refused_;
  Problems problems_;
  VectorXd place_, last_;
  int chain_ = 0;  // chain of the present move
  Legs made_;
};

}  // namespace

std::pair<double, double> ramp_of(double ramp, double jerk) {
  const double constant = jerk * (1 - ramp);  // constant / ramp = (1 - r')/r', with r' of (M11)
  if (constant >= ramp) return {ramp / (ramp + constant), jerk / (ramp + constant)};
  return {0.5, 0.5 * std::sqrt(constant / ramp) / (1 - ramp)};
}

SpeedChange limited_change(double at_full, double by_jerk) {
  if (by_jerk >= at_full * at_full) return {2 * std::sqrt(by_jerk), 0.5};
  return {at_full + by_jerk / at_full, by_jerk / (at_full * at_full + by_jerk)};
}

SpeedChange change_on(const Leg& leg, double change) {
  if (leg.jerk_limit == 0) return {change / leg.acceleration, leg.ramp};
  return limited_change(change / leg.acceleration, change / leg.jerk_limit);
}

VectorXd jerk_limits(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  const std::vector<Axis> axes = axes_of(robot);
  double largest = 0;
  for (const Axis& axis : axes)
    if (axis.turns) largest = std::max(largest, axis.acceleration);
  VectorXd limits(static_cast<long>(axes.size()));
  for (long i = 0; i < limits.size(); ++i) {
    const Axis& axis = axes[static_cast<std::size_t>(i)];
    limits[i] = axis.turns || largest == 0 ? *motion.jerk : *motion.jerk * axis.acceleration / largest;
  }
  return limits;
}

Legs legs_of(const pipeline::Motion& motion, const pipeline::Robot& robot, const VectorXd& accelerations) {
  return Layout(motion, robot, accelerations).run();
}

}  // namespace dresslife::sim
