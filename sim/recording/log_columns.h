// Which columns of a log hold the time and the angles of the robot's axes.
//
// Columns whose names differ only in a number are a group: actual_q_0 .. actual_q_5, J1 .. J6, "Axis 1 [deg]". The
// angles are the group with as many columns as the robot has axes whose words say most of measured positions:
// `actual` counts more than `position`, and `target` or a word of another quantity less. Without such a group the
// names of a known arm count (axis_names.h). Sources of names: Universal Robots' RTDE recorder (timestamp,
// actual_q_0, ..), rostopic echo -p (%time, field.name0, field.position0, ..), loggers for ABB (timestamp, cmd_num,
// J1, ..) and for RTDE (pc_ts, q_0, qd_0, ..) in public repositories.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/csv_rows.h"

namespace dresslife::sim {

struct LogColumns {
  std::vector<std::size_t> axes;  ///< columns, in the order of the robot's axes
  std::vector<std::size_t>
      names;  ///< columns of the joints' names in the same order; empty: the log has none
  std::optional<std::size_t> date, time;
  std::optional<double> seconds;  ///< of a unit of time, as its name says; absent: it does not
  std::optional<double> radians;  ///< of a unit of angle, as the names say; absent: they do not
};

/// joints: the user's names in the order of the axes, separated by commas; empty: none.
/// Errors: InputError with the names that are there.
LogColumns log_columns(const pipeline::CsvReader& log, const pipeline::CsvRow& titles, std::size_t axes,
                       const std::string& joints);

}  // namespace dresslife::sim
