// report.html: the results of a study for robot programmers and maintenance planners. One complete page without
// requests; a script only sorts, filters and compares. The page follows the reader's light or dark scheme. Its sources are the
// life files, and the motion file beside each for the picture of the worst moment.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// A job whose section could not be written.
struct ReportProblem {
  std::string job, words;
};

/// Returns the page as text. rows: result of read_ranking(), longest life first. A damaged life file is named in its section and
/// in `problems`. The same files give the same bytes. Errors: DiskError.
std::string report_page(const std::string& study, const std::vector<RankingRow>& rows,
                        std::vector<ReportProblem>& problems);

/// Writes the page if it changed. Returns the jobs whose sections could not be written. Errors: DiskError; InputError when the
/// page cannot be written.
std::vector<ReportProblem> write_report(const std::filesystem::path& file, const std::string& study,
                                        const std::vector<RankingRow>& rows);

/// Returns which jobs have a section and a page: all jobs with a result; of more than 40 the 20 best and the 20 worst.
std::vector<bool> detailed_jobs(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
