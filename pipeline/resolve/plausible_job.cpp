#include "pipeline/resolve/plausible_job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <regex>
#include <sstream>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/excess.h"
#include "pipeline/cable/warmth.h"
#include "pipeline/job/line_key.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/resolve/radians.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

constexpr double most_radians = 2 * std::numbers::pi;  // of an axis, if the numbers are radians
constexpr double moves = 0.1;  // range of an axis in one of these numbers; with less, the robot does not move
// A single target in radians: at most half a turn in radians, and more than an adjustment at the zero pose, while other targets
// have larger angles.
constexpr double half_turn = 3.15, small_turn = 0.35;  // [deg], numbers that are probably rad
constexpr double wide_targets = 15 * degree;
// A single position in metres: 50 mm to 5 m. Positions at the origin of a work object are 0 or rounded to 0.01 mm.
constexpr double least_metres = 0.05e-3, most_metres = 5e-3, far_place = 0.05;  // [m]
// A position beside the preceding one: 20 mm to 1 m in metres. Robots repeat a position within 0.05 mm, and no program of a plant
// has such small steps.
constexpr double least_step = 0.02e-3, most_step = 1e-3;  // [m]
constexpr double least_percent = 1;  // a hundredth of an axis' speed: no program of a plant is so slow
constexpr double fastest_tool = 10;  // [m/s]: the fastest controllers allow 5 to 7
constexpr double fastest_of_kuka =
    3;  // [m/s]: ESTIMATE of $VEL_MA.CP, the upper bound of $VEL.CP in the machine data of a robot
constexpr double surely_millimetres = 50;  // [m/s]: a tenth of smaller numbers is a speed of robots
constexpr double longest_dwell = 100;      // [s]: cycles of production lines are shorter
constexpr double settling_wait = 10;  // [s]: the swing of a hose has decayed (settled_after in sim/run/clamp_path.h)

constexpr double largest_step =
    10e-3;                        // [s]: the largest step that an automatic choice takes; larger ones were not tried
constexpr double least_rate = 5;  // [Hz]: fewer than three samples of a hose's swing at 1.8 Hz
constexpr double largest_gate =
    2e-4;  // the default: with 5e-4 lives of 4e9 repeats become endless (strain/measurements.md)

constexpr double least_speed = 0.5 * degree;  // [rad/s] of the fastest axis: robots in plants reach 100 deg/s

constexpr double standard_gravity = 9.80665;
constexpr double gravity_spread = 0.01;     // relative: gravity varies by 0.5 % over the earth
constexpr double down = 0.999;              // cosine of 2.6 deg, more than the slope of floors
constexpr double most_failed_wires = 30;    // [%]: by then the other wires carry half as much current and load again
constexpr double least_robot_life = 1000;   // [h]: half a year of one shift
constexpr double largest_endurance = 5e-3;  // polymers have 9e-3 at ten million cycles, metals a fifth of this limit
constexpr double largest_factor = 30;       // 100 is a percentage; trials have 0.1 to 10
constexpr double largest_tolerance = 0.05;  // [m] between the starts of two repeats: the width of a hose
constexpr double longest_spot = 10;         // [s]: a weld takes 0.3 to 2
constexpr double widest_zone = 30 * degree;
constexpr int repeats_to_steady = 100;       // of the motion: the default is 8
constexpr int least_targets = 30;            // of a recording: programs with targets so near to each other are shorter
constexpr double near_targets = 3 * degree;  // of the fastest axis from target to target
constexpr int most_repeats = 1000;           // of steps in a program: a pallet has some hundred places
constexpr double slowest_tool = 3e-3;        // [m/s]: arc welding has 5 to 20 mm/s
constexpr double widest_path_zone = 0.5;     // [m]: zones of controllers are at most 0.2
constexpr double tool_behind = 0.02;  // [m]: a flange is thicker than the distance of a tool's centre behind its face
constexpr double slowest_move = 0.2 * degree;  // [rad/s] of the fastest axis in one move
constexpr double slowest_axis = 5 * degree,
                 fastest_axis = 3000 * degree;  // [rad/s]: positioners have 30, wrists of small robots 1000 deg/s
constexpr double longest_ramp = 5, quickest_robot = 0.05,
                 shortest_ramp = 0.005;  // [s] from rest to full speed: robots need 0.1 to 1
constexpr double most_turns = 4 * 360,
                 twice_around = 2 * 360;  // [deg]: wrists turn up to two turns in each direction
constexpr double endless_axis = 36000;    // of a continuous joint of a URDF [deg]
constexpr double longest_box = 60;        // [m]: the floor of a hall
constexpr double farthest = 20;           // [m] from the origin: the size of a cell
constexpr double widest_spread = 20;  // factor of one standard deviation: friction of seven published cables has 2.2
constexpr double least_pre_twist = 6.2832 * degree, largest_pre_twist = 3600 * degree;
constexpr double shortest_in_mm = 300;  // a smaller number is in centimetres: no hose on a robot is 0.3 m long
constexpr double farthest_clamp = 3;    // [m] from its link's frame: arms of large robots are 1.5 m long, brackets 0.3
constexpr double longest_tool = 0.5,
                 near_link = 0.25;  // [m]: clamps on welding guns; usual brackets and small tools
constexpr double near_bracket =
    0.15;  // [m]: bracket length that route tries; beyond it, exchanged coordinates must be 4 times nearer
constexpr int few_segments = 16;         // with more segments, a hose whose segments are too long is itself too long
constexpr int finest_of_job = 2000;      // simulation.segments
constexpr double longest_segment = 0.5;  // of the least bend radius: chords of 0.5 rad are 1 % shorter than their arcs
constexpr double inside_robot = 0.01;    // [m] below a box's surface: floors and tables end at the base
constexpr double shortest_bracket = 1e-3, longest_built = 2;  // [m]
constexpr double widest_ring = 10;                            // in diameters of the dresspack
constexpr double longest_stroke = 5, largest_pull = 2000, stiffest_spring = 1e4,
                 heaviest_slider = 50;  // [m], [N], [N/m], [kg]

constexpr OtherUnit from_millimetres{1e-3, "millimetres instead of metres", "millimetres"},
    from_metres{1e3, "metres instead of millimetres", "metres"},
    from_milliseconds{1e-3, "milliseconds instead of seconds", "milliseconds"},
    from_share{1e2, "a share instead of per cent", "a share"},
    from_percent{1e-2, "per cent instead of a share", "per cent"};

/// Returns a remedy if its value keeps the limit that the present one exceeds, else another remedy.
std::string if_kept(bool keeps, const std::string& remedy, const std::string& otherwise) {
  return keeps ? remedy : otherwise;
}

/// Steps with one fault: the first one, and the number of further ones.
struct Doubted {
  const MotionStep* first = nullptr;
  int more = 0;
  Where line = {};  ///< of the first step, or of what gives it the doubted value
  void add(const MotionStep& step, const Where& of = {}) {
    if (first) {
      ++more;
      return;
    }
    first = &step;
    line = of.line > 0 ? of : step.where;
  }
  void warn(const WarningsOfKind& add, const std::string& what, const std::string& cause,
            const std::string& remedy) const {
    add(line, what + (more ? fmt::format(" (and {} more)", more) : ""), cause, remedy);
  }
};

struct Seen {
  const MotionStep* first = nullptr;
  std::vector<double> low, high;  ///< (axis) over all joint targets
  Doubted slow, fast, waits, creeping, turning, repeats, lazy, wide;
  std::vector<double> last;  ///< (axis) of the last joint target
  double fastest = 0;        ///< of any axis, for moves with durations [rad/s]
  double farthest = 0;       ///< between joint targets without durations [rad]
  int untimed = 0;           ///< joint targets without durations
  int moves = 0;
  bool all_joints = true;
  bool default_speed = false;  ///< a move has no speed of its own
  bool only_timed = true;      ///< all moves are joint moves, and all except the first have durations
};

/// Returns whether the step's program writes speeds in m/s, as KRL and URScript do. The others, and the keys, write mm/s.
bool in_metres(const MotionStep& step) {
  const std::string file = lower_case(step.where.file);
  return file.ends_with(".src") || file.ends_with(".script") || file.ends_with(".urscript");
}

double fastest_tool_of(const MotionStep& step) {
  return lower_case(step.where.file).ends_with(".src") ? fastest_of_kuka : fastest_tool;
}

void add_steps(const std::vector<MotionStep>& steps, Seen& seen) {
  for (const MotionStep& step : steps) {
    add_steps(step.steps, seen);
    if (step.speed_percent && *step.speed_percent < least_percent) seen.slow.add(step, step.speed_where);
    if (step.acceleration_percent.value_or(100) <= least_percent) seen.lazy.add(step, step.acceleration_where);
    if (step.tool_zone.value_or(0) > widest_path_zone) seen.wide.add(step);
    if (step.tool_speed.value_or(0) > fastest_tool_of(step)) seen.fast.add(step, step.speed_where);
    if (step.repeat > most_repeats) seen.repeats.add(step);
    if (step.tool_speed.value_or(1) < slowest_tool) seen.creeping.add(step, step.speed_where);
    if (step.speed.value_or(1) < slowest_move) seen.turning.add(step);
    if (step.dwell > longest_dwell) seen.waits.add(step);
    seen.moves += step.is_move();
    if (step.is_move() && step.joints.empty()) seen.all_joints = false;
    if (step.is_move() && !step.speed && !step.speed_percent && !step.tool_speed && !step.turn_speed && !step.duration)
      seen.default_speed = true;
    if (step.is_move() && (step.joints.empty() || (seen.first && !step.duration))) seen.only_timed = false;
    if (step.joints.empty()) continue;
    for (std::size_t k = 0; step.duration && k < std::min(seen.last.size(), step.joints.size()); ++k)
      seen.fastest = std::max(seen.fastest, std::abs(step.joints[k] - seen.last[k]) / *step.duration);
    if (!step.duration && ++seen.untimed > 1)
      for (std::size_t k = 0; k < std::min(seen.last.size(), step.joints.size()); ++k)
        seen.farthest = std::max(seen.farthest, std::abs(step.joints[k] - seen.last[k]));
    seen.last = step.joints;
    if (!seen.first) seen.first = &step, seen.low = step.joints, seen.high = step.joints;
    for (std::size_t k = 0; k < std::min(seen.low.size(), step.joints.size()); ++k) {
      seen.low[k] = std::min(seen.low[k], step.joints[k]);
      seen.high[k] = std::max(seen.high[k], step.joints[k]);
    }
  }
}

