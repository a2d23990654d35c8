// The rows of a long ranking that the terminal shows. ranking.csv and the report contain all.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

struct ShownRows {
  std::vector<std::size_t> indices;  ///< rising; all of a short ranking
  std::string summary;               ///< one line on the rest, with a line feed; empty: nothing is left out
};

/// Of a long ranking: the best, the worst, the first failed jobs and the first with warnings. rows: best first, failed
/// last.
ShownRows shown_rows(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
