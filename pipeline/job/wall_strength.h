// Strength of the hose wall of one material: an uncertain parameter in addition to those of the wires (uncertainty.h).
//
// Its z multiplies the strain amplitudes of the material's life curve by wall_strength_step^z. Only the hose's wall depends on
// it. `dresslife calibrate` learns it from a plant's dresspacks as "wall strength of MATERIAL".
#pragma once

#include <string>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

struct Job;
struct Material;

/// Factor at one standard deviation. Three polyamides bear amplitudes of 0.0091, 0.012 and 0.017 for ten million cycles (sources:
/// config/materials/hose_polyamide.yaml). The standard deviation of their logarithms is a factor of 1.37. Three kinds of
/// polyamide give little information about a corrugated hose of one of them, so this is an ESTIMATE.
constexpr double wall_strength_step = 1.4;

/// Returns the parameter's name in a calibration. It contains the life curve: a calibration with another curve has no effect.
std::string wall_strength_of(const Material& material);
bool is_wall_strength(const std::string& parameter);

/// Returns the knowledge about the wall of this material: the z of its strength at Uncertain::strength, and Uncertain::motion if
/// the job has a robot. All other variances are 0, because Uncertain::model is that of copper in air.
ParameterKnowledge wall_knowledge(const Job& job, const Material& material);

}  // namespace dresslife::pipeline