/// Collects targets without their blocks: those of joint moves without durations, and positions of the tool.
void gather(const std::vector<MotionStep>& steps, std::vector<const MotionStep*>& joints,
            std::vector<const MotionStep*>& places) {
  for (const MotionStep& step : steps) {
    gather(step.steps, joints, places);
    if (!step.joints.empty() && !step.duration) joints.push_back(&step);
    if (!step.position.empty()) places.push_back(&step);
  }
}

double largest_size(const std::vector<double>& numbers) {
  return largest_of(numbers, 0.0, [](double number) { return std::abs(number); });
}
std::ptrdiff_t nonzero(const std::vector<double>& numbers) {
  return std::ranges::count_if(numbers, [](double x) { return x != 0; });
}

/// Warns of one axis of one target in radians: at all other targets the axis is far from 0 on the same side, and the number in
/// radians lies near to them.
void doubt_single_axes(const std::vector<const MotionStep*>& joints, const WarningsOfKind& add) {
  constexpr std::size_t fewest = 3;           // other targets: two are no pattern
  constexpr double neighbours = 30 * degree;  // ESTIMATE: from the angles of the axis at other targets
  for (std::size_t k = 0; !joints.empty() && k < joints.front()->joints.size(); ++k) {
    const MotionStep* odd = nullptr;  // may be the target of several moves
    std::vector<double> others;
    bool one = true;
    for (const MotionStep* step : joints) {
      const double angle = k < step->joints.size() ? step->joints[k] : 0;
      if (std::abs(angle) >= wide_targets)
        others.push_back(angle);
      else if (!odd)
        odd = step;
      else
        one &= odd->joints[k] == angle;
    }
    if (!odd || !one || others.size() < fewest) continue;
    const double number = odd->joints[k] / degree;  // also the angle that was meant [rad]
    if (std::abs(number) <= small_turn || std::abs(number) > half_turn ||
        std::abs(std::remainder(number, 0.5)) < 1e-9 || largest_size(odd->joints) / degree <= half_turn)
      continue;
    const auto [low, high] = std::ranges::minmax(others);
    if (low * number < 0 || high * number < 0 || number < low - neighbours || number > high + neighbours) continue;
    add(odd->where,
        fmt::format(
            "axis {} of this target is at {:.4g} deg (limit: at the other targets it is at {:.4g} .. {:.4g} deg)",
            k + 1, number, low / degree, high / degree),
        "radians instead of degrees in one number",
        fmt::format("{:.4g} if that was radians; leave it if the axis moves so far here", number / degree));
  }
}

/// Warns of few targets in radians among others in degrees, and of few positions in metres among others in millimetres.
void doubt_single_targets(const std::vector<MotionStep>& steps, const WarningsOfKind& add) {
  std::vector<const MotionStep*> joints, places;
  gather(steps, joints, places);
  Doubted radians, metres;
  double widest = 0;                         // [rad]
  std::vector<const MotionStep*> different;  // a program may come back to one target many times
  for (const MotionStep* step : joints) {
    widest = std::max(widest, largest_size(step->joints));
    if (std::ranges::none_of(different, [&](const MotionStep* other) { return other->joints == step->joints; }))
      different.push_back(step);
  }
  for (const MotionStep* step : different)
    if (const double largest = largest_size(step->joints) / degree;
        largest > small_turn && largest <= half_turn && widest > wide_targets && nonzero(step->joints) >= 3)
      radians.add(*step);
  const auto few = [](const Doubted& found, std::size_t all) {
    return found.first && 3 * (static_cast<std::size_t>(found.more) + 1) <= all + 1;
  };
  if (few(radians, different.size())) {
    const auto meant =
        mapped(radians.first->joints, [](double angle) { return fmt::format("{:.4g}", angle / degree / degree); });
    radians.warn(
        add,
        fmt::format("all angles of this target are below {:.3g} deg (limit: those of other targets reach {:.0f} deg)",
                    half_turn, widest / degree),
        "radians instead of degrees in one target",
        fmt::format("[{}] if those were radians; leave it if the robot's pose is this near to its zero pose",
                    fmt::join(meant, ", ")));
  }
  doubt_single_axes(joints, add);
  const std::vector<double> reaches =
      mapped(places, [](const MotionStep* step) { return largest_size(step->position); });
  if (reaches.empty()) return;
  const double farthest_place = *std::ranges::max_element(reaches);
  for (std::size_t k = 0; k < places.size(); ++k)
    // Only positions in one work object are compared: the origin of another one may be its only position.
    if (const double reach = reaches[k];
        reach >= least_metres && reach <= most_metres && farthest_place >= far_place &&
        nonzero(places[k]->position) >= 2 && std::ranges::any_of(places, [&](const MotionStep* other) {
          return other->work_object == places[k]->work_object && largest_size(other->position) >= far_place;
        }))
      metres.add(*places[k]);
  if (few(metres, places.size())) {
    const std::vector<double>& at = metres.first->position;
    metres.warn(
        add,
        fmt::format(
            "this target lies {:.3g} mm from the origin of its frame (limit: others lie up to {:.0f} mm from theirs)",
            1e3 * largest_size(at), 1e3 * farthest_place),
        "metres instead of millimetres in one target",
        fmt::format(
            "[{:.4g}, {:.4g}, {:.4g}] if those were metres; leave it if it is a place at the origin of the work object",
            1e6 * at[0], 1e6 * at[1], 1e6 * at[2]));
  }
}

/// Warns of few positions beside the preceding one in the same orientation, for example by Offs in RAPID with an offset in
/// metres.
void doubt_small_steps(const std::vector<MotionStep>& steps, const WarningsOfKind& add) {
  std::vector<const MotionStep*> joints, places;
  gather(steps, joints, places);
  Doubted small;
  double way = 0;  // [m]
  for (std::size_t k = 1; k < places.size(); ++k) {
    const MotionStep &before = *places[k - 1], &now = *places[k];
    if (before.work_object != now.work_object || before.tool != now.tool || before.quaternion != now.quaternion)
      continue;
    double squared = 0;
    for (std::size_t i = 0; i < std::min(before.position.size(), now.position.size()); ++i)
      squared += (now.position[i] - before.position[i]) * (now.position[i] - before.position[i]);
    if (squared < least_step * least_step || squared > most_step * most_step) continue;
    if (!small.first) way = std::sqrt(squared);
    small.add(now);
  }
  if (!small.first || 3 * (static_cast<std::size_t>(small.more) + 1) > places.size()) return;  // a dense path
  small.warn(
      add,
      fmt::format("this target lies {:.3g} mm from the one before (limit {:g} mm or more)", 1e3 * way, 1e3 * most_step),
      "an offset in metres instead of millimetres",
      fmt::format("{:.4g} mm in the program if that was metres", 1e6 * way));
}

/// Returns the place of the line in a program that assigns this tool or work object; line 0: none.
Where assigned_at(const std::vector<MotionStep>& steps, const std::string& name) {
  for (const MotionStep& step : steps) {
    const Where where = step.tool == name          ? step.tool_where
                        : step.work_object == name ? step.object_where
                                                   : assigned_at(step.steps, name);
    if (where.line > 0) return where;
  }
  return {};
}

/// Warns of tools and work objects that are close to their reference frame, but not equal to it.
void doubt_frames(const std::vector<MotionFrame>& frames, const char* kind, const Motion& motion,
                  const WarningsOfKind& add) {
  for (const MotionFrame& frame : frames) {
    const Where assigned = assigned_at(motion.steps, frame.name), &where = assigned.line > 0 ? assigned : motion.where;
    const Vector3d& at = frame.position;
    if (std::string_view(kind) == "tool" && !frame.stationary &&
        at.z() < -std::max(tool_behind, std::hypot(at.x(), at.y())))
      add(where,
          fmt::format("the centre of tool '{}' lies {:.4g} mm behind the flange, in the arm (limit {:g})", frame.name,
                      -1e3 * at.z(), 1e3 * tool_behind),
          "a wrong sign: z points out of the flange",
          fmt::format("[{:.4g}, {:.4g}, {:.4g}] in its declaration if so", 1e3 * at.x(), 1e3 * at.y(), -1e3 * at.z()));
    if (const double reach = at.cwiseAbs().maxCoeff(); reach < least_metres || reach > most_metres) continue;
    add(where,
        fmt::format("{} '{}' lies {:.3g} mm from the frame in which it is given (limit 0, or more than {:g} mm)", kind,
                    frame.name, 1e3 * at.norm(), 1e3 * most_metres),
        "metres instead of millimetres",
        fmt::format("[{:.4g}, {:.4g}, {:.4g}] in its declaration if those were metres", 1e6 * at.x(), 1e6 * at.y(),
                    1e6 * at.z()));
  }
}

}  // namespace

