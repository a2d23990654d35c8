// Failure modes besides the wires whose law has not been compared with a test, and modes that are not evaluated.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/life/unvalidated_modes.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

/// Modes without a validated law, except the hose's wall.
struct Unvalidated {
  std::vector<pipeline::UnvalidatedMode> modes;
  std::string
      not_evaluated;  ///< parts and modes without a life: "power cable, kinks of the hose, corkscrew, connectors"
  std::vector<pipeline::Warning> warnings;
};

/// Evaluates these modes. lives: (sample) log10 repeats by the validated modes. The samples of model and motion uncertainty are
/// shared with them; the mode's own spread is sampled in addition. tension: see corkscrew.h.
/// Errors: InputError for a patch outside the dresspack, and for deformations that do not match the dresspack's segments.
Unvalidated unvalidated_modes(const pipeline::FileReader& strain, const pipeline::Job& job,
                              const std::vector<double>& lives, const std::vector<std::vector<double>>& tension);

/// Sets the percentiles of a mode's own lives and the result if the mode counted. own, lives: (sample) log10 repeats.
/// repeat: duration of one repeat [s].
void set_lives(pipeline::UnvalidatedMode& mode, std::vector<double> own, const std::vector<double>& lives,
               double repeat);

}  // namespace dresslife::fatigue
