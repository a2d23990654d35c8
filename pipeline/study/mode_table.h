// Table of the failure modes of a dresspack, one mode per line, for the terminal and the pages: the wires, whose law is
// validated, and the modes whose law no test confirms.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/study/ranking.h"

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

/// One mode in words.
struct ModeLine {
  std::string mode;  ///< "wires of signal cable 7", "abrasion* on link_4"; *: not included in the headline
  /// hours by which 10, 50, 90 % have failed by this mode; "over 40,000" beyond the robot's life
  std::array<std::string, 3> hours;
  /// "57 %", below 1 % "0.5 %": share of the samples in which the mode comes before the wires; empty for the wires
  std::string before_wires;
  std::string with_it;    ///< 'replace after' if this mode were included
  std::string from_tool;  ///< "0.40": place of the mode, from the tool clamp [m]; empty: not known
  std::string time;       ///< "23.1": time of its largest load [s]; empty: not known
  std::string step;       ///< program line that runs at `time`; empty: none
  std::string note;       ///< further sentences; empty: none
  bool early = false;     ///< whether 1 of 10 fails by this mode before replacement_hours()
};

/// Returns one line per mode, the wires first. Empty: the row has no percentiles and no other mode.
std::vector<ModeLine> mode_lines(const RankingRow& row);

/// Returns the meaning of "none" and "-" if a line has such a cell; begins with a space.
std::string cell_legend(const std::vector<ModeLine>& lines);

/// Returns the lines as a table, and below it the notes of early modes. Each line begins with `indent` and has at most `width`
/// columns. Empty: no modes.
std::string mode_table(const RankingRow& row, std::size_t width, const std::string& indent);
/// Returns the meaning of the words in the tables of these rows. Empty: they have no tables.
std::string mode_legend(const std::vector<RankingRow>& rows, std::size_t width, const std::string& indent);

}  // namespace dresslife::pipeline
