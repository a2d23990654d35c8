// Jobs that are alike up to a stage share what it made: of many that differ in their last settings only, the
// first stages run once. Those that are to run now share within the build graph (makers_of); here, what lies
// in folders already.
#pragma once

#include <vector>

#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// Gives jobs that are not done what jobs with the same recipes have made: outputs by another name (a hard
/// link; a copy where the file system has none), with receipts and logs. Brings `states` up to date. Errors:
/// InputError when a folder cannot be written.
void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states);

}  // namespace dresslife::pipeline
