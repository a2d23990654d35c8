// The limits of a short run for a search, against the full run; and proposed routings that keep their limits in it.
#include "sim/route/short_run.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "pipeline/advise/improve/scaled.h"
#include "pipeline/base/statistics.h"
#include "pipeline/resolve/job_text.h"
#include "sim/route/exercise.h"
#include "sim/route/proposal.h"
#include "sim/run/cures.h"
#include "sim/run/quick_checks.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

constexpr int as_the_job = 1'000'000;

double beyond(const RoutingRun& short_run, ScreenedLimit limit) {
  return short_run.seen.beyond[static_cast<std::size_t>(limit)];
}

std::vector<Check> checks_of(const pipeline::Setup& setup) {
  return Simulation(setup).run({[](const Sample&) {}}).checks;
}

}  // namespace

TEST_CASE("a short run grades what the run's checks saw") {
  pipeline::Job job = simple_job();
  const RoutingRun found = short_run_of(job, as_the_job, as_the_job);
  REQUIRE(found.refusal.empty());
  const std::vector<Check> checks = checks_of(job);
  const auto check = [&](const char* name) {
    return *std::find_if(checks.begin(), checks.end(), [&](const Check& of) { return of.name == name; });
  };
  CHECK(std::exp(beyond(found, ScreenedLimit::bend)) * check("smallest bend radius").value == Approx(10 * 0.04));
  // 2 rad in 1 m. The hose sags, so the twists of its links differ a little.
  constexpr double of_its_sag = 0.1;
  CHECK(beyond(found, ScreenedLimit::twist) == Approx(2 / std::numbers::pi - 1).margin(of_its_sag));
  CHECK(beyond(found, ScreenedLimit::too_short) == Approx(0.9 - 0.98).margin(1e-9));  // (V1), (V2)
  CHECK(beyond(found, ScreenedLimit::too_long) == Approx(2.0 / 3 - 0.9).margin(1e-9));
  job.dresspacks.front().dresspack.mass_per_length = 15;  // a heavy hose hangs like a chain
  job.dresspacks.front().dresspack.most_tension = 1;
  CHECK(beyond(short_run_of(job, as_the_job, 1), ScreenedLimit::tension) > 1);
  job.dresspacks.front().routing.free_length = 0.85;
  CHECK(short_run_of(job, as_the_job, 1).refusal.find("too short") != std::string::npos);
}

TEST_CASE("bends of a short run are reported by moment and stretch, and their largest is the run's sharpest") {
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  const RoutingRun found = short_run_of(job, as_the_job, 1);
  REQUIRE(found.refusal.empty());
  REQUIRE(found.bends.size() == bend_moments * bend_stretches);
  // The samples and the ends of links are compared one by one.
  const Simulation simulation(job);
  const Rod& rod = simulation.rod();
  std::vector<double> sharpest(found.bends.size(), 0.0);
  const double length = job.dresspacks.front().routing.free_length;
  simulation.run({[&](const Sample& sample) {
    int moment = 0, stretch = 0;
    while (moment + 1 < bend_moments && (moment + 1) * simulation.path().duration() <= bend_moments * sample.time)
      ++moment;
    for (int j = 0; j < rod.links(); ++j) {
      while (stretch + 1 < bend_stretches && (stretch + 1) * length <= bend_stretches * rod.link_arc(j)) ++stretch;
      const Vector3 turn = rod.link_state(sample.state, j).turn;
      double& of = sharpest[moment * bend_stretches + stretch];
      of = std::max(of, std::hypot(turn.x(), turn.y()) / rod.bending_length(j));
    }
    stretch = 0;
  }});
  constexpr double least_radius = 10 * 0.04;
  for (std::size_t k = 0; k < sharpest.size(); ++k)
    CHECK(std::exp(found.bends[k]) == Approx(sharpest[k] * least_radius).epsilon(1e-9));
  const double largest = *std::max_element(found.bends.begin(), found.bends.end());
  CHECK(largest <= beyond(found, ScreenedLimit::bend) + 1e-12);
  constexpr double between_samples = 0.01;  // of motions that last seconds, sampled every 40 ms
  CHECK(largest > beyond(found, ScreenedLimit::bend) - between_samples);
}