std::vector<Warning> plausibility_of_steps(const Motion& motion) {
  Seen seen;
  add_steps(motion.steps, seen);
  std::vector<Warning> warnings;
  const WarningsOfKind add(warnings, WarningKind::motion);
  // A controller's program has no keys.
  const auto key = [](const char* in_job, const char* in_program, const MotionStep& step) {
    const std::string& file = step.where.file;
    return file.empty() || file.ends_with(".yaml") || file.ends_with(".yml") ? in_job : in_program;
  };
  if (const MotionStep* step = seen.slow.first)
    seen.slow.warn(add, fmt::format("speed_percent is {:g} (limit {:g} or more)", *step->speed_percent, least_percent),
                   "a share instead of a percentage",
                   if_kept(100 * *step->speed_percent >= least_percent,
                           fmt::format("{}{:g}{} if that was a share", key("speed_percent: ", "", *step),
                                       100 * *step->speed_percent, key("", " %", *step)),
                           fmt::format("{}100{}, or the speed in per cent", key("speed_percent: ", "", *step),
                                       key("", " %", *step))));
  if (const MotionStep* step = seen.fast.first) {
    const double speed = *step->tool_speed, limit = fastest_tool_of(*step);
    const bool slipped = speed < surely_millimetres && 0.1 * speed <= limit;
    const auto written = [metres = in_metres(*step)](double v) {
      return metres ? fmt::format("{:g} m/s", v) : fmt::format("{:g} mm/s", 1e3 * v);
    };
    const bool millimetres = in_metres(*step) && 1e-3 * speed <= limit;
    seen.fast.warn(add, fmt::format("the tool's speed is {} (limit {} or less)", written(speed), written(limit)),
                   slipped       ? "a slip of the decimal point"
                   : millimetres ? "mm/s instead of m/s"
                                 : "a speed in another unit",
                   slipped ? fmt::format("{} if the decimal point slipped, in the program's unit", written(0.1 * speed))
                   : millimetres ? fmt::format("{} if that was mm/s", written(1e-3 * speed))
                                 : fmt::format("{} or less, in the program's unit", written(limit)));
  }
  if (const MotionStep* step = seen.lazy.first)
    seen.lazy.warn(
        add,
        fmt::format("the acceleration is {:g} % (limit more than {:g})", *step->acceleration_percent, least_percent),
        "a share instead of a percentage",
        if_kept(
            100 * *step->acceleration_percent > least_percent,
            fmt::format("the acceleration in per cent: {:g} if that was a share", 100 * *step->acceleration_percent),
            "the acceleration in per cent: 100"));
  if (const MotionStep* step = seen.wide.first)
    seen.wide.warn(
        add, fmt::format("the zone is {:g} mm (limit {:g} or less)", 1e3 * *step->tool_zone, 1e3 * widest_path_zone),
        "another unit or a slip of the decimal point",
        if_kept(*step->tool_zone / 100 <= widest_path_zone,
                fmt::format("{}{:g} mm if there are zeros too many", key("zone_mm: ", "a zone of ", *step),
                            10 * *step->tool_zone),
                fmt::format("{}{:g} mm or less", key("zone_mm: ", "a zone of ", *step), 1e3 * widest_path_zone)));
  if (const MotionStep* step = seen.repeats.first)
    seen.repeats.warn(add, fmt::format("repeat is {} (limit {} or less)", step->repeat, most_repeats),
                      "the repeats of the whole program, which goes round by itself",
                      "no repeat; hours of operation are fatigue.operating_hours_per_week");
  if (const MotionStep* step = seen.creeping.first)
    seen.creeping.warn(
        add,
        fmt::format("the tool's speed is {:.4g} mm/s (limit {:g} or more)", 1e3 * *step->tool_speed,
                    1e3 * slowest_tool),
        "m/s instead of mm/s, or a slip of the decimal point",
        fmt::format(
            "{}{:g}{} if that was m/s; 10 or 100 times as much if the decimal point slipped; leave it if the tool moves so slowly",
            key("speed_mm_per_s: ", "a speed of ", *step), 1e6 * *step->tool_speed, key("", " mm/s", *step)));
  if (const MotionStep* step = seen.turning.first)
    seen.turning.warn(
        add,
        fmt::format("speed_deg_per_s is {:.4g} (limit {:g} or more)", *step->speed / degree, slowest_move / degree),
        "radians per second instead of degrees",
        if_kept(*step->speed / degree >= slowest_move,
                fmt::format("speed_deg_per_s: {:.3g} if that was rad/s", *step->speed / degree / degree),
                "the speed in deg/s; leave it if the axis turns so slowly"));
  if (const MotionStep* step = seen.waits.first)
    seen.waits.warn(
        add,
        fmt::format("{} is {:g} (limit {:g} or less)", key("dwell_s", "the wait in seconds", *step), step->dwell,
                    longest_dwell),
        "milliseconds instead of seconds",
        fmt::format(
            "{}if the hose waits so long, {}{:g}: a run simulates each second of a wait, in which the hose soon is at rest, and "
            "the lives in repeats stay the same. Lives in hours then count without the rest of the wait; a duty with "
            "repeats_per_hour (dresslife duty) gives them with it",
            if_kept(step->dwell / 1000 <= longest_dwell,
                    fmt::format("{}{:g} if that was milliseconds; ", key("dwell_s: ", "a wait of ", *step),
                                step->dwell / 1000),
                    ""),
            key("dwell_s: ", "a wait of ", *step), settling_wait));
  if (motion.speed_percent != 100 && seen.moves > 0 && !seen.default_speed)
    add(motion.where, fmt::format("motion.speed_percent {:g} has no effect", motion.speed_percent),
        "each move of the program has its own speed",
        fmt::format("motion.override_percent: {:g} for the speed override of the controller",
                    motion.speed_percent < least_percent ? 100 * motion.speed_percent : motion.speed_percent));
  if (motion.override_percent <= least_percent)
    add(motion.where,
        fmt::format("motion.override_percent is {:g} (limit more than {:g})", motion.override_percent, least_percent),
        "a share instead of a percentage",
        fmt::format("motion.override_percent: {:g}",
                    100 * motion.override_percent > least_percent ? 100 * motion.override_percent : 100));
  doubt_single_targets(motion.steps, add);
  doubt_small_steps(motion.steps, add);
  doubt_frames(motion.tools, "tool", motion, add);
  doubt_frames(motion.work_objects, "work object", motion, add);
  if (!seen.first) return warnings;
  double largest = 0, way = 0;  // [deg]
  for (std::size_t k = 0; k < seen.low.size(); ++k) {
    largest = std::max({largest, std::abs(seen.low[k]) / degree, std::abs(seen.high[k]) / degree});
    way = std::max(way, (seen.high[k] - seen.low[k]) / degree);
  }
  if (seen.moves > 1 && seen.all_joints && way <= moves)
    add(seen.first->where, fmt::format("no axis moves by more than {:.2g} deg (limit {:.2g} or more)", way, moves),
        "targets that are copies of one, or turns instead of degrees", "joints_deg: the angles of each target");
  if (largest <= most_radians && way > moves)
    add(seen.first->where,
        fmt::format("no joint angle of the motion is larger than {:.3g} deg (limit {:.3g} or more)", largest,
                    most_radians),
        "radians instead of degrees", "joints_deg in degrees; leave it if the robot moves so little");
  if (seen.all_joints && seen.untimed == seen.moves && seen.moves >= least_targets && way > moves &&
      seen.farthest <= near_targets)
    add(seen.first->where,
        fmt::format(
            "{} targets without times are at most {:.2g} deg apart (limit more than {:.2g}): the robot stops at each",
            seen.moves, seen.farthest / degree, near_targets / degree),
        "a recording without its column of times",
        "a column time_s with the time of each row, or motion.zone_deg if these are targets of a program");
  if (seen.only_timed && way > moves && seen.fastest < least_speed)
    add(seen.first->where,
        fmt::format("no axis is faster than {:.2g} deg/s (limit {:.2g} or more)", seen.fastest / degree,
                    least_speed / degree),
        "milliseconds instead of seconds", "times in seconds");
  return warnings;
}

