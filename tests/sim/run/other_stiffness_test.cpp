#include "sim/run/other_stiffness.h"

#include <cmath>

#include "pipeline/job/beyond_limit.h"
#include "sim/run/motion_file.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

using pipeline::Uncertain;

struct Written {
  std::vector<pipeline::Warning> warnings;
  std::vector<double> softer, stiffer, factors;  // as /segment/position; only the existing datasets are filled
  double taut = 0;                               // softer_taut_z or stiffer_taut_z; 0: none
};

Written written(const pipeline::Job& job) {
  const pipeline::Scratch scratch;
  const auto name = scratch / "motion.h5";
  Written result;
  {
    pipeline::FileWriter file(name, pipeline::motion_format());
    const Simulation simulation(job);
    MotionFile motion(file, simulation.description());
    const RunSummary summary = simulation.run({[&](const Sample& sample) { motion.add(sample); }});
    motion.finish(summary, [&](double time) { return simulation.path().step(time); });
    result.warnings = write_other_stiffnesses(job, summary, file);
    for (const char* attribute : {"job", "history", "input_sha256"}) file.attribute(attribute, "");
    file.commit();
  }
  const pipeline::FileReader file(name, pipeline::motion_format());
  const auto& stiffness = pipeline::uncertain_parameters()[index_of(Uncertain::hose_stiffness)];
  for (auto& [group, values] : {std::pair("softer", &result.softer), std::pair("stiffer", &result.stiffer)}) {
    const std::string path = std::string("/") + group + "/segment/position";
    if (const std::string taut = std::string(group) + "_taut_z"; file.has_attribute(taut))
      result.taut += file.number_attribute(taut);
    if (!file.has(path)) continue;
    *values = file.read<double>(path);
    result.factors.push_back(stiffness.value(file.number_attribute(std::string(group) + "_z")));
  }
  return result;
}

/// Returns the positions of a separate run, as dresslife-sim writes them for a job with this factor.
std::vector<double> positions_with(pipeline::Job job, double factor) {
  job.simulation.stiffness_factor = factor;
  std::vector<double> positions;
  const Simulation simulation(job);
  simulation.run({[&](const Sample& sample) {
    for (const Vector3& x : sample.state.position) positions.insert(positions.end(), x.begin(), x.end());
  }});
  return positions;
}

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  REQUIRE(one.size() == other.size());
  double largest = 0;
  for (std::size_t k = 0; k < one.size(); ++k) largest = std::max(largest, std::abs(one[k] - other[k]));
  return largest;
}

pipeline::Job sagging() {
  pipeline::Job job = simple_job();
  job.dresspacks[0].routing.tool_clamp->position = {0.85, 0, 0.1};  // makes the hose swing as well
  job.simulation.most_repeats = 1;
  return job;
}

}  // namespace

TEST_CASE("other stiffnesses: the places are those of jobs whose hose is softer and stiffer") {
  const pipeline::Job job = sagging();
  const Written both = written(job);
  CHECK(both.warnings.empty());
  CHECK(both.taut == 0);
  REQUIRE(both.factors.size() == 2);
  constexpr double kept = 1e-12;  // decimals of the file [m]
  CHECK(largest_difference(both.softer, positions_with(job, both.factors[0])) < kept);
  CHECK(largest_difference(both.stiffer, positions_with(job, both.factors[1])) < kept);
  CHECK(largest_difference(both.softer, both.stiffer) > 1e-3);  // otherwise the test would prove nothing
  // A factor on the stiffness is equivalent to a changed stiffness.
  pipeline::Job stiff = job;
  stiff.dresspacks[0].dresspack.bending_stiffness *= both.factors[1];
  CHECK(largest_difference(both.stiffer, positions_with(stiff, 1)) < kept);
}

TEST_CASE(
    "other stiffnesses: a bend radius that only the softer hose breaks is a warning with its stiffness, value and share") {
  pipeline::Job job = sagging();
  const auto radius_with = [&](double factor) {
    pipeline::Job of = job;
    of.simulation.stiffness_factor = factor;
    return Simulation(of).run({[](const Sample&) {}}).checks.front().value;
  };
  const double own = radius_with(1), soft = radius_with(0.397), stiff = radius_with(2.518);
  REQUIRE(soft < 0.95 * own);
  double& limit = job.dresspacks[0].dresspack.least_bend_radius.emplace((soft + own) / 2);
  const Written between = written(job);
  REQUIRE(between.warnings.size() == 1);
  CHECK(between.warnings[0].kind == pipeline::WarningKind::other_values);
  const double share = pipeline::share_beyond({{-1.65, limit / soft}, {0, limit / own}, {1.65, limit / stiff}}, 0, 1);
  CHECK_THAT(
      between.warnings[0].words,
      Catch::Contains("with 0.4 times the stiffness of the dresspack (simulation.stiffness_factor: 0.397)") &&
          Catch::Contains(fmt::format("smallest bend radius: {:.1f} mm (limit {:.1f} mm)", 1e3 * soft, 1e3 * limit)) &&
          Catch::Contains(
              fmt::format("about {} of such dresspacks exceed this limit", pipeline::percent_words(share))) &&
          Catch::Contains("from the base clamp") && Catch::Contains("Likely cause: ") && Catch::Contains("Remedy: ") &&
          Catch::Contains("uncertainty.hose_stiffness: 1.16"));
  CHECK(other_stiffness_warnings(job, short_run(job, short_run_segments)) ==
        between.warnings);  // check agrees with run
  limit = 1.05 * own;       // the job's own run breaks it and has its own warning
  CHECK(written(job).warnings.empty());
  limit = 0.95 * soft;
  CHECK(written(job).warnings.empty());
}

