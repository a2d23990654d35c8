// The ways in which a dresspack fails, a line each: the wires, whose law is validated, and the modes whose law no test confirms. For the
// terminal and the pages.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// One mode in words.
struct ModeLine {
  std::string mode;                  ///< "wires of signal cable 7", "abrasion* on link_4"; *: the headline leaves it out
  std::array<std::string, 3> hours;  ///< by then 10, 50, 90 % of such dresspacks have failed by it; beyond the robot's life "over 40,000"
  std::string before_wires;          ///< "57 %": of the samples in which it comes before the wires; of the wires empty
  std::string with_it;               ///< 'replace after' if this mode counted, too
  std::string from_tool;             ///< "0.40": its place [m]; empty: not known
  std::string time;                  ///< "23.1": when it is loaded most [s]; empty: not known
  std::string step;                  ///< the program line that runs then; empty: none
  std::string note;                  ///< further sentences; empty: none
  bool early = false;                ///< 1 of 10 fails by it within the robot's life
};

/// The wires first. Empty: the row has no percentiles and no other mode.
std::vector<ModeLine> mode_lines(const RankingRow& row);

/// The same as a table with its legend, and the notes of early modes below it. Lines of at most width columns, each begun with indent.
/// Empty: no lines.
/// What "none" and "-" mean, where a line has them; begins with a space.
std::string cell_legend(const std::vector<ModeLine>& lines);

std::string mode_table(const RankingRow& row, std::size_t width, const std::string& indent);

}  // namespace dresslife::pipeline
