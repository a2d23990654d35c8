// Jobs that are alike up to a stage share what it made: of many that differ in their last settings only, the first
// stages run once.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

/// Links outputs of stages of one job, with their receipts, into the folders of jobs with the same recipes up to there,
/// and brings `states` up to date. Errors: InputError when a folder cannot be written.
void share_stages(const Study& study, const StudyPlaces& places, std::vector<JobState>& states);

/// Of the jobs that are not done those to run now: one of all that would make the same file next. Indices of jobs.
std::vector<std::size_t> without_likes(const Study& study, const std::vector<JobState>& states);

}  // namespace dresslife::pipeline
