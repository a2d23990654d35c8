// The columns of ranking.csv: one table that gives the header, the cells and the manual page.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

struct RankingColumn {
  std::string name, unit;  ///< unit: "h", "m", "1", "text", "yes or no"
  std::string meaning;
  std::function<std::string(const RankingRow&)>
      cell;  ///< returns the cell of a row with a result; empty: unknown or not applicable
  /// Returns the cell of any row.
  std::string text(const RankingRow& row) const;
  bool has_numbers() const { return unit != "text" && unit != "yes or no"; }
};

/// Returns the columns in the order of the file. New columns are added at the end; other programs read columns by name.
const std::vector<RankingColumn>& ranking_columns();

/// Returns the table of columns as Markdown.
std::string ranking_manual();

}  // namespace dresslife::pipeline
