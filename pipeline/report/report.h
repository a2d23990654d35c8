// report.html: what a study found, for who programs the robots or plans their maintenance. One page that
// needs nothing else: no requests, and a script only to sort, filter and compare; light or dark as the
// reader's machine is. Reads the life files, and for the picture of the worst moment the motion file beside
// each, where there is one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// A job whose section could not be made from its files.
struct ReportProblem {
  std::string job, words;
};

/// The page as text. rows: of read_ranking(), best life first. A life file that is damaged is named as such in its
/// place, and in `problems`. The same files give the same bytes. Errors: DiskError.
std::string report_page(const std::string& study, const std::vector<RankingRow>& rows);
std::string report_page(const std::string& study, const std::vector<RankingRow>& rows,
                        std::vector<ReportProblem>& problems);

/// Writes the page, whole or not at all; leaves it untouched when nothing changed. Returns what could not be shown.
/// Errors: DiskError; InputError when it cannot be written.
std::vector<ReportProblem> write_report(const std::filesystem::path& file, const std::string& study,
                                        const std::vector<RankingRow>& rows);

/// Which jobs have a section in the report and a page of their own: all that have a result, or of more than
/// 40 the 20 best and the 20 worst of them.
std::vector<bool> detailed_jobs(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
