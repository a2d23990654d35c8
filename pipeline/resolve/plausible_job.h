// Numbers of a job beside its dresspack (pipeline/cable/plausible.h) that another unit explains. The ranges of the keys accept
// them, and every result is wrong without a word.
#pragma once

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// Gravity that is not downward or not the earth's, settings of strain and fatigue in another unit, samples that miss the
/// swing, a strain gate that hides cycles which break wires, limits, speeds and accelerations of the robot's axes in another
/// unit or order, clamps in the air, and the steps of a motion without a program.
std::vector<Warning> plausibility_warnings(const Job& job);

/// A motion in which no axis moves, joint angles that are all radians, one target in radians or in metres among others, times
/// that are milliseconds, speeds that are shares or in another unit, dwells that are milliseconds. One warning per kind, at its
/// first step, with the number of further ones.
std::vector<Warning> plausibility_of_steps(const Motion& motion);

}  // namespace dresslife::pipeline
