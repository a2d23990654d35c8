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
  double seconds = 1;      ///< unit of a time [s]
  bool unit_told = false;  ///< the name contains the unit of a time
};

/// Splits a name into its sequences of letters and of digits, in lower case: "Joint_1 [deg]" -> joint, 1, deg.
std::vector<std::string> words_of_name(std::string_view name);

/// Returns what the columns of a table are. T is a time, except as the sixth of Yaskawa's axes S, L, U, R, B, T.
std::vector<ColumnName> column_names(const std::vector<std::string>& names);

/// Returns the unit of a clock's time since 1970 [s]: a time of this century has 10 digits in s, 13 in ms, 16 in us,
/// 19 in ns. Smaller numbers are seconds since the begin of a recording.
double unit_of_clock(double time);

/// Returns the indices of the names in the order of the robot's axes: order[0] is the index of axis 1. std::nullopt:
/// the names do not determine the order. wanted: the user's order, names separated by commas; empty: none.
std::optional<std::vector<std::size_t>> order_of_axes(const std::vector<std::string>& names, const std::string& wanted);

}  // namespace dresslife::sim