namespace {

/// Returns whether a place is in a URDF, whose lengths and angles are in m and rad.
bool is_urdf(const Where& where) { return where.file.ends_with(".urdf") || where.file.ends_with(".xml"); }

/// Returns whether the accelerations are a list in the job, beside the name of a URDF.
bool has_list(const Joint& joint) { return is_urdf(joint.where) && !is_urdf(joint.acceleration_where); }

void doubt_limits(const Joint& joint, const WarningsOfKind& add) {
  const double lower = joint.lower / degree, upper = joint.upper / degree,
               largest = std::max(std::abs(lower), std::abs(upper));
  if (largest <= most_turns || largest * degree > twice_around || std::abs(largest - endless_axis) < 1e-6) return;
  const std::string what =
      fmt::format("{} turns from {:.5g} to {:.5g} deg (limit {:g} turns)", joint.name, lower, upper, most_turns / 360);
  const std::string last = "; leave it if the axis is built to turn so far";
  if (is_urdf(joint.where))
    add(joint.where, what, "degrees in a URDF, whose angles are in radians",
        fmt::format("limit lower=\"{:.5g}\" upper=\"{:.5g}\" if those were degrees{}", joint.lower * degree,
                    joint.upper * degree, last));
  else
    add(joint.where, what, "degrees that were converted from radians twice",
        fmt::format("lower_deg: {:.5g} and upper_deg: {:.5g} if so{}", lower * degree, upper * degree, last));
}

/// Warns if all axes have ranges that are less than a turn in radians.
void doubt_ranges(const std::vector<const Joint*>& driven, const WarningsOfKind& add) {
  const double largest = largest_of(driven, 0.0, [](const Joint* joint) {  // [deg]
    return std::max(std::abs(joint->lower) / degree, std::abs(joint->upper) / degree);
  });
  if (driven.empty() || largest == 0 || largest > most_radians) return;
  const Joint& first = *driven.front();
  add(first.where,
      fmt::format("no axis of the robot turns farther than {:.3g} deg (limit {:.3g} or more)", largest, most_radians),
      is_urdf(first.where) ? "radians that were converted from degrees twice" : "radians instead of degrees",
      is_urdf(first.where)
          ? fmt::format("limit lower=\"{:.4g}\" upper=\"{:.4g}\" of {}, and of the other joints likewise",
                        first.lower / degree, first.upper / degree, first.name)
          : fmt::format(
                "lower_deg: {:.4g} and upper_deg: {:.4g} of {} if those were radians, and of the other joints likewise",
                first.lower / degree / degree, first.upper / degree / degree, first.name));
}

/// Warns of accelerations in the wrong order. The arm has more inertia than the wrist: in config/robots, axes 1 to 3 accelerate
/// at most 0.4 times as fast as axes 4 to 6.
void doubt_order(const std::vector<const Joint*>& driven, const WarningsOfKind& add) {
  constexpr std::size_t arm = 3, axes = 6;
  if (driven.size() != axes) return;
  std::vector<double> numbers = mapped(driven, [](const Joint* joint) { return joint->acceleration / degree; });
  const double least = *std::min_element(numbers.begin(), numbers.begin() + arm),
               most = *std::max_element(numbers.begin() + arm, numbers.end());
  const Joint& first = *driven.front();
  if (!(least > most) || !(most > 0)) return;
  std::ranges::reverse(numbers);
  const auto words = mapped(numbers, [](double number) { return fmt::format("{:.5g}", number); });
  add(first.acceleration_where,
      fmt::format(
          "axes 1 to 3 accelerate by {:.4g} deg/s2 and more, and the wrist by {:.4g} at most (limit: the arm has the most inertia "
          "and the least acceleration)",
          least, most),
      "the reversed order of the axes",
      fmt::format(
          "{}: {} if so", has_list(first) ? "accelerations_deg_per_s2" : "acceleration_deg_per_s2 of the axes in turn",
          has_list(first) ? fmt::format("[{}]", fmt::join(words, ", ")) : fmt::format("{}", fmt::join(words, ", "))));
}

void doubt_speed(const Joint& joint, const WarningsOfKind& add) {
  const double speed = joint.speed / degree;
  const bool slow = joint.speed < slowest_axis;
  if (!(joint.speed > 0) || (!slow && joint.speed <= fastest_axis)) return;
  const std::string limits = fmt::format("(limits {:g} .. {:g}", slowest_axis / degree, fastest_axis / degree);
  if (!is_urdf(joint.where))
    return add.number(joint.where, "speed_deg_per_s", " of " + joint.name, speed,
                      {slowest_axis / degree, fastest_axis / degree},
                      {slow ? OtherUnit{1 / degree, "radians per second instead of degrees", "rad/s"}
                            : OtherUnit{1 / 60.0, "degrees per minute", "deg/min"}},
                      {"another unit", "speed_deg_per_s of the data sheet"});
  add(joint.where,
      fmt::format("velocity of {} is {:.4g} rad/s, {:.4g} deg/s {} deg/s)", joint.name, joint.speed, speed, limits),
      slow ? "another unit, or a conversion that was made twice"
           : "degrees per second in a URDF, whose angles are in radians",
      slow ? fmt::format("velocity=\"{:.4g}\" if the conversion was made twice", speed)
           : fmt::format("velocity=\"{:.4g}\" if that was deg/s", joint.speed * degree));
}

/// Returns whether there is a warning that applies to all axes.
bool doubt_ramp(const Joint& joint, const std::vector<const Joint*>& driven, const WarningsOfKind& add) {
  const double speed = joint.speed / degree, ramp = joint.speed / joint.acceleration;
  if (ramp >= shortest_ramp && ramp <= longest_ramp) return false;
  const bool slow = ramp > longest_ramp;
  const auto meant = [&](const Joint& of) {
    return fmt::format("{:.4g}", slow ? of.acceleration / degree / degree : 2 * of.speed / degree);
  };
  const std::string cause = slow ? "radians instead of degrees" : "another unit",
                    why = slow ? " if that was rad/s2" : ", full speed in half a second";
  const std::string what = fmt::format(
      "{} takes {:.3g} s from rest to its full speed of {:.4g} deg/s by acceleration_deg_per_s2 {:.4g} (limits {:g} .. {:g} s)",
      joint.name, ramp, speed, joint.acceleration / degree, shortest_ramp, longest_ramp);
  if (!has_list(joint)) {
    add(joint.acceleration_where, what, cause, fmt::format("acceleration_deg_per_s2: {}{}", meant(joint), why));
    return false;
  }
  const auto numbers = mapped(driven, [&](const Joint* of) { return meant(*of); });
  add(joint.acceleration_where, what, cause,
      fmt::format("accelerations_deg_per_s2: [{}]{}", fmt::join(numbers, ", "), why));
  return true;
}

/// Warns of accelerations with an extra digit: in config/robots, arms need 0.15 s or more to their full speed, wrists 0.066 s.
void doubt_quick(const std::vector<const Joint*>& driven, const WarningsOfKind& add) {
  double longest = 0;
  std::vector<std::string> numbers;
  for (const Joint* joint : driven) {
    if (!(joint->acceleration > 0)) return;
    longest = std::max(longest, joint->speed / joint->acceleration);
    numbers.push_back(fmt::format("{:.5g}", joint->acceleration / degree / 10));
  }
  if (driven.empty() || longest >= quickest_robot || longest < shortest_ramp) return;
  const Joint& first = *driven.front();
  add(first.acceleration_where,
      fmt::format("every axis reaches its full speed within {:.3g} s (limit {:g} s or more for one of them)", longest,
                  quickest_robot),
      "accelerations with a digit too many, or in another unit",
      fmt::format("{}: {} if there is an extra zero",
                  has_list(first) ? "accelerations_deg_per_s2" : "acceleration_deg_per_s2 of the axes in turn",
                  has_list(first) ? fmt::format("[{}]", fmt::join(numbers, ", "))
                                  : fmt::format("{}", fmt::join(numbers, ", "))));
}

/// Warns of an acceleration with which one axis takes much more or less time to its full speed than the axes beside it. Makers
/// choose drives and gears in proportion: on the measured IRB 6640 these times differ by a factor of 2.1 in the arm and of 1.1 in
/// the wrist.
void doubt_digits(const std::vector<const Joint*>& driven, const WarningsOfKind& add) {
  constexpr double most_apart = 3;  // between the measured 2.1 and the factor of 10 of a lost digit
  constexpr std::size_t arm = 3, axes = 6;
  if (driven.size() != axes) return;
  const auto ramp = [](const Joint& of) { return of.speed / of.acceleration; };
  for (const Joint* joint : driven)
    if (!(joint->acceleration > 0) || !(ramp(*joint) >= shortest_ramp) || ramp(*joint) > longest_ramp) return;
  for (std::size_t k = 0; k < axes; ++k) {
    const std::size_t begin = k / arm * arm;
    const Joint &joint = *driven[k], &one = *driven[begin + (k + 1) % arm], &other = *driven[begin + (k + 2) % arm];
    const auto [low, high] = std::minmax({ramp(one), ramp(other)});
    const bool slow = ramp(joint) > most_apart * high;
    if (high > most_apart * low || (!slow && ramp(joint) >= low / most_apart)) continue;
    const double number = joint.acceleration / degree, ten_times = slow ? 10 * number : number / 10;
    const double like_beside = 10 * std::round(joint.speed / std::sqrt(low * high) / degree / 10);
    const auto numbers = mapped(driven, [&](const Joint* of) {
      return fmt::format("{:.5g}", of == &joint ? ten_times : of->acceleration / degree);
    });
    const bool list = has_list(joint);
    add(joint.acceleration_where,
        fmt::format(
            "{} takes {:.3g} s from rest to its full speed by acceleration_deg_per_s2 {:.5g}, the axes beside it {:.3g} "
            "and {:.3g} s (limit: {:g} times as much or as little)",
            joint.name, ramp(joint), number, ramp(one), ramp(other), most_apart),
        slow ? "a missing or exchanged digit" : "an extra or exchanged digit",
        fmt::format("{}: {} if a digit is {}; about {:g} is in proportion to the axes beside it",
                    list ? "accelerations_deg_per_s2" : "acceleration_deg_per_s2",
                    list ? fmt::format("[{}]", fmt::join(numbers, ", ")) : fmt::format("{:.5g}", ten_times),
                    slow ? "missing" : "too many", like_beside));
  }
}

void doubt_robot(const Robot& robot, const WarningsOfKind& add) {
  if (const double far = robot.base_position.norm(); far > farthest)
    add({}, fmt::format("robot.base_position_m lies {:.4g} m from the origin (limit {:g})", far, farthest),
        "millimetres instead of metres",
        fmt::format("robot.base_position_m: [{:g}, {:g}, {:g}]", robot.base_position.x() / 1e3,
                    robot.base_position.y() / 1e3, robot.base_position.z() / 1e3));
  std::vector<const Joint*> driven;
  for (const Joint& joint : robot.joints)
    if (joint.follows.empty()) driven.push_back(&joint);
  for (const Joint* joint : driven) doubt_limits(*joint, add);
  doubt_ranges(driven, add);
  doubt_order(driven, add);
  doubt_quick(driven, add);
  doubt_digits(driven, add);
  for (const Joint* joint : driven) doubt_speed(*joint, add);
  const auto ramps = [](const Joint* joint) {
    return joint->speed >= slowest_axis && joint->speed <= fastest_axis && joint->acceleration > 0;
  };
  for (const Joint* joint : driven)
    if (ramps(joint) && doubt_ramp(*joint, driven, add)) return;
}

/// Returns the origins of the frames of a robot's base and of its first two joints in the zero pose: points inside of the robot.
std::vector<std::pair<std::string, Eigen::Vector3d>> points_in(const Robot& robot) {
  Eigen::Vector3d at = robot.base_position;
  Eigen::Quaterniond orientation = from_roll_pitch_yaw(robot.base_orientation);
  std::vector<std::pair<std::string, Eigen::Vector3d>> points{{"the robot's base", at}};
  for (std::size_t k = 0; k < std::min<std::size_t>(2, robot.joints.size()); ++k) {
    at += orientation * robot.joints[k].origin;
    orientation = orientation * from_roll_pitch_yaw(robot.joints[k].orientation);
    points.emplace_back(robot.joints[k].name + " in the zero pose", at);
  }
  return points;
}

/// Warns of a box around the robot. Contact of robot and cell is not evaluated, so such a box has no effect until the dresspack
/// is in it too.
void doubt_boxes(const Cell& cell, const Robot& robot, const WarningsOfKind& add) {
  if (!robot.external_axes.empty()) return;  // external axes carry the robot to another place
  for (std::size_t k = 0; k < cell.boxes.size(); ++k) {
    const Box& box = cell.boxes[k];
    if (!box.orientation.isZero()) continue;
    for (const auto& [name, point] : points_in(robot)) {
      if (distance_from({}, {box}, point) >= -inside_robot) continue;
      add({},
          fmt::format("cell.boxes[{}] contains {} at [{:.3g}, {:.3g}, {:.3g}] m", k + 1, name, point.x(), point.y(),
                      point.z()),
          "a box in another frame than the world's, or sides_m that are twice as long as they are",
          "position_m of its centre in the world, and sides_m, its full lengths");
      break;
    }
  }
}

void doubt_cell(const Cell& cell, const SimulationSettings& simulation, const WarningsOfKind& add) {
  const std::size_t shapes = cell.boxes.size() + cell.capsules.size() + cell.meshes.size();
  if (shapes > 0 && !simulation.contact)
    add({},
        fmt::format("the {} shape{} of cell have no effect, because simulation.contact is false", shapes,
                    shapes == 1 ? "" : "s"),
        "contact that was switched off for a trial", "simulation.contact: true, or no cell");
  for (std::size_t k = 0; k < cell.boxes.size(); ++k)
    if (const Eigen::Vector3d& sides = cell.boxes[k].sides; sides.maxCoeff() > longest_box)
      add({}, fmt::format("cell.boxes[{}] is {:.4g} m long (limit {:g})", k + 1, sides.maxCoeff(), longest_box),
          "millimetres instead of metres",
          fmt::format("sides_m: [{:g}, {:g}, {:g}] if those were millimetres", sides.x() / 1e3, sides.y() / 1e3,
                      sides.z() / 1e3));
    else if (const double far = cell.boxes[k].position.norm() - cell.boxes[k].sides.norm(); far > farthest)
      add({}, fmt::format("cell.boxes[{}] lies {:.4g} m from the origin (limit {:g})", k + 1, far, farthest),
          "another unit", "position_m in metres, or no box: the dresspack does not reach it");
  for (std::size_t k = 0; k < cell.capsules.size(); ++k)
    add.number({}, "radius_mm", fmt::format(" of cell.capsules[{}]", k + 1), 1e3 * cell.capsules[k].radius, {1},
               {from_metres});
}

/// Warns of radians in the rounded form of controllers: no axis beyond a turn, and fractions of a degree.
void doubt_mounting(const std::string& path, const Routing& routing, const WarningsOfKind& add) {
  std::vector<std::string> written, meant;
  double largest = 0;
  int parts = 0;
  for (const double angle : routing.mounting_pose) {
    const double number = angle / degree;
    largest = std::max(largest, std::abs(number));
    parts += std::abs(number - std::round(number)) > 1e-9;
    written.push_back(fmt::format("{:.4g}", number));
    meant.push_back(fmt::format("{:.4g}", number / degree));
  }
  if (parts < 2 || largest > most_radians) return;
  add(routing.where,
      fmt::format("no angle of {}.mounting_pose_deg, [{}], is larger than {:.3g} deg (limit {:.3g} or more)", path,
                  fmt::join(written, ", "), largest, most_radians),
      "radians instead of degrees",
      fmt::format(
          "{}.mounting_pose_deg: [{}] if those were radians; leave it if the arm was this near to its zero pose", path,
          fmt::join(meant, ", ")));
}

/// Returns those of the two links beside `name` in the chain to whose shapes the point in their frame is nearer than `most` [m]:
/// "link_1 or link_3"; empty: none.
std::string links_beside(const Robot& robot, const std::string& name, const Vector3d& point, double most) {
  std::vector<std::string> names;
  const auto at = std::ranges::find(robot.links, name, &Link::name);
  for (auto other = at == robot.links.begin() ? at : at - 1; other != robot.links.end() && other <= at + 1; ++other)
    if (other != at && distance_to(robot, other->name, point).value_or(most) < most) names.push_back(other->name);
  return fmt::format("{}", fmt::join(names, " or "));
}

/// Warns of a clamp on the last link that lies far behind the flange, while the same numbers in the frame of the flange are before
/// it. A bracket that reaches back half of the way to the centre of the wrist is in the way of axis 5.
void doubt_flange_frame(const std::string& key, const Clamp& clamp, const Robot& robot, const WarningsOfKind& add) {
  constexpr double least = 0.05;  // [m]: brackets of the tool reach back so far
  if (robot.links.empty() || clamp.link != robot.links.back().name || robot.joints.empty()) return;
  const Eigen::Quaterniond flange = from_roll_pitch_yaw(robot.flange_orientation);
  const double behind = -(flange.conjugate() * (clamp.position - robot.flange_position)).z();
  const double wrist = robot.flange_position.norm() + robot.joints.back().origin.norm();
  if (behind <= std::max(least, wrist / 2) || clamp.position.z() < 0) return;
  const Vector3d meant = robot.flange_position + flange * clamp.position, to = flange * clamp.direction;
  add(clamp.where,
      fmt::format("{}.position_m lies {:.3g} m behind the flange (limit {:.3g}, half of the way to the wrist's centre)",
                  key, behind, std::max(least, wrist / 2)),
      "a place in the frame of the flange (tool0) instead of that of " + clamp.link,
      fmt::format(
          "position_m: [{:.4g}, {:.4g}, {:.4g}] and direction: [{:.3g}, {:.3g}, {:.3g}] if so; leave it if the bracket "
          "reaches back so far",
          meant.x(), meant.y(), meant.z(), to.x(), to.y(), to.z()));
}

/// Warns of a clamp at the origin of its link's frame, on the axis of a joint. At a flange it may be a hose through the tool.
bool doubt_origin(const std::string& key, const Clamp& clamp, const Robot& robot, const WarningsOfKind& add) {
  const bool at_flange =
      !robot.links.empty() && clamp.link == robot.links.back().name && robot.flange_position.isZero();
  if (!clamp.position.isZero() || at_flange) return false;
  add(clamp.where,
      fmt::format("{}.position_m is [0, 0, 0], the origin of {}: inside of the robot, on the axis of a joint", key,
                  clamp.link),
      "a place that was not filled in",
      fmt::format("{}.position_m of the bracket, in metres in the frame of {}: dresslife preview shows it by a "
                  "click on the link",
                  key, clamp.link));
  return true;
}

/// Warns of a clamp that is farther from its link than a bracket or a tool is long. near_limit: usual_distance().
void doubt_place(const std::string& path, const std::string& key, const Clamp& clamp, const Routing& routing,
                 double near_limit, const Robot& robot, const WarningsOfKind& add) {
  const double bracket = routing.longest_bracket.value_or(0), limit = std::max(longest_tool, bracket);
  const auto away = distance_to(robot, clamp.link, clamp.position);
  if (!away || doubt_origin(key, clamp, robot, add)) return;
  doubt_flange_frame(key, clamp, robot, add);
  const bool on_tool = clamp.link == robot.links.back().name;
  const std::string longer_bracket =
      fmt::format("or {}.longest_bracket_mm: {:.0f} if a bracket is so long", path, std::ceil(1e2 * *away) * 10);
  const std::string beside =
      on_tool || *away <= near_link ? "" : links_beside(robot, clamp.link, clamp.position, near_limit);
  for (const auto& [one, other] : {std::pair{0, 2}, {0, 1}, {1, 2}}) {
    Vector3d exchanged = clamp.position;
    std::swap(exchanged[one], exchanged[other]);
    const double then = *distance_to(robot, clamp.link, exchanged);
    if (*away <= near_limit || then > *away / (*away > near_link ? 2 : 4) || then == 0) continue;  // inside of the link
    return add(
        clamp.where,
        fmt::format("{}.position_m lies {:.3g} m from all shapes of {} (limit {:.3g})", key, *away, clamp.link,
                    near_limit),
        beside.empty() ? "exchanged coordinates" : fmt::format("exchanged coordinates, or a place on {}", beside),
        fmt::format("position_m: [{:g}, {:g}, {:g}] if coordinates are exchanged, ", exchanged.x(), exchanged.y(),
                    exchanged.z()) +
            (beside.empty() ? "" : fmt::format("link: {} if it is there, ", beside)) + longer_bracket);
  }
  if (*away <= limit && (beside.empty() || *away <= bracket)) return;
  // Tries wrong decimal points in one, then two, then three numbers: the first combination near to the link is proposed.
  Vector3d best = clamp.position;
  double nearest = *away;
  for (const int which : {1, 2, 4, 3, 5, 6, 7}) {
    Vector3d other = clamp.position;
    for (int i = 0; i < 3; ++i)
      if (which & (1 << i)) other[i] /= 10;
    if (nearest > near_link) best = other, nearest = *distance_to(robot, clamp.link, other);
  }
  add(clamp.where,
      fmt::format("{}.position_m lies {:.3g} m from all shapes of {} (limit {:g}): the clamp is in the air", key, *away,
                  clamp.link, std::min(limit, *away <= limit ? near_limit : limit)),
      beside.empty() ? "a decimal point at another place, another link or a place in another frame"
                     : fmt::format("a place on {}", beside),
      (beside.empty() ? "" : fmt::format("link: {} if it is there; ", beside)) +
          (nearest <= near_link ? fmt::format("position_m: [{:g}, {:g}, {:g}] if a decimal point slipped; ", best.x(),
                                              best.y(), best.z())
                                : std::string("position_m in the frame of the link; ")) +
          (on_tool ? fmt::format("or the shape of the tool as robot.links.{}.boxes, if it is clamped to a large tool",
                                 robot.links.size())
                   : longer_bracket));
}

/// Warns of angles about the axes, in the form of controllers, instead of a direction.
void doubt_direction(const std::string& key, const Clamp& clamp, const WarningsOfKind& add) {
  constexpr double round_angle = 5, most = 360;
  const Vector3d& to = clamp.direction;
  for (const double number : to)
    if (std::abs(number) > most || std::abs(std::remainder(number, round_angle)) > 1e-9) return;
  const Vector3d unit = to.normalized();
  add(clamp.where,
      fmt::format("{}.direction is [{:g}, {:g}, {:g}] (limit: numbers below {:g})", key, to.x(), to.y(), to.z(),
                  round_angle),
      "angles in degrees instead of a vector",
      fmt::format(
          "direction: [{:.3g}, {:.3g}, {:.3g}] if it points there from the base to the tool, in the frame of the link; [1, 0, 0] is its x axis",
          unit.x(), unit.y(), unit.z()));
}

auto link_of(const Robot& robot, const Clamp& clamp) { return std::ranges::find(robot.links, clamp.link, &Link::name); }

void doubt_order_of_clamps(const std::string& path, const Routing& routing, const Robot& robot,
                           const WarningsOfKind& add) {
  if (!clamps_exchanged(routing, robot)) return;
  const auto base = link_of(robot, *routing.base_clamp), tool = link_of(robot, *routing.tool_clamp);
  const auto away = [&](const Link& link, const Clamp& clamp) {
    return distance_to(robot, link.name, clamp.position).value_or(0);
  };
  const bool links = away(*tool, *routing.base_clamp) + away(*base, *routing.tool_clamp) <
                     away(*base, *routing.base_clamp) + away(*tool, *routing.tool_clamp);
  add(routing.base_clamp->where,
      fmt::format("{0}.base_clamp is on {1}, and {0}.tool_clamp on {2}, which is nearer to the robot's base", path,
                  base->name, tool->name),
      "exchanged clamps, or exchanged links",
      links ? fmt::format(
                  "{0}.base_clamp.link: {1} and {0}.tool_clamp.link: {2}: then both places are nearer to their links",
                  path, tool->name, base->name)
            : std::string("exchange base_clamp and tool_clamp"));
}

/// path: key of the routing in the job (line_key()).
void doubt_routing(const std::string& path, const Routing& routing, const Dresspack& dresspack, const Robot& robot,
                   int segments, const WarningsOfKind& add) {
  doubt_mounting(path, routing, add);
  doubt_order_of_clamps(path, routing, robot, add);
  const bool centimetres = routing.free_length < shortest_in_mm;
  add.number(routing.where, path + ".free_length_m", "", routing.free_length, {0, longest_hose},
             {centimetres ? OtherUnit{1e-2, "centimetres instead of metres", "centimetres"} : from_millimetres});
  for (const auto& [key, clamp] :
       {std::pair{path + ".base_clamp", &routing.base_clamp}, {path + ".tool_clamp", &routing.tool_clamp}}) {
    if (*clamp) doubt_direction(key, **clamp, add);
    if (*clamp && (*clamp)->position.norm() > farthest_clamp) {
      const Eigen::Vector3d& at = (*clamp)->position;
      add((*clamp)->where,
          fmt::format("{}.position_m lies {:.4g} m from the frame of its link (limit {:g})", key, at.norm(),
                      farthest_clamp),
          "centimetres instead of metres, or a place in the world",
          fmt::format("position_m: [{:g}, {:g}, {:g}] if those were centimetres", at.x() / 100, at.y() / 100,
                      at.z() / 100));
    } else if (*clamp && &**clamp != clamp_on_wrong_link(routing, robot)) {
      doubt_place(path, key, **clamp, routing, usual_distance(routing, dresspack), robot, add);
    }
  }
  if (const double limit = least_bend_radius(dresspack), segment = routing.free_length / segments;
      routing.base_clamp && segments < few_segments && segment > longest_segment * limit && limit > 0)
    add(routing.where,
        fmt::format(
            "simulation.segments is {}: a segment is {:.3g} m long (limit {:.3g} m: {:g} of the least bend radius)",
            segments, segment, longest_segment * limit, longest_segment),
        "a number for a trial: the shape, the bends and the lives are wrong", "simulation.segments: 64");
  // Small angles in radians or turns are multiples of an eighth or a half of a turn; a search proposes any angle.
  constexpr double rounded = 0.005;
  const double number = routing.pre_twist / degree;
  const bool simple =
      std::abs(std::remainder(number, pi / 4)) < rounded || std::abs(std::remainder(number, 0.5)) < 1e-9;
  if (const double twist = std::abs(routing.pre_twist);
      (twist > 0 && twist < least_pre_twist && simple) || twist > largest_pre_twist)
    add(routing.where,
        fmt::format("{}.pre_twist_deg is {:.4g} (limits {:.3g} .. {:g})", path, routing.pre_twist / degree,
                    least_pre_twist / degree, largest_pre_twist / degree),
        twist < least_pre_twist ? "radians or turns instead of degrees" : "another unit",
        twist < least_pre_twist
            ? fmt::format("{}.pre_twist_deg: {:.4g} if that was radians", path, routing.pre_twist / degree / degree)
            : path + ".pre_twist_deg: -180 .. 180");
  if (const double bracket = routing.longest_bracket.value_or(0); bracket > 0)
    add.number(routing.where, path + ".longest_bracket_mm", "", 1e3 * bracket,
               {1e3 * shortest_bracket, 1e3 * longest_built, ", or 0"}, {from_metres},
               {"another unit", path + ".longest_bracket_mm: 150"});
  for (const GuideRing& ring : routing.rings)
    add.number(
        ring.where, "radius_mm", " of a ring", 1e3 * ring.radius,
        {0, 5e2 * widest_ring * dresspack.diameter, fmt::format(": {:g} diameters of the dresspack wide", widest_ring)},
        {},
        {"another unit",
         fmt::format("radius_mm: {:.3g}, a little more than the dresspack's", 6e2 * dresspack.diameter)});
  if (!routing.retraction) return;
  const Retraction& unit = *routing.retraction;
  constexpr std::string_view of = " of the retraction unit";
  add.number(unit.where, "stroke_m", of, unit.stroke, {0, longest_stroke}, {from_millimetres});
  add.number(unit.where, "force_N", of, unit.force, {0, largest_pull},
             {{1e-3, "millinewtons instead of newtons", "mN"}},
             {"another unit", "force_N: 20 to 100 N, as its maker states"});
  if (unit.force == 0 && unit.spring == 0)
    add(unit.where, "force_N of the retraction unit is 0, and it has no spring: it pulls nothing back",
        "a force that is not known", "force_N: 20 to 100 N, as its maker states");
  add.number(unit.where, "spring_N_per_m", of, unit.spring, {0, stiffest_spring},
             {{1e-3, "N/km instead of N/m", "N/km"}}, {"another unit", "spring_N_per_m, as its maker states"});
  add.number(unit.where, "mass_kg", of, unit.mass, {0, heaviest_slider},
             {{1e-3, "grams instead of kilograms", "grams"}}, {"another unit", "mass_kg, as its maker states"});
}

/// Warns of spreads that are too large. Each is a factor of one standard deviation, except that of the slope, which is an addend.
void doubt_spreads(const Job& job, const WarningsOfKind& add) {
  for (std::size_t p = 0; p < uncertain_count; ++p)
    if (job.uncertainty.spread[p] > widest_spread)
      add({},
          fmt::format("uncertainty.{} is {:g} (limit {:g}: a factor in one standard deviation)",
                      uncertain_parameters()[p].name, job.uncertainty.spread[p], widest_spread),
          "per cent instead of a factor",
          if_kept(1 + job.uncertainty.spread[p] / 100 <= widest_spread,
                  fmt::format("uncertainty.{}: {:g} if that was per cent", uncertain_parameters()[p].name,
                              1 + job.uncertainty.spread[p] / 100),
                  fmt::format("no uncertainty.{}", uncertain_parameters()[p].name)));
}

/// Warns of the quaternion of a tool or work object in the order x, y, z, w that leaves the frame nearly unturned. Read as w, x,
/// y, z it is nearly half a turn about z, which a robot's program may really have, and a key of a job rarely.
void doubt_order_of_quaternions(const Motion& motion, const WarningsOfKind& add) {
  constexpr double nearly_whole = 0.98;  // 23 deg from no turn
  for (const auto& [key, frames] : {std::pair{"tools", &motion.tools}, {"work_objects", &motion.work_objects}})
    for (std::size_t k = 0; k < frames->size(); ++k) {
      const MotionFrame& frame = (*frames)[k];
      const std::vector<double>& q = frame.quaternion;
      if (frame.quaternion_where.line == 0 || q.size() != 4 || std::abs(q[3]) < nearly_whole) continue;
      const bool whole = q[0] == 0 && q[1] == 0 && q[2] == 0;
      add(frame.quaternion_where,
          fmt::format(
              "the quaternion of motion.{}[{}] ('{}') is [{:g}, {:g}, {:g}, {:g}] (order: w, x, y, z), {} by 180 deg "
              "about z",
              key, k + 1, frame.name, q[0], q[1], q[2], q[3], whole ? "a turn" : "nearly a turn"),
          "the order x, y, z, w",
          fmt::format("[{:g}, {:g}, {:g}, {:g}] {}; leave it if the frame is turned so", q[3], q[0], q[1], q[2],
                      whole ? "if no turn is meant" : "if that was x, y, z, w"));
    }
}

std::vector<Warning> doubts_of_motion(const Job& job) {
  std::vector<Warning> warnings;
  const WarningsOfKind doubt(warnings, WarningKind::motion), periodic(warnings, WarningKind::periodic);
  if (job.motion.is_prescribed()) return warnings;
  doubt_robot(job.robot, doubt);
  if (const Robot& robot = job.robot; !robot.links_left_out.empty() && !robot.external_axes.empty())
    WarningsOfKind(warnings, WarningKind::material)(
        robot.external_axes.back().where,
        fmt::format("contact with {} is not evaluated (limit: links before the first track or after the last one)",
                    robot.links_left_out),
        "a robot on several tracks", "no change if the dresspack cannot touch them; else boxes where they are in cell");
  doubt_order_of_quaternions(job.motion, doubt);
  doubt_cell(job.cell, job.simulation, doubt);
  doubt_boxes(job.cell, job.robot, doubt);
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    doubt_routing(line_key(job, d, "routing"), job.dresspacks[d].routing, job.dresspacks[d].dresspack, job.robot,
                  job.simulation.segments, doubt);
  warnings = joined(std::move(warnings), radians_in(echo_fields(job.robot), "robot"));
  warnings = joined(std::move(warnings), radians_in(echo_fields(job.cell), "cell"));
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    warnings =
        joined(std::move(warnings), radians_in(echo_fields(job.dresspacks[d].routing), line_key(job, d, "routing")));
  periodic.number({}, "simulation.most_repeats", "", job.simulation.most_repeats, {0, repeats_to_steady}, {},
                  {"the repeats in the dresspack's life: the life is extrapolated from one repeat",
                   "simulation.most_repeats: 8, or no key"});
  periodic.number({}, "simulation.periodic_tolerance_mm", "", 1e3 * job.simulation.periodic_tolerance,
                  {0, 1e3 * largest_tolerance}, {},
                  {"another unit: every motion counts as periodic", "simulation.periodic_tolerance_mm: 1"});
  doubt.number({}, "motion.spot_time_s", "", job.motion.spot_time, {0, longest_spot}, {from_milliseconds},
               {"another unit", "motion.spot_time_s: 1, or the time of a weld in seconds"});
  doubt.number({}, "motion.speed_percent", "", job.motion.speed_percent, {least_percent}, {from_share},
               {"another unit", "motion.speed_percent: 100, or the speed in per cent"});
  doubt.number({}, "motion.zone_deg", "", job.motion.zone / degree, {0, widest_zone / degree}, {},
               {"another unit, such as mm or per cent", "motion.zone_deg: 0, or the zone that the controller uses"});
  const Eigen::Vector3d gravity = job.simulation.gravity;
  if (const double size = gravity.norm(); size > 0) {
    constexpr const char* downward = "simulation.gravity_m_per_s2: [0, 0, -9.81]";
    doubt.number({}, "the size of simulation.gravity_m_per_s2", "", size,
                 {(1 - gravity_spread) * standard_gravity, (1 + gravity_spread) * standard_gravity}, {},
                 {size < 2 ? "multiples of g instead of m/s2" : "another unit", downward});
    doubt.number(
        {}, "the upward part of simulation.gravity_m_per_s2", "", gravity.z(), {-no_limit, -down * size, ": downward"},
        {},
        {"a wrong sign or axis", fmt::format("{}; leave it if the robot is mounted on a wall or a ceiling", downward)});
  }
  return warnings;
}

/// Warns of short or rigid reliefs. With less than four segments, the parabola for the bend at a clamp (W39) contains links
/// outside of the relief.
void doubt_bend_reliefs(const MountedDresspack& mounted, int segments, std::vector<Warning>& warnings) {
  constexpr int fewest = fewest_relief_segments;
  const Routing& routing = mounted.routing;
  std::vector<const Clamp*> clamps;
  for (const std::optional<Clamp>* end : {&routing.base_clamp, &routing.tool_clamp})
    if (*end) clamps.push_back(&**end);
  for (const IntermediateClamp& between : routing.clamps) clamps.push_back(&between.clamp);
  for (const Clamp* const clamp : clamps) {
    if (!clamp->bend_relief || clamp->bend_relief->length == 0 || clamp->bend_relief->stiffness == 0) continue;
    if (const double own = mounted.dresspack.bending_stiffness, stiffness = clamp->bend_relief->stiffness;
        own > 0 && stiffness > rigid_relief * own)
      warnings.push_back(warning_of(
          WarningKind::material, clamp->where.text(),
          fmt::format("bend_relief.bending_stiffness_Nm2 is {:.4g} (limit {:.2g}, {:g} times the dresspack's)",
                      stiffness, rigid_relief * own, rigid_relief),
          "N mm2 instead of N m2, or a tube: the dresspack bends at its end as at a clamp",
          fmt::format("bending_stiffness_Nm2: {:.2g}, as the dresspack", own)));
    const double length = clamp->bend_relief->length, within = length * segments / routing.free_length;
    if (within >= fewest) continue;
    const double meant = length < 1e-3 ? 1e3 * length : length,
                 needed = std::ceil(fewest * routing.free_length / meant);
    const std::string finer = needed <= segments        ? ""
                              : needed <= finest_of_job ? fmt::format("simulation.segments: {:.0f}", needed)
                                                        : "a longer relief";
    warnings.push_back(warning_of(
        WarningKind::mesh, clamp->where.text(),
        fmt::format("bend_relief.length_mm is {:.4g}: {:.2g} segments (limit {}): the bend at the clamp is uncertain",
                    1e3 * length, within, fewest),
        length < 1e-3 ? "metres instead of millimetres" : "the segments are too long for it",
        length < 1e-3 ? fmt::format("bend_relief.length_mm: {:.4g}{}{} if that was metres", 1e3 * meant,
                                    finer.empty() ? "" : " and ", finer)
                      : finer));
  }
}

/// Warns of a cable whose cores are the parts of the first level. Clamps then grip each core, and in the plant only the jacket.
void doubt_cores(const Dresspack& dresspack, std::vector<Warning>& warnings) {
  if (!is_single_cable(dresspack) || dresspack.cable_alone) return;
  int count = 0;
  double filled = 0;  // share of the cross-section
  for (const Component& part : dresspack.components) {
    count += part.count;
    filled += part.count * std::pow(2 * part.radius / dresspack.diameter, 2);
  }
  constexpr double usual =
      0.25;  // the cores of two to 25 fill 0.3 to 0.5 of a cable, a few cables on a robot's arm less
  if (count < 2 || filled < usual) return;
  warnings.push_back(warning_of(
      WarningKind::material, dresspack.components.front().where.text(),
      fmt::format(
          "the {} parts of the dresspack fill {:.0f} % of its cross-section (limit {:.0f} %), as the cores of one "
          "cable do, and the clamps grip each of them",
          count, 100 * filled, 100 * usual),
      "one cable, whose clamps grip only the jacket in the plant; gripped cores have other strains",
      fmt::format(
          "one part `{{name: cable, helix_radius_mm: 0, radius_mm: {:.4g}}}`, with these parts as its components",
          500 * dresspack.diameter)));
}

/// Warns of hoses whose pressure exceeds the maker's limit at the cell's temperature.
void doubt_pressures(const Dresspack& dresspack, double temperature, std::vector<Warning>& warnings) {
  for (const auto* const parts : {&dresspack.components, &dresspack.core_components})
    for (const Component& part : *parts) {
      if (!part.plain || !part.plain->pressure || !part.plain->most_pressure) continue;
      constexpr double bar = 1e5;
      const double limit = *part.plain->most_pressure * pressure_at(temperature);
      if (*part.plain->pressure <= limit) continue;
      warnings.push_back(warning_of(
          WarningKind::material, part.plain->where.text(),
          fmt::format("the pressure_bar of {} is {:.3g} (limit {:.3g} at {:g} C by most_pressure_bar{})", part.name,
                      *part.plain->pressure / bar, limit / bar, temperature,
                      temperature > Cell::usual_temperature
                          ? ", with 1.75 % less per kelvin above 20 C as SMC's tubes of polyamide 12; PVC has 3 %"
                          : ""),
          "a pressure in another unit, or a tube that is too weak",
          "a tube for this pressure and temperature, or a lower pressure"));
    }
}

/// Adds the warnings that a calibration repeats, and that of makers' ratings without an effect.
void doubt_calibration(const Job& job, std::vector<Warning>& warnings) {
  if (const std::string& setting = job.uncertainty.ratings_left_out; !setting.empty())
    warnings.push_back(warning_of(
        WarningKind::calibration, "",
        "makers' ratings of typical cables have no effect on this job, because they were learned with " + setting,
        "a setting for a trial, or constants of the user",
        "leave that setting out, or set uncertainty.ratings: none in all jobs that you compare"));
  if (!job.calibration) return;
  const Eigen::MatrixXd prior = prior_of(job.uncertainty).covariance;
  constexpr double rounding = 1e-5;  // of LearnedParameter::prior
  for (const LearnedParameter& learned : job.calibration->parameters) {
    const auto p = static_cast<Eigen::Index>(index_of(learned.name));
    if (!job.uncertainty.enabled || p >= prior.rows()) continue;
    const double stated = std::sqrt(prior(p, p));
    if (std::abs(stated - 1) < rounding || std::abs(stated - learned.prior) < rounding) continue;
    warnings.push_back(warning_of(
        WarningKind::calibration, "",
        fmt::format("uncertainty.{}: {:g} has no effect, because the calibration has learned this parameter",
                    learned.name, job.uncertainty.spread[static_cast<std::size_t>(p)]),
        "a calibration replaces the uncertainty of the parameters that it has learned",
        fmt::format("leave uncertainty.{} out, or calibrate again with the same value in the jobs of the observations",
                    learned.name)));
  }
  std::istringstream repeated(job.calibration->contradiction + "\n" + job.calibration->doubts);
  for (std::string words; std::getline(repeated, words);)
    if (!words.empty()) warnings.push_back({WarningKind::calibration, "", "calibration: " + words});
}

}  // namespace

