#include "pipeline/job/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/order.h"
#include "pipeline/job/fatigue.h"
#include "pipeline/job/material.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

double UncertainParameter::value(double z) const { return logarithmic ? std::pow(step, z) : step * z; }

double UncertainParameter::deviation() const { return logarithmic ? std::log(step) : step; }

double UncertainParameter::z_of(double value) const { return (logarithmic ? std::log(value) : value) / deviation(); }

const std::array<UncertainParameter, uncertain_count>& uncertain_parameters() {
  static const std::array<UncertainParameter, uncertain_count> parameters{{
      {"friction_inside", "strain.friction_factor", true, 2.2, true, SharedBy::construction,
       "ESTIMATE, from seven published jacketed cables",
       "a cable's bending moment at 1 1/m: measured_bending_stiffness_Nm2", "the friction inside the cables",
       "One bending test of a cable (one hour)",
       0.26},  // a factor of 1.3: the moment is measured to 15 %, about half of it is friction
      {"friction_hose", "strain.hose_friction_factor", true, 2, true, SharedBy::construction,
       "ESTIMATE: coefficients of polymers on polymers are 0.15 to 0.6",
       "the force that pulls one cable through its hose", "the friction of the cables on their hose",
       "One cable pulled through its hose with a spring scale (one hour)", 0.2},  // the force is measured to 20 %
      {"slack", "strain.slack_factor", true, 1.5, true, SharedBy::installation,
       "ESTIMATE: 2 cm in 2 m, mounted by hand to within about 1 cm",
       "the length of each cable between the clamps against the hose's: slack_percent",
       "the excess length of the cables in the hose",
       "The length of each cable measured against the hose (half an hour)", 0.15},  // 3 mm of 20 mm
      {"play", "strain.play_factor", true, 1.4, true, SharedBy::construction,
       "ESTIMATE: differences of diameters known to 1 or 2 mm each",
       "the inner diameter of the hose and the cables' outer ones: play_mm", "the room in which the cables can move",
       "The diameters of hose and cables measured with a caliper (half an hour)", 0.1},  // 0.5 mm of 5 mm
      {"grip", "strain.grip_factor", true, 2, true, SharedBy::installation,
       "ESTIMATE: a clamp's screw and rubber by hand; without effect where no grip is given",
       "the force that pulls a cable out of its clamp: tool_grip_N", "the force at which a clamp lets a cable slip",
       "One cable pulled out of its clamp with a spring scale (one hour)", 0.2},  // the force is measured to 20 %
      {"rest", "strain.rest", false, 1, true, SharedBy::installation,
       "The places are those to which several starts of the cables lead (/start/rest of strain.h5). The key has no "
       "effect without a ring of loose cables",
       "nothing: with slack_percent the number of places changes, too", "where the loose cables come to rest",
       "The places of the cables in an opened hose noted (half a day)",
       3.0},  // the cables of the next dresspack have other rest positions
      {"hose_stiffness", "simulation.stiffness_factor", true, 1.75, true, SharedBy::construction,
       "ESTIMATE, from five published jacketed cables. The key has no effect if the hose does not move",
       "the sag of a hanging length of the dresspack with a weight: bending_stiffness_Nm2",
       "the stiffness of the dresspack", "A hanging length of the dresspack bent by a weight (one hour)",
       0.15},  // the sag is measured to 15 %
      {"strength", "fatigue.strength_factor", true, 1.3, false, SharedBy::material,
       "Source: errors of rules from tensile tests (Nachtigall 1975) and the differences of the soft coppers in "
       "config/materials",
       "two cables in a torsion or flex test, with the cycles at which they failed (dresslife calibrate)",
       "the strain that the wires withstand", "Two cables bent or twisted in a test until they fail (some weeks)",
       0.1},  // 0.3 decades of life, to the power 1/7
      {"slope", "fatigue.slope_change", false, 0.01, false, SharedBy::material,
       "ESTIMATE: published slopes of copper are -0.112 and -0.12", "the same test at half the twist or bend",
       "the slope of the wires' fatigue life over the strain", "The same test at half the bend or twist (some weeks)",
       0.005},  // 0.15 decades of life for a factor of two in strain
      {"scatter", "fatigue.scatter_factor", true, 1.4, false, SharedBy::material,
       "ESTIMATE: foils of one batch 0.04, fatigue lives often 0.3 of a decade, 0.2 in between",
       "five or more equal specimens in one test", "how much the lives of equal wires differ",
       "Five equal cables tested until they fail (some weeks)",
       0.35},  // standard deviation of five values: 1 / sqrt(2 (5 - 1))
      {"model", "fatigue.model_factor", true, 2, false, SharedBy::everything, "ESTIMATE",
       "dresspacks that broke, or have not, with their programs and hours (dresslife calibrate)",
       "what the model leaves out, such as wear and temperature", "One dresspack observed until it fails (months)",
       0.5},  // 0.2 decades of scatter
      {"motion", "fatigue.motion_factor", true, 3.7, false, SharedBy::installation,
       "ESTIMATE, from four programs with other ramps and another damping. The key has no effect without a robot",
       "the swing of the mounted dresspack after a stop: damping_time_ms, bending_stiffness_Nm2, motion.ramp_percent",
       "how the hose swings", "The stops filmed with the dresspack mounted (one hour)",
       1.0},  // the film does not show the cables in the hose
  }};
  return parameters;
}

