// Strength of the wall of hoses of one material: an uncertain parameter beside those of the wires (uncertainty.h).
//
// With its z the strain amplitudes of the material's life curve are wall_strength_step^z times as large. Nothing but the hose's
// wall depends on it. Of a plant's dresspacks it is learned by `dresslife calibrate` as "wall strength of MATERIAL".
#pragma once

#include <string>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

struct Job;
struct Material;

/// At one deviation. Three polyamides bear amplitudes of 0.0091, 0.012 and 0.017 for ten million cycles (sources:
/// config/materials/hose_polyamide.yaml). The deviation of their logarithms is that of a factor of 1.37. Three kinds of polyamide
/// say little about a corrugated hose of one of them, so this is an ESTIMATE.
constexpr double wall_strength_step = 1.4;

/// The parameter's name in a calibration. It contains the life curve: what was learned with another one does not count.
std::string wall_strength_of(const Material& material);
bool is_wall_strength(const std::string& parameter);

/// What is known about the wall of this material: z of its strength in the place of Uncertain::strength, and Uncertain::motion if the
/// job has a robot. Nothing else is uncertain: Uncertain::model is that of copper in air.
ParameterKnowledge wall_knowledge(const Job& job, const Material& material);

}  // namespace dresslife::pipeline
