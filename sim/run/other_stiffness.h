// The same motion with a softer and a stiffer hose. From them dresslife-strain computes how lives depend on the hose's stiffness.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"

namespace dresslife::sim {

/// Writes /softer and /stiffer of motion.h5, each from one repeat of the motion after one lead-in repeat. Writes nothing if the
/// job's uncertainty does not need them. time_step: step of the job's own run [s]. With twice this step the life of `hard` at
/// 0.7 times the stiffness was a hundredth. Returns a warning for each side whose simulation is refused. It is then recorded
/// at half the change; if that is refused, too, its group is absent.
std::vector<pipeline::Warning> write_other_stiffnesses(const pipeline::Job& job, double time_step,
                                                       pipeline::FileWriter& file);

}  // namespace dresslife::sim