std::vector<Warning> plausibility_of_lives(const Job& job) {
  std::vector<Warning> warnings;
  const WarningsOfKind add(warnings, WarningKind::material);
  const Fatigue& fatigue = job.fatigue;
  if (const double percent = fatigue.failed_wires_percent; percent > 0)
    add.number(
        {}, "fatigue.failed_wires_percent", "", percent, {1, most_failed_wires, ", or 0"}, {from_share},
        {percent < 1 ? "a share instead of per cent"
                     : "a conductor that works with few wires, whose current and load the lives do not contain. Its "
                       "median life is at most ten times that of the worst wire",
         "fatigue.failed_wires_percent: 10"});
  for (const auto& [key, value] : {std::pair{"inspection.found_percent", job.inspection.found_percent},
                                   {"inspection.visible_depth_percent", job.inspection.visible_depth_percent}})
    if (value > 0 && value <= 1)
      add({}, fmt::format("{} is {:.6g} (limit 0, or more than 1)", key, value), "a share instead of per cent",
          if_kept(100 * value > 1, fmt::format("{}: {:g}", key, 100 * value), fmt::format("no {}, or per cent", key)));
  add.number({}, "fatigue.robot_life_hours", "", fatigue.robot_life_hours, {least_robot_life}, {},
             {"years instead of hours", "fatigue.robot_life_hours: 40000, or leave the key out"});
  add.week({}, "fatigue.operating_hours_per_week", "", fatigue.operating_hours_per_week);
  add.number({}, "fatigue.endurance_strain", "", fatigue.endurance_strain, {0, largest_endurance}, {from_percent},
             {"another unit", "no fatigue.endurance_strain"});
  const std::pair<const char*, double> factors[] = {{"fatigue.strength_factor", fatigue.strength_factor},
                                                    {"fatigue.model_factor", fatigue.model_factor},
                                                    {"fatigue.motion_factor", fatigue.motion_factor},
                                                    {"strain.friction_factor", job.strain.factors.friction},
                                                    {"strain.hose_friction_factor", job.strain.factors.hose_friction},
                                                    {"strain.slack_factor", job.strain.factors.slack},
                                                    {"strain.play_factor", job.strain.factors.play},
                                                    {"strain.grip_factor", job.strain.factors.grip}};
  for (const auto& [key, value] : factors)
    if (!job.calibration || job.calibration->typical)
      add.number({}, key, "", value, {1 / largest_factor, largest_factor},
                 {{1e-2, "per cent instead of a factor, or a factor for a trial", "per cent"}},
                 {"another unit, or a factor for a trial", fmt::format("{}: 1", key)});
  doubt_spreads(job, WarningsOfKind(warnings, WarningKind::motion));
  doubt_calibration(job, warnings);
  for (const MountedDresspack& mounted : job.dresspacks) {
    doubt_pressures(mounted.dresspack, job.cell.temperature, warnings);
    if (!job.motion.is_prescribed()) {
      warnings = joined(std::move(warnings), radians_in(echo_fields(mounted.dresspack), "dresspack"));
      if (job.motion.needs_robot() && slides(job.strain.slip.front())) doubt_cores(mounted.dresspack, warnings);
    }
  }
  WarningsOfKind(warnings, WarningKind::strain)
      .number({}, "strain.gate", "", job.strain.gate, {0, largest_gate, ": cycles below it are left out"},
              {from_percent},
              {"another unit", fmt::format("strain.gate: {:g}, or no key", largest_gate), ", or no key"});
  return warnings;
}

