// Steps of a log that no axis can make, and columns that fit other axes than their own.
//
// (L3) A row c between b and d, h1 after b and h2 before d, is possible if for every axis
//      |c - (h2 b + h1 d)/(h1 + h2)| <= min(a h1 h2, 2.2 v h1 h2/(h1 + h2)) + |d - b| min(h1, h2)/(2 (h1 + h2)) + 2 still.
//      a, v: acceleration and speed of the axis. A course with the constant acceleration a is a h1 h2/2 off the line; the
//      catalogue's accelerations are medians, and stops are twice as hard. A course that turns back at full speed is
//      2 v h1 h2/(h1 + h2) off; 1.1 for the control of the drive. The third term is a time that is half an interval wrong, the last
//      one noise.
// A row that is not possible is a glitch, and left out, if its neighbours are possible without it and 1.2 v
// is enough from b to d. Else it is a jump, and stays.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "sim/robot/robot.h"

namespace dresslife::sim {

struct LogRow {
  double time = 0;               ///< [s]
  std::vector<double> angles{};  ///< (axis) [rad]
  std::uint32_t line = 0;
};

/// What a log has for an axis.
struct AxisOfLog {
  Axis axis{};
  std::string column{};
  double low = 0, high = 0;  ///< of all rows [rad]
};

/// Rows that no axis gets to, in the order of the log.
struct ImpossibleRows {
  std::vector<std::uint32_t> glitches, jumps;  ///< lines
};

/// Passes rows on without glitches (L3).
class StepFilter {
 public:
  StepFilter(std::vector<Axis> axes, double still, std::function<void(LogRow)> pass_on)
      : axes_(std::move(axes)), still_(still), pass_on_(std::move(pass_on)) {}
  void add(LogRow row);
  void finish();

  ImpossibleRows found;

 private:
  bool is_reached(const LogRow& from, const LogRow& to) const;
  bool is_possible(const LogRow& before, const LogRow& row, const LogRow& after) const;

  std::vector<Axis> axes_;
  double still_;
  std::function<void(LogRow)> pass_on_;
  std::deque<LogRow> rows_;  // the last five
};

/// The order of the columns in which each keeps the limits of its axis, with the fewest columns at other axes than now.
/// Empty: the present order does, or none does. fastest: of each column [rad/s]; empty: not compared.
std::vector<std::size_t> better_order(const std::vector<AxisOfLog>& axes, const std::vector<double>& fastest);

/// "In the order J1, J3, J2 .. every column keeps the limits of its axis"; empty without a better order.
std::string order_words(const std::vector<AxisOfLog>& axes, const std::vector<double>& fastest);

}  // namespace dresslife::sim
