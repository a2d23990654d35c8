// What a study leaves for people beside its numbers: the ranking's files, pages of jobs, previews of what is
// refused.
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

/// ranking.csv, report.html and the pages that it links to. Returns the jobs whose results could not all be shown,
/// which it has said. Errors: InputError where a file cannot be written, DiskError.
[[nodiscard]] std::set<std::string> write_results(const Study& study, const StudyPlaces& places,
                                                  const std::vector<RankingRow>& rows);

/// Pages of jobs that the simulation refuses, beside their logs; of the first few, as a study that varies a
/// routing may have thousands. Returns them.
std::vector<std::filesystem::path> refresh_previews(const Study& study, const StudyPlaces& places,
                                                    const std::vector<JobState>& states);

/// Lets dresslife-sim tell into a file what stands where. Returns its exit status.
int print_preview(const std::filesystem::path& job, const std::vector<std::string>& sets,
                 const StageLimits& limits, const std::filesystem::path& preview,
                 StageWords said = StageWords::shown);

}  // namespace dresslife::pipeline