std::optional<double> distance_to(const Robot& robot, const std::string& name, const Vector3d& point) {
  const auto link = std::ranges::find(robot.links, name, &Link::name);
  if (link == robot.links.end() || !link->meshes.empty()) return {};
  double nearest = distance_from(link->capsules, link->boxes, point);
  if (&*link == &robot.links.back()) nearest = std::min(nearest, (point - robot.flange_position).norm());
  return std::isfinite(nearest) ? std::optional(std::max(0.0, nearest)) : std::nullopt;
}

double usual_distance(const Routing& routing, const Dresspack& dresspack) {
  return std::max(near_bracket, routing.longest_bracket.value_or(0)) + dresspack.diameter / 2;
}

const Clamp* clamp_on_wrong_link(const Routing& routing, const Robot& robot) {
  if (robot.links.empty() || !routing.base_clamp || !routing.tool_clamp ||
      routing.base_clamp->link != routing.tool_clamp->link)
    return nullptr;
  return robot.links.back().name == routing.base_clamp->link ? &*routing.base_clamp : &*routing.tool_clamp;
}

std::string probable_link(const Clamp& clamp, const Robot& robot) {
  if (clamp.link != robot.links.back().name) return robot.links.back().name;
  const Link* best = &robot.links[robot.links.size() / 2];  // the elbow of a robot with six axes
  double nearest = near_link;
  for (const Link& link : robot.links) {
    const double away = link.name == clamp.link ? 0 : distance_to(robot, link.name, clamp.position).value_or(0);
    if (away > 0 && away < nearest) best = &link, nearest = away;
  }
  return best->name;
}

