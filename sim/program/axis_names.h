// Names of recorded columns and of a trajectory's joints: their quantity, unit and axis of the robot (rules in
// trajectory.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dresslife::sim {

struct ColumnName {
  enum class Kind { axis, time, point, other } kind = Kind::axis;
  enum class Unit { unknown, degrees, radians } unit = Unit::unknown;
  double seconds = 1;      ///< of a time's unit
  bool unit_told = false;  ///< the name contains the unit of a time
};

/// Runs of letters and runs of digits, in lower case: "Joint_1 [deg]" -> joint, 1, deg.
std::vector<std::string> words_of_name(std::string_view name);

ColumnName column_name(std::string_view name);

/// Seconds of the unit in which a clock shows this time since 1970: a time of this century has 10 digits in
/// s, 13 in ms, 16 in us, 19 in ns. Smaller ones count from a recording's begin, in s.
double unit_of_clock(double time);

/// Positions of the names in the order of the robot's axes: order[0] is the position of axis 1. Absent:
/// the names do not determine it. wanted: the user's order, names separated by commas; empty: none.
std::optional<std::vector<std::size_t>> order_of_axes(const std::vector<std::string>& names,
                                                      const std::string& wanted);

}  // namespace dresslife::sim
