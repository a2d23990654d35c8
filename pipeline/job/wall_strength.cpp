#include "pipeline/job/wall_strength.h"

#include <fmt/format.h>

#include "pipeline/job/job.h"

namespace dresslife::pipeline {
namespace {

constexpr const char* words = "wall strength of ";
using Eigen::Index;

}  // namespace

std::string wall_strength_of(const Material& material) {
  std::string curve;
  for (const StrainLifePoint& point : material.strain_life_table)
    curve += fmt::format("{}{:g} {:g}", curve.empty() ? "" : ", ", point.strain_amplitude, point.cycles);
  if (curve.empty())
    curve = fmt::format("{:g} {:g}, {:g} {:g}", material.fatigue_strength, material.fatigue_strength_exponent,
                        material.fatigue_ductility, material.fatigue_ductility_exponent);
  return fmt::format("{}{} ({})", words, material.name, curve);
}

bool is_wall_strength(const std::string& parameter) { return parameter.starts_with(words); }

ParameterKnowledge wall_knowledge(const Job& job, const Material& material) {
  constexpr auto strength = static_cast<Index>(index_of(Uncertain::strength)),
                 motion = static_cast<Index>(index_of(Uncertain::motion));
  const ParameterKnowledge prior = prior_of(job.uncertainty);
  ParameterKnowledge known{Eigen::VectorXd::Zero(uncertain_count),
                           Eigen::MatrixXd::Zero(uncertain_count, uncertain_count)};
  if (!job.uncertainty.enabled) return known;
  known.covariance(strength, strength) = 1;
  if (!job.robot.joints.empty()) known.covariance(motion, motion) = prior.covariance(motion, motion);
  if (!job.calibration) return known;
  for (std::size_t i = 0; i < job.calibration->parameters.size(); ++i)
    if (const LearnedParameter& learned = job.calibration->parameters[i]; learned.name == wall_strength_of(material))
      known.mean(strength) = learned.mean, known.covariance(strength, strength) = learned.covariance.at(i);
  return known;
}

}  // namespace dresslife::pipeline
