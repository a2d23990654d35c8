// The rows of a long ranking that the terminal shows. ranking.csv and the report contain all rows.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

struct ShownRows {
  std::vector<std::size_t> indices;  ///< rising; of a short ranking all rows
  std::string summary;               ///< one line about the other rows, with a line feed; empty: all rows are shown
};

/// Selects from a long ranking the best jobs, the worst jobs, the first failed jobs and the first jobs with warnings. rows: best
/// first, failed last.
ShownRows shown_rows(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
