// Detects implausible values of a dresspack that a wrong unit or a typing error explains. The ranges of the keys accept such
// values, and all results would be wrong without a message.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Compares mass and stiffnesses with solid copper, the dresspack's own wires and its weight; damping with observed swings;
/// wires, lay angles, pressures and play with real products; bores of tubes with their radii; the corrugation with the two
/// diameters; parts of one name with each other. Each warning states key, value and limit.
std::vector<Warning> plausibility_warnings(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
