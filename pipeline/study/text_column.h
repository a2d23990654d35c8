// A column of a table on the terminal, as wide as its widest cell.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"

namespace dresslife::pipeline {

struct Column {
  std::string title;
  bool to_the_right = false;
  std::vector<std::string> cells;

  std::size_t width() const { return largest_of(cells, columns_of(title), columns_of); }
  std::string padded(const std::string& cell) const {
    const std::string space(width() - columns_of(cell), ' ');
    return to_the_right ? space + cell : cell + space;
  }
};

/// Returns a line of a table, which ends with a line feed. cell_of: returns the cell of a column.
template <class Columns, class CellOf>
std::string table_line(const Columns& columns, const CellOf& cell_of) {
  std::string text;
  for (const Column& column : columns) text += column.padded(cell_of(column)) + "  ";
  return text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
}

}  // namespace dresslife::pipeline
