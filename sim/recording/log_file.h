// An exported log of joint angles: a text of rows with a separator, of any length and rate.
//
// Separator: the first of ; tab , | blank that occurs in the line of names. Decimal commas are read unless the separator is
// a comma. Rows with a missing number, and repeated lines of names, are left out and counted. Rows with
// the same time stamp: equal rows count once, others are spread evenly until the next stamp (a clock with whole seconds). Stamps
// that go back begin a new sequence.
//
// Rows that no axis can reach are left out (log_steps.h).
//
// A standstill is shortened: rows that stay within `still` of its first row for half a second become two equal rows.
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
  std::string joints{};  ///< names of columns, separated by commas; empty: as log_columns.h
  std::string unit{};    ///< deg or rad; empty: by the names, or degrees if the angles are too large for radians
  double rate = 0;       ///< rate of a log without times [1/s]; 0: the log has times
  double still = 0;      ///< smaller motions are noise [rad]
};

/// Rows of a log, without those of standstills.
struct Recording {
  std::size_t axes = 0;
  std::vector<AxisOfLog> columns;     ///< (axis)
  std::string format;                 ///< description: separator, times, unit of the angles
  std::vector<std::string> external;  ///< titles of columns that seem to be axes beyond those of the robot
  ImpossibleRows impossible;
  std::vector<double> times;         ///< (row) [s], increasing, from 0
  std::vector<double> angles;        ///< (row, axis) [rad]
  std::vector<std::uint32_t> lines;  ///< (row) line of the file
  double interval = 0;               ///< median interval of the recorded rows [s]
  std::size_t rows = 0;              ///< number of recorded rows
  std::size_t left_out = 0;          ///< number of rows without all numbers
  std::size_t same_stamp = 0;        ///< number of rows with the stamp of the previous row
  std::size_t back = 0;              ///< number of rows with a stamp before that of the previous row
  int first_left_out = 0;            ///< line of the first row without all numbers
  int first_back = 0;                ///< line of the first row with a stamp back in time
  int pauses = 0;                    ///< number of pauses without rows, longer than a hundred intervals and 10 s
  double pause_seconds = 0, longest_pause = 0;
  int line_of_pause = 0;  ///< line after the longest pause

  std::size_t size() const { return times.size(); }
  const double* at(std::size_t row) const { return &angles[row * axes]; }
};

/// Size and length of a log, estimated from its first 64 kB.
struct LogSize {
  double megabytes = 0, rows = 0, seconds = 0;  ///< seconds: 0 if the first rows have no times
};
/// Returns the estimated size. Errors: InputError as read_log() for another kind of file and for names of columns.
LogSize size_of_log(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options);

/// Reads a log. progress: called with the share that is read. Errors: InputError: another kind of file (it names a converter),
/// names of columns, angles without a unit, invalid times or times more than 2 s apart, a row outside the robot's limits that
/// is no glitch (L3), an angle that wraps at a turn, more than a hundredth of the rows without numbers or back in time.
Recording read_log(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options,
                   const std::function<void(double)>& progress = {});

}  // namespace dresslife::sim
