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
};

void look_at(const std::vector<MotionStep>& steps, Seen& seen) {
  for (const MotionStep& step : steps) {
    look_at(step.steps, seen);
    if (step.speed_percent && *step.speed_percent < least_percent) seen.slow.add(step);
    if (step.tool_speed.value_or(0) > fastest_tool) seen.fast.add(step);
    if (step.dwell > longest_dwell) seen.waits.add(step);
    if (step.joints.empty()) continue;
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
  if (largest <= most_radians && way > moves)
    warnings.push_back(warning_of(
        WarningKind::motion, seen.first->where.text(),
        fmt::format("no joint angle of the motion is larger than {:.3g} deg (limit {:.3g} or more)", largest, most_radians),
        "radians instead of degrees", "joints_deg in degrees; leave it if the robot moves so little"));
  return warnings;
}

std::vector<Warning> plausibility_warnings(const Job& job) {
  const Motion& motion = job.motion;
  std::vector<Warning> warnings;
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