std::size_t index_of(std::string_view name) {
  const auto& known = uncertain_parameters();
  const auto found = std::ranges::find_if(known, [&](const auto& one) { return one.name == name; });
  return static_cast<std::size_t>(found - known.begin());
}

std::vector<std::string> sets_at(std::span<const double> z) {
  std::vector<std::string> sets;
  for (std::size_t p = 0; p < uncertain_count; ++p)
    if (z[p] != 0)
      sets.push_back(
          fmt::format("{}={}", uncertain_parameters()[p].key, shortest_text(uncertain_parameters()[p].value(z[p]))));
  return sets;
}

std::array<double, uncertain_count> Uncertainty::default_spread() {
  std::array<double, uncertain_count> spread;
  for (std::size_t p = 0; p < uncertain_count; ++p) spread[p] = uncertain_parameters()[p].step;
  return spread;
}

void describe(Fields& f, Uncertainty& uncertainty) {
  f.boolean("enabled", uncertainty.enabled, Need::optional,
            "Whether lives include the uncertain parameters beside the wires' scatter. It takes at most twice as "
            "much time again.");
  f.choice(
      "ratings", uncertainty.ratings,
      "What is known of cables without a calibration. typical: what makers promise of their cables in tests "
      "(config/observations/ratings.yaml); without effect if enabled is false, on parameters that the job states, and if strain or "
      "fatigue have other settings than the tests (a warning names the setting). none: only the deviations below.");
  f.text("ratings_left_out", uncertainty.ratings_left_out, Need::written,
         "The setting of the job with which the ratings of typical cables are not valid.");
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    f.number(parameter.name, uncertainty.spread[p], Need::optional,
             parameter.logarithmic ? between(1, 100) : between(0, 5 * parameter.step),
             fmt::format("The standard deviation of {}, as {} of {}. {}: it is known. {}.", parameter.cause,
                         parameter.logarithmic ? "a factor" : "a change", parameter.key, parameter.logarithmic ? 1 : 0,
                         parameter.source));
  }
}

bool is_known(const Uncertainty& uncertainty, Uncertain parameter) {
  const std::size_t index = index_of(parameter);
  return uncertain_parameters()[index].z_of(uncertainty.spread[index]) == 0;
}

double other_stiffness(const Uncertainty& uncertainty) {
  // standard deviations: 90 % of hoses are in this range. Lives beyond it are extrapolated (sim/measurements.md has the error
  // with 1.25)
  constexpr double reach = 1.65;
  const UncertainParameter& stiffness = uncertain_parameters()[index_of(Uncertain::hose_stiffness)];
  return uncertainty.enabled ? reach * stiffness.z_of(uncertainty.spread[index_of(Uncertain::hose_stiffness)]) : 0;
}

