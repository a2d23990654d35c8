// Jobs with the same recipes up to a stage share its output. Stages that run now are shared in the build graph
// (makers_of); this file shares outputs that exist: of jobs of the study, of jobs that its folder has besides, and of the
// studies in the folder beside it.
#pragma once

#include <vector>

#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// Gives jobs that are not done the outputs of jobs with the same recipes: as hard links, or as copies if the file
/// system has no links, with receipts and logs. Updates `states`. Nothing is written into another study: a run may be at
/// work there. Errors: InputError when a folder of this study cannot be written.
void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states);

}  // namespace dresslife::pipeline
