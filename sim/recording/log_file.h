// A log of joint angles as it is exported: a text of rows with a separator, of any length and rate.
//
// Separator: the first of ; tab , | blank that the line of names has. Decimal commas are read unless the separator is
// a comma. Rows with a missing number, and names that stand again between the rows, are left out and counted. Rows of
// one stamp: equal ones count once, others are spread evenly until the next stamp (a clock of whole seconds). Stamps
// that go back start again.
//
// Rows that no axis can reach are left out (log_steps.h).
//
// Standstill costs nothing: rows that stay within `still` of the first of them for half a second become two equal rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"
#include "sim/recording/log_steps.h"

namespace dresslife::sim {

struct LogOptions {
  std::string joints{};  ///< names of columns, separated by commas; empty: log_columns.h
  std::string unit{};    ///< deg or rad; empty: the names say, or angles too large for rad
  double rate = 0;       ///< of a log without times [1/s]; 0: it has times
  double still = 0;      ///< no larger motion is noise [rad]
};

/// Rows of a log, those of a standstill left out.
struct Recording {
  std::size_t axes = 0;
  std::vector<AxisOfLog> columns;  ///< (axis)
  std::string format;              ///< words: separator, times, unit of the angles
  std::vector<std::string> external;  ///< titles of columns that look like further axes than the robot's
  ImpossibleRows impossible;
  std::vector<double> times;         ///< (row) [s], increasing, from 0
  std::vector<double> angles;        ///< (row, axis) [rad]
  std::vector<std::uint32_t> lines;  ///< (row) of the file
  double interval = 0;               ///< median between rows as recorded [s]
  std::size_t rows = 0;              ///< as recorded
  std::size_t left_out = 0;          ///< without all numbers
  std::size_t same_stamp = 0;        ///< with the stamp of the row before
  std::size_t back = 0;              ///< whose stamp lies before that of the row before
  int first_left_out = 0;            ///< line
  int first_back = 0;                ///< line
  int pauses = 0;                    ///< without rows, longer than a hundred intervals and 10 s
  double pause_seconds = 0, longest_pause = 0;
  int line_of_pause = 0;             ///< behind the longest one

  std::size_t size() const { return times.size(); }
  const double* at(std::size_t row) const { return &angles[row * axes]; }
};

/// Size and length of a log, estimated from its first 64 kB.
struct LogSize {
  double megabytes = 0, rows = 0, seconds = 0;  ///< seconds: 0 if the first rows have no times
};
/// Errors: InputError as read_log() for another kind of file and for names of columns.
LogSize size_of_log(const std::filesystem::path& file, const pipeline::Robot& robot,
                    const LogOptions& options);

/// progress: called with the share that is read. Errors: InputError: another kind of file (it names a converter), names
/// of columns, angles without a unit, times that are none or more than 2 s apart, a row outside the robot's limits that
/// is no glitch (L3), more than a hundredth of the rows without numbers or back in time.
Recording read_log(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options,
                   const std::function<void(double)>& progress = {});

}  // namespace dresslife::sim
