#include "pipeline/advise/improve/faults.h"

#include "pipeline/base/errors.h"
#include "pipeline/cable/excess.h"
#include "pipeline/job/job.h"

namespace dresslife::pipeline {

std::vector<Warning> dresspack_faults(const Job& job, bool refuse) {
  std::vector<Warning> all;
  const bool may_slide = slides(job.strain.slip.front());
  for (const MountedDresspack& mounted : job.dresspacks) {
    const std::vector<Warning> pressed = may_slide ? slack_warnings(mounted.dresspack) : std::vector<Warning>{};
    if (refuse && !pressed.empty())
      throw InputError({pressed.front().where.empty() ? mounted.dresspack.name : pressed.front().where},
                       "no routing can keep the limits: " + pressed.front().words,
                       "correct the dresspack before the search");
    all = joined(std::move(all), construction_warnings(mounted.dresspack, may_slide));
  }
  return all;
}

}  // namespace dresslife::pipeline
