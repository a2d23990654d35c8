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

/// Abrasion of each dresspack whose contacts are in the strain file, and whose thickness and wear rates are known.
/// lives: (sample) log10 repeats by the validated modes. The wear rate and the thickness are sampled beside them;
/// what is uncertain of the model and the motion is shared with them.
/// Errors: InputError for a patch that lies nowhere.
std::vector<pipeline::UnvalidatedMode> abrasion_modes(const pipeline::FileReader& strain,
                                                      const pipeline::Job& job,
                                                      const std::vector<double>& lives);

/// The parts and modes of the job that have no life, in words: "power cable, kinks, clamps, connectors".
std::string not_evaluated(const pipeline::FileReader& strain, const pipeline::Job& job);

}  // namespace dresslife::fatigue
