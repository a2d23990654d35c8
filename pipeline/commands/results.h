// Output of a study for readers, besides its numbers: the files of the ranking, pages of jobs, previews of refused jobs.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "pipeline/base/limits.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {

/// Writes ranking.csv, report.html and the pages that it links to. Returns the jobs whose results could not all be shown, after
/// printing a message about each. Errors: InputError when a file cannot be written; DiskError.
[[nodiscard]] std::set<std::string> write_results(const Study& study, const StudyPlaces& places,
                                                  const std::vector<RankingRow>& rows);

/// Writes pages of jobs that the simulation refuses, beside their logs. Only the first few jobs get a page, because a study that
/// varies a routing may have thousands of refused jobs. Returns the pages.
std::vector<std::filesystem::path> refresh_previews(const Study& study, const StudyPlaces& places,
                                                    const std::vector<JobState>& states);

/// Runs `dresslife-sim --preview` with its output in the file `preview`. Returns its exit status.
int print_preview(const std::filesystem::path& job, const std::vector<std::string>& sets, const StageLimits& limits,
                  const std::filesystem::path& preview, StageWords said = StageWords::shown);

}  // namespace dresslife::pipeline
