#include "pipeline/job/uncertainty.h"

#include <cmath>
#include <set>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double rounding = 1e-12;

Material copper() {
  Material material;
  material.name = "copper";
  material.youngs_modulus = 117e9;
  material.fatigue_strength = 491.5e6;
  material.fatigue_strength_exponent = -0.112;
  material.fatigue_ductility = 1.215;
  material.fatigue_ductility_exponent = -0.6;
  return material;
}

/// Returns the strain amplitude by (8).
double amplitude(const Material& m, double reversals) {
  return m.fatigue_strength / m.youngs_modulus * std::pow(reversals, m.fatigue_strength_exponent) +
         m.fatigue_ductility * std::pow(reversals, m.fatigue_ductility_exponent);
}

double hardening(const Material& m) { return m.fatigue_strength_exponent / m.fatigue_ductility_exponent; }
double cyclic_strength(const Material& m) { return m.fatigue_strength / std::pow(m.fatigue_ductility, hardening(m)); }

}  // namespace

TEST_CASE("uncertain parameters: z and the key's value lead to each other, and 0 changes nothing") {
  std::set<std::string_view> names, keys;
  for (const UncertainParameter& parameter : uncertain_parameters()) {
    INFO(parameter.name);
    names.insert(parameter.name);
    keys.insert(parameter.key);
    CHECK(parameter.value(0) == (parameter.logarithmic ? 1 : 0));
    CHECK(parameter.value(1) > parameter.value(0));
    for (const double z : {-2.5, -0.3, 1.7}) CHECK(parameter.z_of(parameter.value(z)) == Approx(z).epsilon(rounding));
  }
  CHECK(names.size() == uncertain_count);
  CHECK(keys.size() == uncertain_count);
  CHECK(uncertain_parameters()[index_of(Uncertain::slope)].name == "slope");
  CHECK(uncertain_parameters()[index_of(Uncertain::model)].name == "model");
  CHECK(uncertain_parameters()[index_of(Uncertain::motion)].name == "motion");
}

TEST_CASE("uncertain parameters: each one's key is a key of every job, at two deviations either way") {
  const Scratch scratch;
  const auto file = scratch.write("job.yaml", sample_job);
  for (const double sign : {-2.0, 2.0}) {
    std::array<double, uncertain_count> z;
    z.fill(sign);
    CHECK(sets_at(z).size() == uncertain_count);
    const Job job = read_job(file, sets_at(z));
    CHECK(job.strain.factors.friction == Approx(uncertain_parameters()[0].value(sign)));
    CHECK(job.fatigue.model_factor == Approx(uncertain_parameters()[index_of(Uncertain::model)].value(sign)));
    CHECK(job.fatigue.motion_factor == Approx(uncertain_parameters()[index_of(Uncertain::motion)].value(sign)));
  }
  CHECK(sets_at(std::array<double, uncertain_count>{}).empty());
}

TEST_CASE("prior: standard normal, narrower or wider by the spread that a job gives") {
  Uncertainty uncertainty;
  CHECK((prior_of(uncertainty).covariance - Eigen::MatrixXd::Identity(uncertain_count, uncertain_count)).norm() <
        rounding);
  uncertainty.spread[0] = 1;
  uncertainty.spread[1] *= uncertainty.spread[1];
  const ParameterKnowledge prior = prior_of(uncertainty);
  CHECK(prior.mean.norm() == 0);
  CHECK(prior.covariance(0, 0) == 0);
  CHECK(prior.covariance(1, 1) == Approx(4).epsilon(rounding));
}

TEST_CASE(
    "changed material: as it was at the defaults, strains by the first factor, lives by the last, slopes "
    "about a life") {
  Fatigue fatigue;
  CHECK(changed(copper(), fatigue).fatigue_strength == copper().fatigue_strength);
  fatigue.strength_factor = 0.5;
  Material weak = changed(copper(), fatigue);
  for (const double life : {1e2, 1e5, 1e9})
    CHECK(amplitude(weak, life) == Approx(0.5 * amplitude(copper(), life)).epsilon(rounding));
  fatigue = {};
  fatigue.model_factor = 3;
  const Material old = changed(copper(), fatigue);
  for (const double life : {1e2, 1e5, 1e9})
    CHECK(amplitude(old, 3 * life) == Approx(amplitude(copper(), life)).epsilon(rounding));
  CHECK(cyclic_strength(old) == Approx(cyclic_strength(copper())).epsilon(rounding));
  fatigue = {};
  fatigue.slope_change = 0.02;
  const Material flat = changed(copper(), fatigue);
  CHECK(amplitude(flat, reversals_of_slope) == Approx(amplitude(copper(), reversals_of_slope)).epsilon(rounding));
  CHECK(amplitude(flat, 1e9) > amplitude(copper(), 1e9));
}

TEST_CASE("changed material: a cyclic curve of its own keeps its distance to the compatible one") {
  Material own = copper();
  own.cyclic_strength = 1.05 * cyclic_strength(own);
  own.cyclic_hardening_exponent = 1.1 * hardening(own);
  Fatigue fatigue;
  fatigue.strength_factor = 1.3, fatigue.slope_change = -0.01, fatigue.model_factor = 2;
  const Material after = changed(own, fatigue);
  CHECK(*after.cyclic_strength / cyclic_strength(after) == Approx(1.05).epsilon(rounding));
  CHECK(*after.cyclic_hardening_exponent / hardening(after) == Approx(1.1).epsilon(rounding));
}

TEST_CASE("changed material: measured points move in the same way") {
  Material measured;
  measured.strain_life_table = {{0.02, 1e3}, {0.01, 1e5}};
  Fatigue fatigue;
  fatigue.strength_factor = 0.8, fatigue.model_factor = 2, fatigue.slope_change = 0.01;
  const auto table = changed(measured, fatigue).strain_life_table;
  CHECK(table[1].cycles == Approx(2e5));
  CHECK(table[1].strain_amplitude == Approx(0.008).epsilon(rounding));  // 2e5 reversals: the slope changes there
  CHECK(table[0].strain_amplitude == Approx(0.016 * std::pow(2e3 / 2e5, 0.01)).epsilon(rounding));
}

TEST_CASE("job: a slope that leaves no strain-life curve is refused") {
  const Scratch scratch;
  const auto file = scratch.write("job.yaml", sample_job);
  CHECK_THROWS_WITH(read_job(file, {"fatigue.slope_change=0.1"}), Catch::Contains("must be -0.02 or less"));
}

TEST_CASE("other stiffnesses of the hose are 0.4 and 2.5 times its own, and follow the deviation that a job gives") {
  const UncertainParameter& stiffness = uncertain_parameters()[index_of(Uncertain::hose_stiffness)];
  Uncertainty uncertainty;
  constexpr double per_cent = 0.01;  // 1.65 deviations of a factor of 1.75: 2.518
  CHECK(stiffness.value(other_stiffness(uncertainty)) == Approx(2.5).epsilon(per_cent));
  double& spread = uncertainty.spread[index_of(Uncertain::hose_stiffness)];
  spread = 1.1;
  CHECK(stiffness.value(other_stiffness(uncertainty)) == Approx(std::pow(1.1, 1.65)).epsilon(rounding));
  spread = 1;
  CHECK(other_stiffness(uncertainty) == 0);
  uncertainty = {};
  uncertainty.enabled = false;
  CHECK(other_stiffness(uncertainty) == 0);
}