TEST_CASE(
    "other stiffnesses: a motion that is periodic only with the job's own stiffness causes one warning with the distances of the others") {
  pipeline::Job job = sagging();
  job.simulation.most_repeats = 2;
  const auto distance_with = [&](double factor) {
    pipeline::Job of = job;
    of.simulation.stiffness_factor = factor;
    return Simulation(of).run({[](const Sample&) {}}).distance;
  };
  const double own = distance_with(1), soft = distance_with(0.397), stiff = distance_with(2.518);
  CAPTURE(own, soft, stiff);
  for (const double tolerance : {own / 2, own * 1.01, 2 * std::max({own, soft, stiff})}) {
    job.simulation.periodic_tolerance = tolerance;
    std::size_t expected = 0;
    for (const double distance : {soft, stiff}) expected += own <= tolerance && distance > tolerance;
    const Written result = written(job);
    REQUIRE(result.warnings.size() == (expected > 0 ? 1 : 0));
    CHECK(other_stiffness_warnings(job, short_run(job, short_run_segments)) ==
          result.warnings);  // check agrees with run
    if (expected == 0) continue;
    CHECK_THAT(result.warnings[0].words, Catch::Contains("the motion begins its last repeat "));
    for (const double distance : {soft, stiff})
      CHECK((result.warnings[0].words.find(fmt::format("{:.1f} mm with ", 1e3 * distance)) != std::string::npos) ==
            (distance > tolerance));
  }
  CHECK(std::max(soft, stiff) > 1.01 * own);  // otherwise no warning was tested

  // In a third repeat, which begins with the swing of a full second one, they keep the limit.
  job.simulation.periodic_tolerance = own * 1.01;
  job.simulation.most_repeats = 3;
  CHECK(written(job).warnings.empty());
  CHECK(other_stiffness_warnings(job, short_run(job, short_run_segments)).empty());
}

TEST_CASE("other stiffnesses: none where the stiffness is known") {
  pipeline::Job job = sagging();
  job.uncertainty.spread[index_of(Uncertain::hose_stiffness)] = 1;
  CHECK(written(job).factors.empty());
  job = sagging();
  job.uncertainty.enabled = false;
  CHECK(written(job).factors.empty());
}

TEST_CASE(
    "other stiffnesses: a hose too stiff for its clamps is recorded at half the change, or not at all, with a warning") {
  pipeline::Job job = sagging();  // a hose 14 times as stiff pulls itself out of its clamps, which are not on one line
  double& spread = job.uncertainty.spread[index_of(Uncertain::hose_stiffness)];
  spread = 5;
  const Written half = written(job);
  REQUIRE(half.factors.size() == 2);
  CHECK(half.factors[1] == Approx(std::pow(5.0, 1.65 / 2)));
  REQUIRE(half.warnings.size() == 1);
  CHECK_THAT(
      half.warnings[0].words,
      !Catch::Contains("error:") && !Catch::Contains("dresslife preview") &&
          Catch::Contains("with 14 times the hose's bending stiffness the simulation is refused (") &&
          Catch::Contains("5 to 20 % of hoses are too stiff for this program") && Catch::Contains("is pulled tight") &&
          Catch::Contains(
              "With 14 times the stiffness or more a life counts as one repeat. Between 3.8 and 14 times it falls"));
  const double deviation = std::log(5) / std::log(1.75);
  CHECK(half.taut == Approx(1.65 * deviation));
  spread = 20;
  const Written none = written(job);
  CHECK(none.factors.size() == 1);
  REQUIRE(none.warnings.size() == 1);
  CHECK_THAT(none.warnings[0].words,
             Catch::Contains("More than 20 % of hoses are too stiff") &&
                 Catch::Contains("With 12 times the stiffness or more a life counts as one repeat"));
  CHECK(none.taut == Approx(1.65 / 2 * std::log(20) / std::log(1.75)));
}

}  // namespace dresslife::sim
