// Detects implausible numbers of a job outside of its dresspack (pipeline/cable/plausible.h) that a wrong unit explains. The
// ranges of the keys accept them, and all results would be wrong without a message.
#pragma once

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// Checks for: gravity that is not downward or not that of the earth; settings of strain and fatigue in another unit; a sample
/// rate that misses the swing; a strain gate that drops cycles which break wires; limits, speeds and accelerations of the robot's
/// axes in another unit or order; clamps in the air; and the steps of a motion without a program.
std::vector<Warning> plausibility_warnings(const Job& job);

/// Checks for: a motion in which no axis moves; joint angles that are all radians; single targets in radians or in metres; times
/// in milliseconds; speeds that are shares or in another unit; dwells in milliseconds. Returns one warning per kind, at its first
/// step, with the number of further ones.
std::vector<Warning> plausibility_of_steps(const Motion& motion);

}  // namespace dresslife::pipeline
