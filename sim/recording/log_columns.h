// Selects the columns of a log that contain the time and the angles of the robot's axes.
//
// Columns whose names differ only in a number are a group: actual_q_0 .. actual_q_5, J1 .. J6, "Axis 1 [deg]". The
// angles are a group with as many columns as the robot has axes. Of several groups the one whose words most clearly mean measured
// positions is used: `actual` counts more than `position`, and `target` or a word of another quantity counts less. Without such a
// group the names of a known arm are used (axis_names.h). Sources of names: Universal Robots' RTDE recorder (timestamp,
// actual_q_0, ..), rostopic echo -p (%time, field.name0, field.position0, ..), loggers for ABB (timestamp, cmd_num,
// J1, ..) and for RTDE (pc_ts, q_0, qd_0, ..) in public repositories.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/csv_rows.h"

namespace dresslife::sim {

struct LogColumns {
  std::vector<std::size_t> axes;   ///< columns, in the order of the robot's axes
  std::vector<std::size_t> names;  ///< columns of the joints' names in the same order; empty: the log contains none
  std::optional<std::size_t> date, time;
  std::optional<double> seconds;  ///< seconds per unit of time, from the column's name; absent: the name gives no unit
  std::optional<double>
      radians;  ///< radians per unit of angle, from the columns' names; absent: the names give no unit
};

/// Returns the columns. joints: the user's names in the order of the axes, separated by commas; empty: none.
/// Errors: InputError with the existing names.
LogColumns log_columns(const pipeline::CsvReader& log, const pipeline::CsvRow& titles, std::size_t axes,
                       const std::string& joints);

}  // namespace dresslife::sim
