// The life of a hose's wall over its strength, for a life curve of one slope.
#include "fatigue/wall_life.h"

#include <cmath>
#include <numeric>

#include "pipeline/job/job.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"

namespace dresslife::fatigue {
namespace {

using pipeline::LifeResponse;

constexpr double slope = 5, cycles_at_1_percent = 1e6, amplitude = 0.004;

pipeline::Job job_with_wall() {
  pipeline::Job job;
  pipeline::Dresspack& hose = job.dresspacks[0].dresspack;
  hose.diameter = 0.05, hose.hose_strain_factor = 2, hose.least_bend_radius = 0.2;
  hose.hose_material = "polyamide";
  pipeline::Material& wall = hose.materials.emplace_back();
  wall.name = hose.hose_material, wall.youngs_modulus = 1.6e9;
  wall.strain_life_table = {{0.01, cycles_at_1_percent}, {0.001, cycles_at_1_percent * std::pow(10, slope)}};
  return job;
}

LifeResponse swinging(const pipeline::Job& job) {
  const std::vector<double> strain{0, amplitude, -amplitude, 0};
  return wall_response(find_reversals(strain), job, 0);
}

/// Returns the mean and the standard deviation.
std::pair<double, double> moments(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / double(values.size()))};
}

const double median = std::log10(cycles_at_1_percent) + slope * std::log10(0.01 / amplitude),
             per_deviation = slope * std::log10(pipeline::wall_strength_step);

}  // namespace

TEST_CASE("wall: lives over the samples have the closed form of a curve of one slope") {
  pipeline::Job job = job_with_wall();
  const auto lives = pipeline::first_failures({swinging(job)}, "");
  // 10,000 samples, each stratum once. Piecewise linear scatter between 10, 50 and 90 % is exact for a normal one, up to 3.5
  const auto [mean, deviation] = moments(lives);
  CHECK(mean == Approx(median).margin(1e-3));
  CHECK(deviation == Approx(std::hypot(per_deviation, job.fatigue.scatter_log10)).epsilon(0.01));
  job.robot.joints.resize(6);  // swings
  CHECK(moments(pipeline::first_failures({swinging(job)}, "")).second ==
        Approx(std::hypot(per_deviation, job.fatigue.scatter_log10,
                          std::log10(job.uncertainty.spread[index_of(pipeline::Uncertain::motion)])))
            .epsilon(0.01));
  job.robot.joints.clear(), job.uncertainty.enabled = false;
  CHECK(moments(pipeline::first_failures({swinging(job)}, "")).second ==
        Approx(job.fatigue.scatter_log10).epsilon(0.01));
}

TEST_CASE("wall: a calibration moves the hoses of its life curve, and no others") {
  pipeline::Job job = job_with_wall();
  const double before = wall_bends_at_limit(swinging(job), job, 0);
  // Between straight and a radius of 0.2 m: range 2 x 0.025/0.2
  CHECK(before == Approx(cycles_at_1_percent * std::pow(0.125 / 0.01, -slope)));
  pipeline::LearnedParameter learned;
  learned.name = pipeline::wall_strength_of(job.dresspacks[0].dresspack.materials[0]);
  learned.mean = learned.median = 1.5, learned.covariance = {0.25};
  job.calibration.emplace().parameters = {learned};
  check_calibration(*job.calibration);
  CHECK(pipeline::knowledge_of(job).covariance(0, 0) == 1);  // no information about wires
  const auto [mean, deviation] = moments(pipeline::first_failures({swinging(job)}, ""));
  CHECK(mean == Approx(median + 1.5 * per_deviation).margin(1e-3));
  CHECK(deviation == Approx(std::hypot(0.5 * per_deviation, job.fatigue.scatter_log10)).epsilon(0.01));
  CHECK(wall_bends_at_limit(swinging(job), job, 0) == Approx(before * std::pow(10, 1.5 * per_deviation)));
  job.dresspacks[0].dresspack.materials[0].strain_life_table[0].cycles *= 1.01;
  CHECK(pipeline::wall_knowledge(job, job.dresspacks[0].dresspack.materials[0]).mean.norm() == 0);
}

}  // namespace dresslife::fatigue
