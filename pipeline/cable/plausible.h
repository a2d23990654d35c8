// Values of a dresspack that no dresspack has, and that another unit or a slip of the pen explains: accepted by the
// ranges of the keys, and silently wrong in every result.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Mass and stiffnesses against solid copper, its own wires and weight, damping against any swing that is seen,
/// wires, lay angles, pressures and play against what is made, bores of tubes against their radii, the corrugation
/// against the two diameters, parts side by side of one name. Each warning names key, value and limit.
std::vector<Warning> plausibility_warnings(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
