// What robots do in their hours of operation: the programs of one dresspack, and how often each of them runs.
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
//         - {job: hard, repeats: 1}            once; then again the first. Or batch_size: 20 and 1 in the programs
//       history:
//         - {duty: night, hours: 2000}   what the dresspack has done before
//         - {duty: day, from: 2026-01-05, to: 2026-06-30}   the same by dates, both days included
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

/// How often one program runs; exactly one of the optional numbers is given.
struct DutyProgram {
  Where where;
  std::string job;
  std::optional<double> repeats_per_hour, repeats_per_shift, percent_of_time, percent_of_repeats;
  double deviation_percent = 0;  ///< standard deviation of its number of repeats, the same for the whole life of a dresspack
  std::string recording_of;  ///< programs with one name here are one cycle of a log; empty: a cycle of its own
  int batch_size = 0;  ///< repeats before the next program begins: read_duties() makes an order of them; 0: not given

  /// Repeats in an hour of operation. repeat_seconds: of its motion.
  double rate(double repeat_seconds, double shift_hours, std::optional<double> all_repeats_per_hour) const;
};

/// Hours under a duty in the past: a number, or days.
struct PastDuty {
  Where where;
  std::string duty, from, to;    ///< dates as they stand in the file; empty: hours are given
  std::optional<double> hours;  ///< of operation; read_duties() converts days by the duty's hours per week

  /// Of days in full, both included. Errors: InputError for what is no date, ends before it begins, or lies after `today`.
  std::array<Day, 2> days(Day today) const;
};

/// Repeats of one program in a row, in the order of a duty.
struct OrderedProgram {
  Where where;
  std::string job;
  int repeats = 1;
};

struct Duty {
  Where where;
  std::string name;
  double hours_per_week = 80;              ///< of operation: motion, pauses, waits
  double shift_hours = 8;                  ///< of repeats_per_shift
  std::optional<double> repeats_per_hour;  ///< of all programs together, of percent_of_repeats
  std::vector<DutyProgram> programs;
  std::vector<OrderedProgram> order;  ///< of a round; empty: changes between programs do not count
  std::vector<PastDuty> history;
};

struct DutyFile {
  Where where;
  std::string study;
  std::vector<Duty> duties;
};

/// Errors: InputError with all problems: unknown keys, a program without a number or with several, two duties of one
/// name, batch sizes beside an order or of one program only, a history that names no duty, or whose dates overlap.
DutyFile read_duties(const std::filesystem::path& file, Day today = dresslife::pipeline::today());

/// The duty of this name. Errors: InputError at `named_at`.
const Duty& duty_named(const DutyFile& file, const std::string& name, const Where& named_at);

/// The keys of a file of duties.
std::vector<KeyRow> duty_keys();

}  // namespace dresslife::pipeline
