#include "sim/run/unusual_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "pipeline/base/warning_words.h"

namespace dresslife::sim {
namespace {

using pipeline::MotionStep;

// vmax of the fastest shipped controllers is 5 to 7 m/s; m/s in the place of mm/s is far beyond.
constexpr double fastest_tool = 10;  // [m/s]
// A crawl in a joint move; a share in the place of percent, such as 0.8 for 80 %, is below.
constexpr double slowest_percent = 1;
// Processes of robots that carry a dresspack take seconds; milliseconds in the place of seconds are beyond.
constexpr double longest_wait = 300;  // [s]
constexpr double degree = std::numbers::pi / 180;

void visit(const std::vector<MotionStep>& steps, const std::function<void(const MotionStep&)>& see) {
  for (const MotionStep& step : steps) see(step), visit(step.steps, see);
}

/// The steps of one kind: the first counts, the others are counted.
struct Found {
  const MotionStep* first = nullptr;
  int more = 0;
  void add(const MotionStep& step) { first ? ++more : (first = &step, 0); }
  pipeline::Warning warning(const std::string& what, const std::string& cause, const std::string& remedy) const {
    return pipeline::warning_of(pipeline::WarningKind::motion, first->where.text(),
                                fmt::format("{}{}{}", first->text.empty() ? "" : fmt::format("'{}': ", first->text), what,
                                            more ? fmt::format(" (and {} more)", more) : ""),
                                cause, remedy);
  }
};

/// Whether all angles of all joint targets are numbers of radians: none beyond a turn, and some with a fraction.
bool looks_like_radians(const pipeline::Motion& motion) {
  std::size_t targets = 0;
  bool fraction = false, small = true;
  visit(motion.steps, [&](const MotionStep& step) {
    if (step.joints.empty()) return;
    ++targets;
    for (const double angle : step.joints) {
      const double written = angle / degree;
      small &= std::abs(written) <= 2 * std::numbers::pi;
      fraction |= std::abs(written - std::round(written)) > 1e-6;
    }
  });
  return targets >= 2 && fraction && small;
}

}  // namespace

std::vector<pipeline::Warning> unusual_motion(const pipeline::Motion& motion) {
  Found fast, slow, waits;
  visit(motion.steps, [&](const MotionStep& step) {
    if (step.tool_speed.value_or(0) > fastest_tool) fast.add(step);
    if (step.speed_percent && *step.speed_percent < slowest_percent) slow.add(step);
    if (step.dwell > longest_wait) waits.add(step);
  });
  std::vector<pipeline::Warning> warnings;
  if (fast.first)
    warnings.push_back(fast.warning(fmt::format("a tool speed of {:.4g} m/s (limit {:.0f} m/s)", *fast.first->tool_speed, fastest_tool),
                                    "a speed in another unit, such as mm/s in the place of m/s",
                                    "correct the speed; the axes' limits decide the motion here"));
  if (slow.first)
    warnings.push_back(slow.warning(
        fmt::format("a speed of {:.4g} % of the axes' highest (limit {:.0f} %)", *slow.first->speed_percent, slowest_percent),
        "a share, such as 0.8, in the place of percent", "correct the speed in the program"));
  if (waits.first)
    warnings.push_back(waits.warning(fmt::format("a wait of {:.4g} s (limit {:.0f} s)", waits.first->dwell, longest_wait),
                                     "a time in another unit, such as milliseconds",
                                     "correct the wait; if it is right, hours of this motion are mostly hours of standstill"));
  if (looks_like_radians(motion))
    warnings.push_back(pipeline::warning_of(pipeline::WarningKind::motion, "",
                                            "all joint targets lie within 6.28 deg of zero",
                                            "angles in radians in the place of degrees", "write the targets in degrees"));
  return warnings;
}

}  // namespace dresslife::sim
