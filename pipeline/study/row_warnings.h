// What the stages of a study's jobs warned of, as lines.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Warnings of a row, and that of its forces where an older file does not tell any.
std::vector<Warning> warnings_of(const RankingRow& row);

/// "bend radius, program x3"; empty: nothing is warned of, or it is not known.
std::string warning_kinds(const RankingRow& row);

/// Every warning in full, with the job that it is of, a line each: of more than a dozen the first of each
/// kind, how many jobs have one, and where the others stand. Empty without any.
std::string warning_lines(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
