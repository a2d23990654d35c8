#include "pipeline/resolve/other_routing.h"

#include "pipeline/job/job_forms.h"
#include "pipeline/resolve/check_job.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

std::optional<Job> with_routing(Job job, const Node& document) {
  const Node* const written = document.find("routing");
  if (!written || !forms_of(job).one || job.motion.is_prescribed()) return std::nullopt;
  Routing& routing = job.dresspacks.front().routing = {};
  try {
    read_fields(*written, routing);
    place_clamps(routing, job.robot);
    job.motion.left_out = plausibility_of_motion(job);
    Problems problems;
    check_job(job, document, problems);
    problems.finish();
  } catch (const InputError&) {  // job_from() finds the same problem and places it in the whole document
    return std::nullopt;
  }
  return job;
}

}  // namespace dresslife::pipeline