bool clamps_exchanged(const Routing& routing, const Robot& robot) {
  if (!routing.base_clamp || !routing.tool_clamp) return false;
  const auto base = link_of(robot, *routing.base_clamp);  // the links of a robot are a chain from its base
  return base != robot.links.end() && base > link_of(robot, *routing.tool_clamp);
}

std::vector<Warning> located(std::vector<Warning> warnings, const Node& document) {
  static const std::regex key_words(R"([a-z_]+((\.|\[)[A-Za-z0-9_]+\]?)+)");
  for (Warning& warning : warnings) {
    std::smatch found;
    const std::string problem = parts_of(warning.words).problem;
    if (warning.where.empty() && !std::regex_search(problem, found, key_words)) continue;
    const Node* node = &document;
    bool whole = true;
    const std::string path = warning.where.empty() ? found.str() : warning.where;
    for (std::size_t begin = 0; whole && begin < path.size();) {
      const std::size_t end = std::min(path.find_first_of(".[]", begin), path.size());
      const std::string part = path.substr(begin, end - begin);
      begin = end + 1 + (path.substr(end, 2) == "].");
      const Node* next = node->is_map() ? node->find(part) : nullptr;
      if (const std::size_t item = node->is_list() ? std::strtoul(part.c_str(), nullptr, 10) : 0;
          item > 0 && item <= node->items.size())
        next = &node->items[item - 1];
      if (next)
        node = next;
      else
        whole = false;
    }
    if (whole) warning.where = node->where.text();
  }
  return warnings;
}

