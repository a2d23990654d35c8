// The second step of reading a job: values that follow from the written ones.
#pragma once

#include "pipeline/job/job.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Places clamps at mounting points, computes stiffnesses and mass from the construction of the cables
/// (pipeline/cable/stiffness.h), and sets consequences of a rig. Parts that have problems already are not changed. document: from
/// which the job was read. Errors are added to `problems`.
void complete_job(Job& job, const Node& document, Problems& problems);

}  // namespace dresslife::pipeline
