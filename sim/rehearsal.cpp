#include "sim/rehearsal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/errors.h"
#include "pipeline/files/check_names.h"
#include "sim/simulate.h"

namespace dresslife::sim {
namespace {

namespace check_name = pipeline::check_name;

void see(Screening& seen, ScreenedLimit limit, double g, double time) {
  const auto k = static_cast<std::size_t>(limit);
  if (g > seen.beyond[k]) seen.beyond[k] = g, seen.time[k] = time;
}

void see(Screening& seen, const Check& check) {
  if (check.name == check_name::bend_radius)
    see(seen, ScreenedLimit::bend, std::log(check.limit / check.value), check.time);
  if (check.name == check_name::twist)
    see(seen, ScreenedLimit::twist, std::abs(check.value) / check.limit - 1, check.time);
  // Limits of slack are shares of the length.
  if (check.name == check_name::too_short)
    see(seen, ScreenedLimit::too_short, least_slack_share * (1 - check.value / check.limit), check.time);
  if (check.name == check_name::too_long)
    see(seen, ScreenedLimit::too_long, most_slack_share * (check.value / check.limit - 1), check.time);
  if (check.name == check_name::tension && check.value > 0)
    see(seen, ScreenedLimit::tension, std::log(check.value / check.limit), check.time);
}

}  // namespace

Rehearsal rehearsed(pipeline::Setup setup, int segments, int repeats) {
  Rehearsal rehearsal;
  rehearsal.seen.beyond.fill(-std::numeric_limits<double>::infinity());
  rehearsal.seen.time.fill(0);
  setup.simulation.segments = std::min(setup.simulation.segments, segments);
  setup.simulation.most_repeats = std::min(setup.simulation.most_repeats, repeats);
  try {
    const RunSummary summary = Simulation(setup).run({[](const Sample&) {}});
    for (const Check& check : summary.checks) see(rehearsal.seen, check);
  } catch (const pipeline::InputError& problem) {
    rehearsal.refusal = problem.what();
  }
  return rehearsal;
}

}  // namespace dresslife::sim