std::vector<Warning> warnings_of_descriptions(const Job& job) {
  std::vector<Warning> all;
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    all = joined(std::move(all), construction_warnings_at(line_key(job, d, "dresspack"), job.dresspacks[d].dresspack,
                                                          slides(job.strain.slip.front())));
  return all;
}

std::vector<Warning> plausibility_of_motion(const Job& job) {
  const Motion& motion = job.motion;
  std::vector<Warning> warnings = doubts_of_motion(job);
  const WarningsOfKind add(warnings, WarningKind::mesh);
  if (!motion.is_prescribed())
    add.number({}, "simulation.sample_rate_Hz", "", job.simulation.sample_rate, {least_rate}, {},
               {"seconds instead of 1/s; the samples miss the hose's swing", "simulation.sample_rate_Hz: 25"});
  if (!motion.is_prescribed() && !job.simulation.choose_time_step)
    add.number({}, "simulation.time_step_ms", "", 1e3 * job.simulation.time_step, {0, 1e3 * largest_step}, {},
               {"a digit too many; larger steps were not tested", "simulation.time_step_ms: 5, or auto"});
  if (!motion.is_prescribed())
    for (const MountedDresspack& mounted : job.dresspacks)
      doubt_bend_reliefs(mounted, job.simulation.segments, warnings);
  return motion.program.empty() ? joined(std::move(warnings), plausibility_of_steps(motion)) : warnings;
}

}  // namespace dresslife::pipeline
