// Warnings of a study's jobs as text.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Returns the warnings of a row, of a stale job those of its last result; for an older file without warnings the warning about its
/// forces.
std::vector<Warning> warnings_of(const RankingRow& row);

/// Returns whether a warning names a file by its path from the folder of the study.
bool has_paths(const RankingRow& row);

/// Words of the warning of a calibration whose records contradict its prediction.
inline constexpr const char* records_contradict = "the records contradict the prediction";
/// Returns whether a plan must not use the hours of a job with this warning, by its kind or because of such a calibration.
bool spoils_plan(const Warning& warning);

/// Returns the kinds of the warnings: "bend radius, program x3"; empty: none, or not known. with_other_values: also those of limits
/// at other values, which the job's own values keep.
std::string warning_kinds(const RankingRow& row, bool with_other_values = false);

/// Returns "doubtful input (KEY)": a plan may use the hours once a person has confirmed it. Empty: there is none.
std::string doubtful_input(const RankingRow& row);

/// Returns every warning of finished jobs with its job, one per line. For more than a dozen, and for limits at other values: one
/// warning of each kind, of the last row that has it, the number of jobs, and the files with the other warnings. Empty: none.
std::string warning_lines(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
