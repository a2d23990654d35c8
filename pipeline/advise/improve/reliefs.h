// Bend reliefs that a search tries on its best trial.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/improve/outcome.h"
#include "pipeline/job/job.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Sets "routing.base_clamp.bend_relief={...}" of first_relief() (routing.h), half as stiff and as stiff as the dresspack: at each
/// clamp without a relief alone, then at all of them, for each dresspack. A relief is at most half as long as the dresspack between its
/// clamp and the next.
std::vector<std::vector<std::string>> reliefs_of(const Job& job);

/// Whether the wire that breaks first is nearer to a clamp than its first_relief() is long, and breaks before the robot.
bool breaks_beside_clamp(const Job& job, const RankingRow& row);

/// "wires after 45.8 h (without it 1,280 h)": what fails earlier with a relief by more than the tenth of (M1) in merit.h, before the
/// end of the robot's life. Empty: nothing. Preconditions: both ran.
std::string earlier_failures(const Outcome& with, const Outcome& without);

}  // namespace dresslife::pipeline
