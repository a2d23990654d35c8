// The second step of reading a job: what follows from what its user wrote.
#pragma once

#include "pipeline/job/job.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Places clamps at mounting points, takes stiffnesses and mass from the construction of the cables
/// (pipeline/cable/stiffness.h), and sets what a rig implies. Parts that have problems already stay as they
/// are. document: from which the job was read. What cannot be completed is added to the problems.
void complete_job(Job& job, const Node& document, Problems& problems);

}  // namespace dresslife::pipeline
