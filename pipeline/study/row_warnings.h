// Warnings of a study's jobs as text.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Warnings of a row. Of an older file without warnings: the one of its forces.
std::vector<Warning> warnings_of(const RankingRow& row);

/// "bend radius, program x3"; empty: none, or not known.
std::string warning_kinds(const RankingRow& row);

/// Every warning with its job, a line each. Of more than a dozen: the first of each kind, the number of jobs, and the
/// file with the others. Empty: none.
std::string warning_lines(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