std::vector<std::size_t> sampling_order() {
  std::vector<std::size_t> order = indices_of(uncertain_count);
  // clang 14 does not compile std::ranges::stable_partition
  std::stable_partition(order.begin(), order.end(),
                        [](std::size_t p) { return uncertain_parameters()[p].shared != SharedBy::installation; });
  return order;
}

Eigen::MatrixXd triangular_factor(const Eigen::MatrixXd& covariance, const std::vector<std::size_t>& order) {
  const auto n = static_cast<Eigen::Index>(order.size());
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
  const auto of = [&](Eigen::Index a, Eigen::Index b) {
    return covariance(static_cast<Eigen::Index>(order[std::size_t(a)]),
                      static_cast<Eigen::Index>(order[std::size_t(b)]));
  };
  for (Eigen::Index column = 0; column < n; ++column) {
    const double left = of(column, column) - factor.row(column).head(column).squaredNorm();
    if (!(left > 1e-12)) continue;
    factor(column, column) = std::sqrt(left);
    for (Eigen::Index row = column + 1; row < n; ++row)
      factor(row, column) = (of(row, column) - factor.row(row).head(column).dot(factor.row(column).head(column))) /
                            factor(column, column);
  }
  return factor;
}

ParameterKnowledge prior_of(const Uncertainty& uncertainty) {
  ParameterKnowledge prior{Eigen::VectorXd::Zero(uncertain_count),
                           Eigen::MatrixXd::Zero(uncertain_count, uncertain_count)};
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const auto at = static_cast<Eigen::Index>(p);
    prior.covariance(at, at) = std::pow(uncertain_parameters()[p].z_of(uncertainty.spread[p]), 2);
  }
  return prior;
}

namespace {

double lives_factor(const Fatigue& fatigue) { return fatigue.model_factor * fatigue.motion_factor; }

void change_table(std::vector<StrainLifePoint>& table, const Fatigue& fatigue) {
  for (StrainLifePoint& point : table) {
    point.strain_amplitude *=
        fatigue.strength_factor * std::pow(2 * point.cycles / reversals_of_slope, fatigue.slope_change);
    point.cycles *= lives_factor(fatigue);
  }
}

}  // namespace

// If strains and stresses are multiplied by s, eps/s = (sig/s)/E + ((sig/s)/K')^(1/n'), so K' is multiplied by s^(1 - n'). A
// factor of the lives does not change n' and K' = sf'/ef'^n'.
Material changed(Material material, const Fatigue& fatigue) {
  if (!is_changed(fatigue)) return material;
  change_table(material.strain_life_table, fatigue);
  if (!material.strain_life_table.empty()) return material;
  const auto compatible = [](const Material& of) {
    const double exponent = of.fatigue_strength_exponent / of.fatigue_ductility_exponent;
    return std::pair(exponent, of.fatigue_strength / std::pow(of.fatigue_ductility, exponent));
  };
  const auto [exponent_before, strength_before] = compatible(material);
  material.fatigue_strength *= fatigue.strength_factor * std::pow(reversals_of_slope, -fatigue.slope_change);
  material.fatigue_ductility *= fatigue.strength_factor;
  material.fatigue_strength_exponent += fatigue.slope_change;
  const auto [exponent, strength] = compatible(material);
  if (material.cyclic_hardening_exponent) *material.cyclic_hardening_exponent *= exponent / exponent_before;
  if (material.cyclic_strength) *material.cyclic_strength *= strength / strength_before;
  material.fatigue_strength *= std::pow(lives_factor(fatigue), -material.fatigue_strength_exponent);
  material.fatigue_ductility *= std::pow(lives_factor(fatigue), -material.fatigue_ductility_exponent);
  return material;
}

}  // namespace dresslife::pipeline
