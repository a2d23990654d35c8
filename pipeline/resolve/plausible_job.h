// Numbers of a job beside its dresspack (pipeline/cable/plausible.h) that another unit explains: accepted by the
// ranges of the keys, and silently wrong in every result.
#pragma once

#include "pipeline/job/job.h"

namespace dresslife::pipeline {

/// Joint angles that are all radians, speeds that are shares, dwells that are milliseconds, samples that miss the
/// swing, a strain gate that hides cycles which break wires. Each warning names step or key.
std::vector<Warning> plausibility_warnings(const Job& job);

}  // namespace dresslife::pipeline
