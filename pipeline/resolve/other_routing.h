// A job with another routing. Jobs of a study often differ only in it, and it needs a small part of the time of a whole job.
#pragma once

#include <optional>

#include "pipeline/job/job.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Returns a job with the routing of `document`, which has no other keys of the job. std::nullopt: the routing is refused, or the job
/// has several dresspacks or no robot; then job_from() reads the whole job. Precondition: job_from() returned `job`.
std::optional<Job> with_routing(Job job, const Node& document);

}  // namespace dresslife::pipeline
