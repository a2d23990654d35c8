// Numbers of a motion's steps that another unit explains: accepted by the ranges of the keys, and silently wrong in every
// result.
#pragma once

#include "pipeline/job/motion.h"

namespace dresslife::pipeline {

/// Joint angles that are all radians, speeds that are shares, dwells that are milliseconds. Each warning names the step.
std::vector<Warning> plausibility_warnings(const Motion& motion);

}  // namespace dresslife::pipeline
