// Distribution of the life of a hose's wall over uncertain parameters. It is reported besides the headline.
//
// The place of the wall with the largest damage lives for W repeats. If the strain amplitudes of its life curve are multiplied by f,
// it lives for W(f) repeats by a new count. With z, y, u standard normal and m, s the job's uncertainty.motion and scatter of lives,
//     log10 life = log10 W(1.4^z) + y log10 m + u s                                                          (F37)
// z: strength of the wall's material (pipeline/job/wall_strength.h). It is common to hoses of one material, and
// `dresslife calibrate` learns it from dresspacks in service. y: the motion in the wires' samples. s: scatter of the wires, an
// ESTIMATE for a polymer.
// A curve of two points N ~ strain^-k gives W(f) = W f^k, so without motion the deviation of log10 of life is hypot(k log10 1.4, s).
//
// Not contained: pressure, temperature, another worst place at another strength (which does not occur if k is constant).
#pragma once

#include <span>

#include "fatigue/rainflow.h"
#include "pipeline/life/life_response.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

/// Returns the response (F37). worst_place: reversals of the wall's worst place in one repeat.
pipeline::LifeResponse wall_response(std::span<const Reversal> worst_place, const pipeline::Job& job,
                                     std::size_t dresspack);

/// Returns by the wall's law, with its median strength, the number of bends of a straight hose to its bend radius limit; 0
/// without measured points.
double wall_bends_at_limit(const pipeline::LifeResponse& wall, const pipeline::Job& job, std::size_t dresspack);

}  // namespace dresslife::fatigue
