// Duties: the programs of one dresspack in its hours of operation, and how often each of them runs.
//
//   study: two_robots                    the jobs: a study by name, or its file
//   duties:
//     - name: day
//       hours_per_week: 80
//       programs:
//         - {job: spot_robot_1, repeats_per_hour: 12}
//         - {job: hard, percent_of_time: 5, deviation_percent: 10}
//       order:
//         - {job: spot_robot_1, repeats: 20}   20 times in a row
//         - {job: hard, repeats: 1}            once; then the round begins again. Or batch_size: 20 and 1 in the programs
//       history:
//         - {duty: night, hours: 2000}   earlier hours of the dresspack
//         - {duty: day, from: 2026-01-05, to: 2026-06-30}   earlier hours by dates, both days included
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/days.h"
#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

class Fields;
struct KeyRow;

/// How often one program runs. Exactly one of the optional numbers is given.
struct DutyProgram {
  Where where;
  std::string job;
  std::optional<double> repeats_per_hour, repeats_per_shift, percent_of_time, percent_of_repeats;
  /// standard deviation of the number of repeats between dresspacks; constant for the life of a dresspack
  double deviation_percent = 0;
  /// name of a recording: programs with the same name are one cycle of its log; empty: a separate cycle
  std::string recording_of;
  int batch_size =
      0;  ///< repeats before the next program begins: read_duties() converts them to an order; 0: not given

  /// Returns the repeats in an hour of operation. repeat_seconds: duration of its motion.
  double rate(double repeat_seconds, double shift_hours, std::optional<double> all_repeats_per_hour) const;
};

/// Hours under a duty in the past, given as a number or by dates.
struct PastDuty {
  Where where;
  std::string duty, from, to;   ///< dates as written in the file; empty: hours are given
  std::optional<double> hours;  ///< hours of operation; read_duties() converts days by the duty's hours per week

  /// Returns the first and the last day, both included. Errors: InputError for text that is no date, for dates in reverse order,
  /// or after `today`.
  std::array<Day, 2> days(Day today) const;
};

/// Consecutive repeats of one program in the order of a duty.
struct OrderedProgram {
  Where where;
  std::string job;
  int repeats = 1;
};

struct Duty {
  Where where;
  std::string name;
  double hours_per_week = 80;              ///< hours of operation: motion, pauses, waits
  double shift_hours = 8;                  ///< length of a shift for repeats_per_shift
  std::optional<double> repeats_per_hour;  ///< repeats of all programs together, for percent_of_repeats
  std::vector<DutyProgram> programs;
  std::vector<OrderedProgram> order;  ///< order of a round; empty: changes between programs are not counted
  std::vector<PastDuty> history;
};

struct DutyFile {
  Where where;
  std::string study;
  std::vector<Duty> duties;
};

/// Reads a file of duties. Errors: InputError with all problems: unknown keys; a program without a number or with several; two
/// duties of one name; batch sizes together with an order, or for only one program; a history with an unknown duty or with dates
/// that overlap.
DutyFile read_duties(const std::filesystem::path& file, Day today = dresslife::pipeline::today());

/// Returns the duty of this name. Errors: InputError at `named_at`.
const Duty& duty_named(const DutyFile& file, const std::string& name, const Where& named_at);

/// Returns the keys of a file of duties.
std::vector<KeyRow> duty_keys();

}  // namespace dresslife::pipeline
