#include "pipeline/resolve/plausible_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/warning_words.h"

namespace dresslife::pipeline {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double most_radians = 2 * std::numbers::pi;  // of an axis, if the numbers were radians
constexpr double moves = 0.1;          // an axis' way in one of these numbers: less is a robot that stands
constexpr double least_percent = 1;    // a hundredth of an axis' speed: no program of a plant runs so
constexpr double fastest_tool = 10;     // [m/s]: the fastest controllers allow 5 to 7
constexpr double longest_dwell = 100;  // [s]: the cycles of lines are shorter

constexpr double least_rate = 5;       // [Hz]: of a hose's swing at 1.8 Hz fewer than three samples
constexpr double largest_gate = 5e-4;  // 29 MPa of amplitude in copper, half of what annealed copper endures

constexpr double least_speed = 0.5 * degree;  // [rad/s] of the fastest axis: robots of plants reach 100 deg/s

constexpr double standard_gravity = 9.80665;
constexpr double gravity_spread = 0.01;    // of it: it varies by 0.5 % over the earth
constexpr double down = 0.999;             // cosine of 2.6 deg, more than floors slope
constexpr double least_robot_life = 1000;  // [h]: half a year of one shift
constexpr double least_week = 5;           // [h]: an hour per working day
constexpr double largest_endurance = 5e-3;  // of polymers 9e-3 at ten million cycles, of metals a fifth of this
constexpr double largest_factor = 30;      // 100 is per cent; trials take 0.1 to 10
constexpr double largest_tolerance = 0.05;  // [m] between the starts of two repeats: a hose's width
constexpr double longest_spot = 10;        // [s]: a weld takes 0.3 to 2
constexpr double widest_zone = 30 * degree;

/// Steps with one fault: the first, and how many more.
struct Doubted {
  const MotionStep* first = nullptr;
  int more = 0;
  void add(const MotionStep& step) {
    if (first)
      ++more;
    else
      first = &step;
  }
  Warning warning(const std::string& what, const std::string& cause, const std::string& remedy) const {
    return warning_of(WarningKind::motion, first->where.text(), what + (more ? fmt::format(" (and {} more)", more) : ""),
                      cause, remedy);
  }
};

struct Seen {
  const MotionStep* first = nullptr;
  std::vector<double> low, high;  ///< (axis) of all joint targets
  Doubted slow, fast, waits;
  std::vector<double> last;  ///< (axis) of the latest joint target
  double fastest = 0;        ///< of any axis, where moves have durations [rad/s]
  int moves = 0;
  bool all_joints = true;
  bool only_timed = true;    ///< all moves by joints, and all but the first with durations
};

void look_at(const std::vector<MotionStep>& steps, Seen& seen) {
  for (const MotionStep& step : steps) {
    look_at(step.steps, seen);
    if (step.speed_percent && *step.speed_percent < least_percent) seen.slow.add(step);
    if (step.tool_speed.value_or(0) > fastest_tool) seen.fast.add(step);
    if (step.dwell > longest_dwell) seen.waits.add(step);
    seen.moves += step.is_move();
    if (step.is_move() && step.joints.empty()) seen.all_joints = false;
    if (step.is_move() && (step.joints.empty() || (seen.first && !step.duration))) seen.only_timed = false;
    if (step.joints.empty()) continue;
    for (std::size_t k = 0; step.duration && k < std::min(seen.last.size(), step.joints.size()); ++k)
      seen.fastest = std::max(seen.fastest, std::abs(step.joints[k] - seen.last[k]) / *step.duration);
    seen.last = step.joints;
    if (!seen.first) seen.first = &step, seen.low = step.joints, seen.high = step.joints;
    for (std::size_t k = 0; k < std::min(seen.low.size(), step.joints.size()); ++k) {
      seen.low[k] = std::min(seen.low[k], step.joints[k]);
      seen.high[k] = std::max(seen.high[k], step.joints[k]);
    }
  }
}

}  // namespace

