// Bend reliefs that a search tries on its best trial.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/improve/outcome.h"
#include "pipeline/job/job.h"
#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Returns sets "routing.base_clamp.bend_relief={...}" of first_relief() (routing.h), half as stiff and as stiff as the
/// dresspack: at each clamp without a relief alone, then at all of them, for each dresspack. The length is at most half of the
/// dresspack between its clamp and the next.
std::vector<std::vector<std::string>> reliefs_of(const Job& job);

/// Returns whether the wire that breaks first is nearer to a clamp without a relief than the length of first_relief(), and
/// breaks within the robot's life.
bool breaks_beside_clamp(const Job& job, const RankingRow& row);

/// Returns "wires after 45.8 h (without it 1,280 h)": failures within the robot's life that a relief makes earlier by more than
/// the tenth of (M1) in merit.h. Empty: none. Precondition: both ran.
std::string earlier_failures(const Outcome& with, const Outcome& without);

}  // namespace dresslife::pipeline
