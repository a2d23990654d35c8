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

/// Wear of the cables' jackets in each hose, of the cable that is worn through first. Jackets without thickness or wear rates
/// are left out. lives: as above. Errors: InputError for a patch that lies nowhere.
std::vector<pipeline::UnvalidatedMode> jacket_modes(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                    const std::vector<double>& lives);

/// The ends of what makers promise of the cables without described wires (rated_cables.h), one mode for each. lives: as above;
/// the damage exponent is sampled beside them. Errors: InputError for deformations that are not of the dresspack's segments.
std::vector<pipeline::UnvalidatedMode> rating_modes(const pipeline::FileReader& strain,
                                                    const pipeline::Job& job,
                                                    const std::vector<double>& lives);

/// Corkscrew of each dresspack with loose cables (corkscrew.h), of the cable that is nearest to it. lives: as above. tension: see there.
std::vector<pipeline::UnvalidatedMode> corkscrew_modes(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                       const std::vector<double>& lives,
                                                       const std::vector<std::vector<double>>& tension);

/// Kinks of the smooth tubes in each dresspack and of a smooth hose (pipeline/cable/kink.h): of the tube that the tightest bend of
/// the dresspack's axis brings nearest to its kink. A tube that kinks does so in the first repeat. lives: as above. A loose tube's own
/// waves and coils in the hose are left out.
std::vector<pipeline::UnvalidatedMode> kink_modes(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                  const std::vector<double>& lives);

/// Percentiles of a mode's own lives and what it would change if it counted. own, lives: (sample) log10 repeats.
/// repeat: duration of one [s].
void set_lives(pipeline::UnvalidatedMode& mode, std::vector<double> own, const std::vector<double>& lives, double repeat);

/// The parts and modes of the job that have no life, in words: "power cable, kinks of the hose, corkscrew, fretting and grip at clamps, connectors".
/// corkscrew: it is evaluated for all dresspacks.
std::string not_evaluated(const pipeline::FileReader& strain, const pipeline::Job& job, bool corkscrew);

}  // namespace dresslife::fatigue
