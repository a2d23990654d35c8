// Names of recorded columns and of a trajectory's joints: what they hold, in which unit, and which axis of
// the robot they are (trajectory.h says by which rules).
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
  bool unit_told = false;  ///< the unit of a time stands in the name
};

ColumnName column_name(std::string_view name);

/// Seconds of the unit in which a clock shows this time since 1970: a time of this century has 10 digits in
/// s, 13 in ms, 16 in us, 19 in ns. Smaller ones count from a recording's begin, in s.
double unit_of_clock(double time);

/// Positions of the names in the order of the robot's axes: order[0] is where axis 1 stands. Absent: the
/// names do not say. wanted: the user's order, names separated by commas; empty: none.
std::optional<std::vector<std::size_t>> order_of_axes(const std::vector<std::string>& names,
                                                      const std::string& wanted);

}  // namespace dresslife::sim
