// Speeds, waits and angles that a robot can execute and a programmer hardly means: a number in another unit.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/motion.h"

namespace dresslife::sim {

/// One warning per kind, at its first step, with the number of further steps. motion: its steps, not a program.
std::vector<pipeline::Warning> unusual_motion(const pipeline::Motion& motion);

}  // namespace dresslife::sim