std::vector<Warning> plausibility_of_steps(const Motion& motion) {
  Seen seen;
  look_at(motion.steps, seen);
  std::vector<Warning> warnings;
  if (const MotionStep* step = seen.slow.first)
    warnings.push_back(seen.slow.warning(
        fmt::format("speed_percent is {:g} (limit {:g} or more)", *step->speed_percent, least_percent),
        "a share instead of a percentage", fmt::format("speed_percent: {:g} if that was a share", 100 * *step->speed_percent)));
  if (const MotionStep* step = seen.fast.first)
    warnings.push_back(seen.fast.warning(
        fmt::format("the tool's speed is {:g} m/s (limit {:g} or less)", *step->tool_speed, fastest_tool),
        "a speed in another unit, such as mm/s instead of m/s", "the speed in the program's unit"));
  if (const MotionStep* step = seen.waits.first)
    warnings.push_back(seen.waits.warning(fmt::format("dwell_s is {:g} (limit {:g} or less)", step->dwell, longest_dwell),
                                          "milliseconds instead of seconds",
                                          fmt::format("dwell_s: {:g} if that was milliseconds", step->dwell / 1000)));
  if (!seen.first) return warnings;
  double largest = 0, way = 0;  // [deg]
  for (std::size_t k = 0; k < seen.low.size(); ++k) {
    largest = std::max({largest, std::abs(seen.low[k]) / degree, std::abs(seen.high[k]) / degree});
    way = std::max(way, (seen.high[k] - seen.low[k]) / degree);
  }
  if (seen.moves > 1 && seen.all_joints && way <= moves)
    warnings.push_back(warning_of(WarningKind::motion, seen.first->where.text(),
                                  fmt::format("no axis moves by more than {:.2g} deg (limit {:.2g} or more)", way, moves),
                                  "targets that are copies of one, or turns instead of degrees",
                                  "joints_deg: the angles of each target"));
  if (largest <= most_radians && way > moves)
    warnings.push_back(warning_of(
        WarningKind::motion, seen.first->where.text(),
        fmt::format("no joint angle of the motion is larger than {:.3g} deg (limit {:.3g} or more)", largest, most_radians),
        "radians instead of degrees", "joints_deg in degrees; leave it if the robot moves so little"));
  if (seen.only_timed && way > moves && seen.fastest < least_speed)
    warnings.push_back(warning_of(
        WarningKind::motion, seen.first->where.text(),
        fmt::format("no axis is faster than {:.2g} deg/s (limit {:.2g} or more)", seen.fastest / degree, least_speed / degree),
        "milliseconds instead of seconds", "times in seconds"));
  return warnings;
}

