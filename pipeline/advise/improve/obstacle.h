// Reasons why no trial is feasible: the limits that no trial satisfies, the smallest violation, and the keys at an end of their
// ranges.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/improve/freedom.h"
#include "pipeline/advise/improve/improvement.h"

namespace dresslife::pipeline {

/// Returns the trial that ran with the smallest violation; trials.size(): no trial ran.
std::size_t nearest_trial(const std::vector<Trial>& trials);

/// Returns one line each: the trial with the smallest violation, its violated limits and its life compared with the original jobs
/// (the first trial); each limit that no trial satisfies; ends of ranges at which that trial is. Precondition: no trial is
/// feasible.
std::vector<std::string> obstacle_words(const std::vector<Trial>& trials, const Freedom& freedom);

}  // namespace dresslife::pipeline
