// Forces on cables and clamps that follow from the strains of cables and the metals of the job ((W37) in
// strain/theory.md). They are results and cause warnings, because the lives depend on them.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {

struct CableForces {
  std::vector<pipeline::Warning> warnings;
  std::vector<std::vector<double>>
      tension;  ///< (cable, sample) of the file, largest along each by size [N]; empty: unknown
};

/// Writes tensions, moments and their shares into the life file. If the file has no strains of cables but these values, they are
/// copied. Errors: InputError when the file names a cable that the job does not have.
CableForces write_cable_forces(const pipeline::FileReader& strain, const pipeline::Job& job,
                               pipeline::FileWriter& life);

}  // namespace dresslife::fatigue