namespace {

std::vector<Warning> plausibility_of_settings(const Job& job) {
  std::vector<Warning> warnings;
  const auto add = [&](WarningKind kind, const char* key, double value, const std::string& limit, const std::string& cause,
                       const std::string& remedy) {
    warnings.push_back(warning_of(kind, "", fmt::format("{} is {:.6g} (limit {})", key, value, limit), cause, remedy));
  };
  const Fatigue& fatigue = job.fatigue;
  if (fatigue.failed_wires_percent > 0 && fatigue.failed_wires_percent < 1)
    add(WarningKind::material, "fatigue.failed_wires_percent", fatigue.failed_wires_percent, "0, or 1 or more",
        "a share instead of per cent", fmt::format("fatigue.failed_wires_percent: {:g}", 100 * fatigue.failed_wires_percent));
  if (fatigue.robot_life_hours < least_robot_life)
    add(WarningKind::material, "fatigue.robot_life_hours", fatigue.robot_life_hours, fmt::format("{:g} or more", least_robot_life),
        "years instead of hours", "fatigue.robot_life_hours: 40000, or leave the key out");
  if (fatigue.operating_hours_per_week < least_week)
    add(WarningKind::material, "fatigue.operating_hours_per_week", fatigue.operating_hours_per_week,
        fmt::format("{:g} or more", least_week), "a share of the week, or another unit",
        "fatigue.operating_hours_per_week: 80, or the hours of motion in a week");
  if (fatigue.endurance_strain > largest_endurance)
    add(WarningKind::material, "fatigue.endurance_strain", fatigue.endurance_strain, fmt::format("{:g} or less", largest_endurance),
        "per cent instead of a share", fmt::format("fatigue.endurance_strain: {:g} if that was per cent", fatigue.endurance_strain / 100));
  const std::pair<const char*, double> factors[] = {{"fatigue.strength_factor", fatigue.strength_factor},
                                                    {"fatigue.model_factor", fatigue.model_factor},
                                                    {"fatigue.motion_factor", fatigue.motion_factor},
                                                    {"strain.friction_factor", job.strain.factors.friction},
                                                    {"strain.hose_friction_factor", job.strain.factors.hose_friction},
                                                    {"strain.slack_factor", job.strain.factors.slack},
                                                    {"strain.play_factor", job.strain.factors.play},
                                                    {"strain.grip_factor", job.strain.factors.grip}};
  for (const auto& [key, value] : factors)
    if ((!job.calibration || job.calibration->typical) && (value > largest_factor || value < 1 / largest_factor))
      add(WarningKind::material, key, value, fmt::format("{:.2g} .. {:g}", 1 / largest_factor, largest_factor),
          "per cent instead of a factor, or a factor for a trial",
          value > 1 ? fmt::format("{}: {:g} if that was per cent", key, value / 100) : fmt::format("{}: 1", key));
  if (job.motion.is_prescribed()) return warnings;
  if (job.simulation.periodic_tolerance > largest_tolerance)
    add(WarningKind::periodic, "simulation.periodic_tolerance_mm", 1e3 * job.simulation.periodic_tolerance,
        fmt::format("{:g} or less", 1e3 * largest_tolerance), "another unit: every motion counts as periodic",
        "simulation.periodic_tolerance_mm: 1");
  if (job.motion.spot_time > longest_spot)
    add(WarningKind::motion, "motion.spot_time_s", job.motion.spot_time, fmt::format("{:g} or less", longest_spot),
        "milliseconds instead of seconds", fmt::format("motion.spot_time_s: {:g} if that was milliseconds", job.motion.spot_time / 1000));
  if (job.motion.zone > widest_zone)
    add(WarningKind::motion, "motion.zone_deg", job.motion.zone / degree, fmt::format("{:g} or less", widest_zone / degree),
        "another unit, such as mm or per cent", "motion.zone_deg: 0, or the zone that the controller uses");
  const Eigen::Vector3d gravity = job.simulation.gravity;
  if (const double size = gravity.norm(); size > 0) {
    if (std::abs(size / standard_gravity - 1) > gravity_spread)
      add(WarningKind::motion, "the size of simulation.gravity_m_per_s2", size, "9.71 .. 9.90",
          size < 2 ? "multiples of g instead of m/s2" : "another unit", "simulation.gravity_m_per_s2: [0, 0, -9.81]");
    if (gravity.z() > -down * size)
      add(WarningKind::motion, "the upward part of simulation.gravity_m_per_s2", gravity.z(),
          fmt::format("{:.4g}: downward", -down * size), "a wrong sign or axis",
          "simulation.gravity_m_per_s2: [0, 0, -9.81]; leave it if the robot hangs on a wall or a ceiling");
  }
  return warnings;
}

}  // namespace

std::vector<Warning> plausibility_warnings(const Job& job) {
  const Motion& motion = job.motion;
  std::vector<Warning> warnings = plausibility_of_settings(job);
  if (!motion.is_prescribed() && job.simulation.sample_rate < least_rate)
    warnings.push_back(warning_of(WarningKind::mesh, "",
                                  fmt::format("simulation.sample_rate_Hz is {:g} (limit {:g} or more)",
                                              job.simulation.sample_rate, least_rate),
                                  "seconds instead of 1/s; the samples miss the hose's swing",
                                  "simulation.sample_rate_Hz: 25"));
  if (job.strain.gate > largest_gate)
    warnings.push_back(
        warning_of(WarningKind::strain, "",
                   fmt::format("strain.gate is {:g} (limit {:g} or less): cycles below it are left out",
                               job.strain.gate, largest_gate),
                   "per cent instead of a share",
                   fmt::format("strain.gate: {:g} if that was per cent, or no key", job.strain.gate / 100)));
  return motion.program.empty() ? joined(std::move(warnings), plausibility_of_steps(motion)) : warnings;
}

}  // namespace dresslife::pipeline
