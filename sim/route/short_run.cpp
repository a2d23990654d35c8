#include "sim/route/short_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/errors.h"
#include "pipeline/files/check_names.h"
#include "sim/run/simulate.h"
#include "sim/run/step_choice.h"

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

/// Collects the bends of a short run: the largest curvatures of one repeat.
class Bends {
 public:
  explicit Bends(const Simulation& simulation) : rod_(simulation.rod()), duration_(simulation.path().duration()) {
    for (const pipeline::MountedDresspack& mounted : simulation.setup().dresspacks)
      least_radius_.push_back(limits_of(mounted.dresspack).least_bend_radius);
    begin();
  }

  void begin() {
    sharpest_.assign(least_radius_.size() * bend_moments * bend_stretches, 0.0);
    lowest_.assign(static_cast<std::size_t>(rod_.links()), Vector3::Constant(std::numeric_limits<double>::infinity()));
    highest_.assign(lowest_.size(), Vector3::Constant(-std::numeric_limits<double>::infinity()));
  }

  void see(const Sample& sample) {
    const int moment = duration_ > 0 ? part_of(sample.time / duration_, bend_moments) : 0;
    for (int j = 0; j < rod_.links(); ++j) {
      const Span& span = rod_.span_of_link(j);
      const int stretch = part_of(rod_.link_arc(j) / length_of(span.dresspack), bend_stretches);
      double& sharpest = sharpest_[(span.dresspack * bend_moments + moment) * bend_stretches + stretch];
      const Vector3 turn = rod_.link_state(sample.state, j).turn;
      sharpest = std::max(sharpest, rod_.curvature(turn, j));
      const Vector3 bend = turn / rod_.bending_length(j);
      const auto link = static_cast<std::size_t>(j);
      lowest_[link] = lowest_[link].cwiseMin(bend);
      highest_[link] = highest_[link].cwiseMax(bend);
    }
  }

  std::vector<double> beyond() const {
    constexpr double straight = 1e-6;  // [1/m], far from every limit, with a finite logarithm
    std::vector<double> g;
    for (std::size_t k = 0; k < sharpest_.size(); ++k)
      g.push_back(std::log(least_radius_[k / (bend_moments * bend_stretches)] * std::max(sharpest_[k], straight)));
    return g;
  }

  double swing() const {
    double most = 0;
    for (std::size_t j = 0; j < lowest_.size(); ++j) most = std::max(most, (highest_[j] - lowest_[j]).norm());
    return most;
  }

 private:
  static int part_of(double share, int parts) { return std::clamp(static_cast<int>(share * parts), 0, parts - 1); }
  double length_of(int dresspack) const {
    return rod_.link_arc(rod_.spans()[rod_.first_span(dresspack + 1) - 1].last_link());
  }

  const Rod& rod_;
  double duration_;
  std::vector<double> least_radius_, sharpest_;
  std::vector<Vector3> lowest_, highest_;  // (link) of both curvatures and the twist [1/m]
};

}  // namespace

RoutingRun short_run_of(pipeline::Setup setup, int segments, int repeats, bool with_bends, double useless_beyond) {
  RoutingRun short_run;
  short_run.seen.beyond.fill(-std::numeric_limits<double>::infinity());
  short_run.seen.time.fill(0);
  pipeline::SimulationSettings& settings = setup.simulation;
  if (settings.choose_time_step &&
      segments < settings.segments) {  // few segments have a larger error than the first step
    settings.choose_time_step = false;
    settings.time_step = first_step(settings.sample_rate);
  }
  settings.segments = std::min(settings.segments, segments);
  settings.most_repeats = std::min(settings.most_repeats, repeats);
  try {
    const Simulation simulation(setup);
    Bends bends(simulation);
    RunSinks sinks{[&](const Sample& sample) { bends.see(sample); }, [&](int) { bends.begin(); }};
    // A choice needs the error of the step. Bends need every moment, also those of rounds that the checks leave out.
    if (!settings.choose_time_step && !with_bends) sinks.wanted = Wanted::checks;
    sinks.goes_on = [&](double work, bool) {
      short_run.work += work;
      return true;
    };
    const double sharpest = std::exp(useless_beyond) / limits_of(setup.dresspacks.front().dresspack).least_bend_radius;
    sinks.still_of_use = [&](const MotionChecks& checks) {
      for (int j = 0; j < simulation.rod().links(); ++j)
        if (simulation.rod().span_of_link(j).dresspack == 0 && checks.curvature()[j].value > sharpest) return false;
      return true;
    };
    const RunSummary summary = simulation.run(sinks);
    if (with_bends) short_run.bends = bends.beyond();
    short_run.swing = bends.swing();
    short_run.rubbing = summary.rubbing_power();
    for (Check check : summary.checks) {
      check.time = simulation.path().program_time(check.time);
      see(short_run.seen, check);
    }
  } catch (const pipeline::InputError& problem) {
    short_run.refusal = problem.what();
  }
  return short_run;
}

}  // namespace dresslife::sim
