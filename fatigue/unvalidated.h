// Failure modes beside the wires whose law has not been compared with a test, and what is not evaluated at all.
#pragma once

#include <string>
#include <vector>

#include "pipeline/files/files.h"
#include "pipeline/life/unvalidated_modes.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

/// All of these modes but the hose's wall. lives: (sample) log10 repeats by the validated modes; what is uncertain of the model and
/// the motion is shared with them, the mode's own spread is sampled beside them. tension: see corkscrew.h.
/// Errors: InputError for a patch that lies nowhere, and for deformations that are not of the dresspack's segments.
std::vector<pipeline::UnvalidatedMode> unvalidated_modes(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                         const std::vector<double>& lives,
                                                         const std::vector<std::vector<double>>& tension);

/// Percentiles of a mode's own lives and what it would change if it counted. own, lives: (sample) log10 repeats.
/// repeat: duration of one [s].
void set_lives(pipeline::UnvalidatedMode& mode, std::vector<double> own, const std::vector<double>& lives, double repeat);

/// The parts and modes of the job that have no life, in words: "power cable, kinks of the hose, corkscrew, fretting and grip at clamps, connectors".
/// corkscrew: it is evaluated for all dresspacks.
std::string not_evaluated(const pipeline::FileReader& strain, const pipeline::Job& job, bool corkscrew);

}  // namespace dresslife::fatigue
