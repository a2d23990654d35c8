// What a search is told of a short run, against the run itself; and routings that keep their limits in it.
#include "sim/rehearsal.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "pipeline/improve/scaled.h"
#include "sim/exercise.h"
#include "sim/proposal.h"
#include "sim/simulate.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

constexpr int as_the_job = 1'000'000;

double beyond(const Rehearsal& rehearsal, ScreenedLimit limit) {
  return rehearsal.seen.beyond[static_cast<std::size_t>(limit)];
}

std::vector<Check> checks_of(const pipeline::Setup& setup) {
  return Simulation(setup).run({[](const Sample&) {}}).checks;
}

}  // namespace

TEST_CASE("a rehearsal grades what the run's checks saw") {
  pipeline::Job job = simple_job();
  const Rehearsal found = rehearsed(job, as_the_job, as_the_job);
  REQUIRE(found.refusal.empty());
  const std::vector<Check> checks = checks_of(job);
  const auto check = [&](const char* name) {
    return *std::find_if(checks.begin(), checks.end(), [&](const Check& of) { return of.name == name; });
  };
  CHECK(std::exp(beyond(found, ScreenedLimit::bend)) * check("smallest bend radius").value ==
        Approx(10 * 0.04));
  // 2 rad in 1 m; the hose sags, so that links take shares of it that differ a little.
  constexpr double of_its_sag = 0.1;
  CHECK(beyond(found, ScreenedLimit::twist) == Approx(2 / std::numbers::pi - 1).margin(of_its_sag));
  CHECK(beyond(found, ScreenedLimit::too_short) == Approx(0.9 - 0.98).margin(1e-9));  // (V1), (V2)
  CHECK(beyond(found, ScreenedLimit::too_long) == Approx(2.0 / 3 - 0.9).margin(1e-9));
  job.dresspacks.front().dresspack.mass_per_length = 15;  // a heavy one hangs like a chain
  job.dresspacks.front().dresspack.most_tension = 1;
  CHECK(beyond(rehearsed(job, as_the_job, 1), ScreenedLimit::tension) > 1);
  job.dresspacks.front().routing.free_length = 0.85;
  CHECK(rehearsed(job, as_the_job, 1).refusal.find("too short") != std::string::npos);
}

TEST_CASE("proposals that were rehearsed keep all limits in the job's own run") {
  pipeline::Job job = pipeline::read_job(
      std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_spot_welding.yaml",
      {"robot=abb_irb2600_12_165", "simulation.segments=20"});
  job.motion = exercise(job.robot);
  job.dresspacks.front().dresspack = pipeline::scaled(job.dresspacks.front().dresspack, 0.3);
  ProposalSettings settings;
  settings.tried = 120;
  settings.rehearsals = 60;
  const Proposal found = propose(job, settings).front();
  REQUIRE(found.rehearsal.refusal.empty());
  CHECK(found.rehearsal.seen.violation() == 0);
  job.dresspacks.front().routing = found.routing;
  for (const Check& check : checks_of(job)) {
    INFO(check.name << " " << check.value << " of " << check.limit);
    CHECK_FALSE(check.warning);
  }
}

}  // namespace dresslife::sim
