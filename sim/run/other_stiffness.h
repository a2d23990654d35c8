// The same motion with a softer and a stiffer hose, of which dresslife-strain computes how lives depend on the hose's stiffness.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"

namespace dresslife::sim {

/// Writes /softer and /stiffer of motion.h5, each from one repeat of the motion after one that leads in; nothing where the
/// job's uncertainty does without. time_step: of the job's own run [s]. With twice of it `hard` lives a hundredth as long at
/// 0.7 times the stiffness. Returns warnings of those whose simulation is refused; their groups are absent.
std::vector<pipeline::Warning> write_other_stiffnesses(const pipeline::Job& job, double time_step,
                                                       pipeline::FileWriter& file);

}  // namespace dresslife::sim
