// The same motion with a softer and a stiffer hose. From them dresslife-strain computes how lives depend on the hose's stiffness.
// Limits that only these hoses exceed cause warnings (pipeline/job/beyond_limit.h).
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "sim/run/quick_checks.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {

/// Writes /softer and /stiffer of motion.h5, each from one repeat of the motion after a lead-in repeat and, if the repeat after
/// that does not end where it began, one more. Writes nothing if the job's uncertainty does not need them. own: the job's own run,
/// whose time step they have. With twice this step the life of `hard` at 0.7 times the stiffness was a hundredth. Returns a warning
/// for each side whose simulation is refused. It is then recorded at half the change; if that is refused, too, its group is absent.
/// If the dresspack is pulled tight there, dresslife-fatigue counts one repeat as its life (attributes softer_taut_z and stiffer_taut_z).
/// Returns a warning for each limit that a side exceeds and the job's own run keeps, also that of the distance between repeats.
std::vector<pipeline::Warning> write_other_stiffnesses(const pipeline::Job& job, const RunSummary& own,
                                                       pipeline::FileWriter& file);

/// Returns the stiffness of the softer hose as a share of the job's; 1: the job's uncertainty needs none.
double softer_hose(const pipeline::Uncertainty& uncertainty);

/// Returns the warnings of limits and refusals that short runs with a softer and a stiffer hose find. They do not judge the distance
/// between repeats if the job allows more than two. own: the job's own short run; it ran.
std::vector<pipeline::Warning> other_stiffness_warnings(const pipeline::Job& job, const ShortRun& own);

}  // namespace dresslife::sim
