// Checks that the parts of a job fit together.
#pragma once

#include "pipeline/job/job.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Adds contradictions between parts of the job to `problems`. Parts that have problems already are not checked. document: from
/// which the job was read.
void check_job(const Job& job, const Node& document, Problems& problems);

/// Does the checks of check_job() that compare pieces of a job (pieces.h) with each other. rest: job with its dresspack. Precondition:
/// has_pieces(). Errors: InputError.
void check_between_pieces(const Motion& motion, const Robot& robot, const Routing& routing, const Job& rest);

}  // namespace dresslife::pipeline
