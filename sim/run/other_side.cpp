#include "sim/run/other_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "pipeline/base/warning_words.h"
#include "pipeline/job/line_key.h"
#include "pipeline/job/setup.h"
#include "sim/run/routing.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {
namespace {

using pipeline::Side;

/// Returns the largest distance of a dresspack's segments in two states [m].
double distance(const Rod& rod, int dresspack, const RodState& a, const RodState& b) {
  double most = 0;
  for (int i = 0; i < rod.segments(); ++i)
    if (rod.span_of(i).dresspack == dresspack)
      most = std::max(most, (a.position[static_cast<std::size_t>(i)] - b.position[static_cast<std::size_t>(i)]).norm());
  return most;
}

/// Returns the state at the end of the last repeat; nothing: it was not reached.
std::optional<RodState> end_of(const Simulation& simulation, double most_work) {
  std::optional<RodState> end;
  double work = 0;
  RunSinks sinks{[&](const Sample& sample) { end = sample.state; }};
  sinks.wanted = Wanted::checks;
  sinks.goes_on = [&](double of_step, bool) { return (work += of_step) <= most_work; };
  if (simulation.run(sinks).stopped_at) end.reset();
  return end;
}

/// The way of a dresspack that was mounted on one side. absent: it cannot be mounted or moved so.
struct Mounted {
  Side side;
  bool as_own = false;  ///< mounted in the shape of the job's own run
  std::optional<double>
      apart{};  ///< from the job's own run at the end [m]; absent: as_own, or the run was not finished
};

std::optional<Mounted> mounted(pipeline::Setup setup, int dresspack, Side side, const Ends& own, double most_work) {
  setup.dresspacks[static_cast<std::size_t>(dresspack)].routing.side = side;
  try {
    const Simulation simulation(setup);
    const Rod& rod = simulation.rod();
    const double same = rod.spans()[static_cast<std::size_t>(rod.first_span(dresspack))].properties.diameter / 2;
    if (distance(rod, dresspack, simulation.start(), own.begin) < same) return Mounted{side, true};
    const std::optional<RodState> end = end_of(simulation, most_work);
    if (!end) return Mounted{side};
    const double apart = distance(rod, dresspack, *end, own.end);
    return Mounted{side, false, apart < same ? 0 : apart};
  } catch (const pipeline::InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<pipeline::Warning> other_side_warnings(const pipeline::Setup& job, double time_step, const Ends& own,
                                                   double most_work) {
  pipeline::Setup setup = job;
  setup.simulation.choose_time_step = false;
  setup.simulation.time_step = time_step;
  std::vector<pipeline::Warning> warnings;
  for (int d = 0; d < static_cast<int>(setup.dresspacks.size()); ++d) {
    const pipeline::Routing& routing = setup.dresspacks[static_cast<std::size_t>(d)].routing;
    if (routing.side != Side::either || !routing.base_clamp || !routing.tool_clamp) continue;
    const std::optional<Mounted> left = mounted(setup, d, Side::left, own, most_work);
    const std::optional<Mounted> right = mounted(setup, d, Side::right, own, most_work);
    double apart = 0;
    for (const std::optional<Mounted>& of : {left, right})
      if (of && of->apart) apart = std::max(apart, *of->apart);
    if (apart == 0) continue;
    const bool on_left = left && left->as_own, on_right = right && right->as_own;
    const std::string name = pipeline::dresspack_words(setup, static_cast<std::size_t>(d)),
                      key = pipeline::line_key(setup, static_cast<std::size_t>(d), "routing.side");
    pipeline::Remedy remedy;
    if (on_left || on_right) remedy.values = {{key, std::string(pipeline::word(on_left ? Side::left : Side::right))}};
    remedy.words = fmt::format(
        "{}the side on which it is mounted. Compare both ({}: [left, right] under `vary` of a study): their lives can differ by "
        "a factor of 100",
        remedy.values.empty() ? "routing.side: " : ", or ", key);
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::side, "",
        fmt::format(
            "{} can be mounted in two shapes, and moves differently in each: at the end of a repeat they are {:.0f} mm "
            "apart. This run has the one {}",
            name, 1e3 * apart,
            on_left    ? "on the left, seen from the base clamp to the tool clamp"
            : on_right ? "on the right, seen from the base clamp to the tool clamp"
                       : "between left and right"),
        "the clamps lie in one plane with the arm, so that the hose rests on both sides", remedy));
  }
  return warnings;
}

}  // namespace dresslife::sim
