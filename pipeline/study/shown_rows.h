// Which rows of a long ranking a terminal shows: nobody reads ten thousand. All of them stand in ranking.csv
// and the report.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

struct ShownRows {
  std::vector<std::size_t> indices;  ///< rising; all of a short ranking
  std::string summary;  ///< one line on the rest that ends with a line feed; empty: nothing is left out
};

/// Of a long ranking the best, the worst, and the first that failed and that are warned of. rows: best first,
/// failed last.
ShownRows shown_rows(const std::vector<RankingRow>& rows);

}  // namespace dresslife::pipeline