TEST_CASE("a short run measures the rubbing of a hose on a table as a full run does, and check names table and place") {
  pipeline::Job job = simple_job();  // the clamp turns by 2 rad, so the hose rolls on the table
  job.cell.boxes = {{{0.45, 0, 0.85}, {0, 0, 0}, {0.4, 0.4, 0.1}}};
  const RunSummary full = Simulation(job).run({[](const Sample&) {}});
  double work = 0;  // (S23) of one repeat
  for (const RubbedPatch& patch : full.rubbed) work += patch.work;
  REQUIRE(work > 0);
  const double duration = path_of(job)->duration();
  CHECK(full.rubbing_power() == Approx(work / duration).epsilon(0.02));  // the last sample may end after the motion
  for (const bool with_bends : {true, false})                            // with all results, and with checks alone
    CHECK(short_run_of(job, as_the_job, as_the_job, with_bends).rubbing == Approx(full.rubbing_power()).epsilon(1e-9));
  const auto notes = [&] {
    std::string text;
    for (const std::string& note : quick_warnings(job).notes) text += note + "\n";
    return text;
  };
  CHECK_THAT(notes(), Catch::Contains("rubs on the cell with ") && Catch::Contains(" mm from the base clamp, ") &&
                          Catch::Contains("predicts the hours"));
  job.simulation.self_contact = false;  // then a run leaves abrasion out
  CHECK_THAT(notes(), Catch::Contains("self_contact=false `dresslife run` does not evaluate this wear") &&
                          !Catch::Contains("predicts the hours"));
  job.cell.boxes.front().position.z() = 0.5;
  CHECK_THAT(notes(), !Catch::Contains("rubs on"));
  CHECK(short_run_of(job, as_the_job, 1).rubbing == 0);
}

TEST_CASE("proposals with a short run keep all limits in the job's own run") {
  pipeline::Job job =
      pipeline::read_job(std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_spot_welding.yaml",
                         {"robot=abb_irb2600_12_165", "dresspack=thesis_welding", "simulation.segments=20"});
  job.motion = exercise(job.robot);
  job.dresspacks.front().dresspack = pipeline::scaled(job.dresspacks.front().dresspack, 0.3);
  ProposalSettings settings;
  settings.tried = 120;
  settings.short_runs = 60;
  const Proposal found = propose(job, settings).front();
  REQUIRE(found.short_run.refusal.empty());
  CHECK(pipeline::sum_above_zero(found.short_run.seen.beyond) == 0);
  job.dresspacks.front().routing = found.routing;
  for (const Check& check : checks_of(job)) {
    INFO(check.name << " " << check.value << " of " << check.limit);
    CHECK_FALSE(check.warning);
  }

  // A worse routing between the same links: a small change of it keeps the limits again.
  const auto warns = [](const pipeline::Setup& setup) {
    const QuickFindings quick = quick_findings(setup);
    return !quick.run.refusal.empty() ||
           std::any_of(quick.checks.begin(), quick.checks.end(), [](const Check& check) { return check.warning; });
  };
  CHECK_FALSE(warns(job));
  pipeline::Routing& routing = job.dresspacks.front().routing;
  const Vector3 along = routing.base_clamp->direction.normalized();
  routing.tool_clamp->bend_relief = pipeline::BendRelief{0.05, 1};
  for (const double turn : {1.0, 1.5, 2.0, 2.5}) {  // [rad] until the hose bends too much
    routing.base_clamp->direction = std::cos(turn) * along + std::sin(turn) * along.unitOrthogonal();
    if (warns(job)) break;
  }
  REQUIRE(warns(job));
  const pipeline::Routing spoiled = routing;
  const std::optional<pipeline::Routing> near = routing_near(job);
  REQUIRE(near);
  routing = *near;
  CHECK_FALSE(warns(job));
  CHECK(near->base_clamp->link == spoiled.base_clamp->link);
  CHECK(near->tool_clamp->link == spoiled.tool_clamp->link);
  CHECK(near->tool_clamp->bend_relief);  // what a routing has besides places, directions and length is kept
  const double far = std::max((near->base_clamp->position - spoiled.base_clamp->position).norm(),
                              (near->tool_clamp->position - spoiled.tool_clamp->position).norm());
  CHECK(far <= same_place + 1e-9);
  job.dresspacks.front().dresspack.least_bend_radius = 3;  // no link is so long
  CHECK_FALSE(routing_near(job));
}

}  // namespace dresslife::sim
