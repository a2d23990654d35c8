// Steps of a log that no axis can perform, and columns that fit other axes than their own.
//
// (L3) A row c between b and d, h1 after b and h2 before d, is possible if for every axis
//      |c - (h2 b + h1 d)/(h1 + h2)| <= min(a h1 h2, 2.2 v h1 h2/(h1 + h2)) + |d - b| min(h1, h2)/(2 (h1 + h2)) + 2 still.
//      a, v: acceleration and speed of the axis. A course with the constant acceleration a deviates by a h1 h2/2 from the line;
//      the catalogue's accelerations are medians, and stops have twice the acceleration. A course that reverses at full speed
//      deviates by 2 v h1 h2/(h1 + h2); the factor 1.1 is for the control of the drive. The third term is an error of time by
//      half an interval, the last term noise.
// A row that is not possible is a glitch and is left out, if its neighbours are possible without it and 1.2 v
// is enough from b to d. Otherwise it is a jump and is kept.
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

/// The column of a log for an axis.
struct AxisOfLog {
  Axis axis{};
  std::string column{};
  double low = 0, high = 0;  ///< range over all rows [rad]
};

/// Rows that no axis can reach, in the order of the log.
struct ImpossibleRows {
  std::vector<std::uint32_t> glitches, jumps;  ///< lines
};

/// Passes rows on, except glitches (L3).
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
  std::deque<LogRow> rows_;  // the last five rows
};

/// Returns the order of the columns in which each keeps the limits of its axis, with the fewest changes. Empty: the present order
/// keeps them, or no order does. fastest: largest speed of each column [rad/s]; empty: not compared.
std::vector<std::size_t> better_order(const std::vector<AxisOfLog>& axes, const std::vector<double>& fastest);

/// Returns "In the order J1, J3, J2 .. every column keeps the limits of its axis"; empty without a better order.
std::string order_words(const std::vector<AxisOfLog>& axes, const std::vector<double>& fastest);

}  // namespace dresslife::sim
