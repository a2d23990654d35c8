// Jobs with the same recipes up to a stage share its output. The build graph shares stages that run now (makers_of()). This
// file shares outputs that exist already: outputs of jobs of the study, of other jobs in its folder, and of the studies in the
// folders beside it.
#pragma once

#include <vector>

#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// Gives jobs that are not done the outputs of jobs with the same recipes: as hard links, or as copies if the file
/// system has no links, with receipts and logs. Updates `states`. Writes nothing into another study, because another run may
/// use it. Errors: InputError when a folder of this study cannot be written.
void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states);

}  // namespace dresslife::pipeline
