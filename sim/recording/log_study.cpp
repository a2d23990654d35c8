#include "sim/recording/log_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "pipeline/base/readable.h"

namespace dresslife::sim {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
// Processor seconds and size of files per second of motion, with the samples of the uncertainty. Measured on a day's log with 40
// motions, 730 s together (ten loose cables, 64 segments): 1,400 s and 930 MB. A hose with three cables took a quarter.
constexpr double seconds_per_second = 2;
constexpr double megabytes_per_second = 1.3;
constexpr double reading_per_row = 8e-6;  // [s] of one core: a day at 10 Hz in 5.8 s, 8 h in 2.2 s

std::string time_words(double seconds) {
  constexpr double minute = 60, hour = 3600;
  if (seconds < 2 * minute) return fmt::format("{:.3g} s", seconds);
  return seconds < 2 * hour ? fmt::format("{:.3g} min", seconds / minute) : fmt::format("{:.3g} h", seconds / hour);
}

/// Returns the duration of all motions together, each counted once.
double seconds_of(const std::vector<LogMotion>& motions) {
  double seconds = 0;
  for (const LogMotion& motion : motions) seconds += motion.duration();
  return seconds;
}

/// Returns the duration of all motions with their occurrences in the log.
double occupied_seconds(const std::vector<LogMotion>& motions) {
  double seconds = 0;
  for (const LogMotion& motion : motions) seconds += static_cast<double>(motion.count) * motion.duration();
  return seconds;
}

}  // namespace

std::string study_text(const std::string& name, const std::filesystem::path& base, const Recording& log,
                       const std::vector<std::string>& mounting, const std::vector<LogMotion>& motions) {
  std::string pose, poses;
  for (std::size_t i = 0; i < log.axes; ++i) pose += fmt::format("{}{:.3f}", i > 0 ? ", " : "", log.at(0)[i] * degrees);
  for (const std::string& key : mounting) poses += fmt::format(", {}: [{}]", key, pose);
  std::string text = fmt::format(
      "# The motions of a log: cycles that repeat, and the rest.\nname: {}\nbase: {}\nkeep: histories\njobs:\n", name,
      base.string());
  for (const LogMotion& motion : motions)
    text += fmt::format("  {0}: {{motion: {{program: {0}.csv, rows: spline}}{1}}}\n", motion.name, poses);
  return text;
}

std::string duty_text(const std::string& name, const std::string& study, const Course& course,
                      const std::vector<LogMotion>& motions) {
  // the numbers have six digits
  const double seconds = std::max(occupied_seconds(motions) * (1 + 1e-5), course.log_seconds);
  std::string text = fmt::format(
      "# hours_per_week: of hours as in the log, with standstill and without gaps in which the robot moved ({}).\n"
      "study: {}\nduties:\n  - name: {}\n    hours_per_week: 80\n    programs:\n",
      time_words(course.log_seconds), study, name);
  for (const LogMotion& motion : motions)
    text += fmt::format("      - {{job: {}, repeats_per_hour: {:.6g}{}}}\n", motion.name,
                        static_cast<double>(motion.count) * 3600 / seconds,
                        motion.recording_of.empty() ? "" : ", recording_of: " + motion.recording_of);
  return text;
}

std::string estimate_words(const std::filesystem::path& file, const LogSize& size) {
  std::string text = fmt::format("{}: {:.2g} MB, about {} rows", file.filename().string(), size.megabytes,
                                 pipeline::readable(size.rows, 2));
  if (size.seconds > 0) text += fmt::format(" in {}", time_words(size.seconds));
  text += fmt::format(". Reading takes about {}", time_words(std::ceil(size.rows * reading_per_row)));
  if (size.seconds > 0)
    text += fmt::format("; the study at most {} of one core and {} MB, if no cycle repeats and the robot never stops",
                        time_words(size.seconds * seconds_per_second),
                        pipeline::readable(size.seconds * megabytes_per_second, 2));
  return text;
}

namespace {

/// Returns a warning for angles that are probably radians under names in degrees; empty: they are not.
std::string radians_words(const Recording& log) {
  constexpr double turn = 2 * std::numbers::pi,
                   moves = 0.1;  // [deg]: a full turn in radians; a smaller range means that the robot stands still
  double largest = 0, way = 0;
  for (const AxisOfLog& of : log.columns) {
    largest = std::max({largest, std::abs(of.low) * degrees, std::abs(of.high) * degrees});
    way = std::max(way, (of.high - of.low) * degrees);
  }
  if (largest > turn || way <= moves) return "";
  return fmt::format(
      "warning: no angle of the log is larger than {:.3g} deg (limit {:.3g} or more): they may be radians under names in "
      "degrees. Give --value unit=rad then",
      largest, turn);
}

/// Returns a warning for times that are probably in another unit than their name; empty: they are not.
std::string times_words(const Recording& log, const Course& course) {
  constexpr double far_beyond = 10;  // ratio to the limits: rounded or late rows give a smaller ratio
  // A move of 10 deg at a hundredth of an axis's speed takes 6 s: even at the speed for teaching robots are faster. Milliseconds
  // as seconds give at most a thousandth.
  constexpr double far_below = 0.01, move = 10 / degrees;
  double ratio = 0, way = 0;
  for (std::size_t i = 0; i < std::min(course.fastest.size(), log.columns.size()); ++i) {
    ratio = std::max(ratio, course.fastest[i] / log.columns[i].axis.speed);
    way = std::max(way, log.columns[i].high - log.columns[i].low);
  }
  const bool is_slow = ratio < far_below && way > move;
  if (!(ratio > far_beyond || is_slow) || !(log.interval > 0)) return "";
  std::string text =
      is_slow
          ? fmt::format("warning: by the times of the log no axis turns faster than {:.2g} % of its limit", 100 * ratio)
          : fmt::format("warning: by the times of the log an axis turns {:.0f} times as fast as it can", ratio);
  text += ": they may be in another unit or another rate.";
  for (const double factor : {60.0, 1e3, 1e6, 1e9, 1e-3})
    if (ratio / factor < 1.2 && ratio / factor > 0.02)
      return text + fmt::format(" Give --value rate_Hz={:.4g} if they are {:g} times as long: a row in {:.3g} s",
                                1 / (factor * log.interval), factor, factor * log.interval);
  return text + " Give --value rate_Hz=N with the rows per second";
}

/// Returns a warning for rows that are too far apart for the moves of the axes; empty: they are not.
///
/// A move turns an axis one way, from a rest or a reversal to the next. A cycle of moves of 1 s (irb6640, hose of 48 mm) had p10 of
/// 6.2 h with rows 0.05 s apart, 5.8 h with two rows per move, and 11 and 17 h with one row and with half a row: a course through
/// so few rows is too slow. A rest begins or ends between two rows, so it counts as half an interval less. In simulated logs
/// with noise, jitter, rests, and rows only on change, these shares of the angles belonged to moves of fewer than two
/// intervals: 0.2 to 1 at one interval per move (least with rests of 0.7 intervals, which look like motion), 0 to 0.5 at two, 0 to
/// 0.03 at three.
std::string spacing_words(const Recording& log) {
  constexpr double fine = 0.12;           // [s] about ten rows per second: shorter moves are small
  constexpr double rest = 0.5 / degrees;  // [rad] of a step: noise
  constexpr double least = 5 / degrees;   // [rad] of a move that matters
  constexpr double pause = 2.5;           // intervals: a log of changes has no rows of a rest
  constexpr double enough = 2, share = 0.2;
  double way = 0, short_way = 0;
  int moves = 0, short_moves = 0;
  const std::size_t steps = log.size() > 0 && log.interval > fine ? log.size() - 1 : 0;
  for (std::size_t axis = 0; axis < log.axes; ++axis) {
    const auto step = [&](std::size_t k) { return log.at(k + 1)[axis] - log.at(k)[axis]; };
    const auto rests = [&](std::size_t k) { return k >= steps || std::abs(step(k)) <= rest; };
    const auto pauses = [&](std::size_t k) { return log.times[k + 1] - log.times[k] > pause * log.interval; };
    for (std::size_t k = 0, end; k < steps; k = end) {
      end = k + 1;
      if (rests(k)) continue;
      while (!rests(end) && !pauses(end) && step(end) * step(k) > 0) ++end;
      const double turned = std::abs(log.at(end)[axis] - log.at(k)[axis]);
      if (turned < least) continue;
      const int ends = (k == 0 || rests(k - 1) || pauses(k)) + (rests(end) || pauses(end));
      const bool is_short = static_cast<double>(end - k) - 0.5 * ends < enough;
      ++moves, short_moves += is_short;
      way += turned, short_way += is_short ? turned : 0;
    }
  }
  if (short_way <= share * way) return "";
  return fmt::format(
      "warning: rows are {:.3g} s apart, and {} of {} moves of the axes ({:.0f} % of their angles) last less than {:g} such "
      "intervals: the speeds that are read are too low, and lives become too long. Log 10 rows per second or more, or import the "
      "robot's program",
      log.interval, short_moves, moves, 100 * short_way / way, enough);
}

}  // namespace

std::vector<std::string> read_words(const Recording& log, const Course& course) {
  std::vector<std::string> lines{"Read: " + log.format};
  std::size_t name = 4, column = 6;
  for (const AxisOfLog& of : log.columns)
    name = std::max(name, of.axis.name.size()), column = std::max(column, pipeline::columns_of(of.column));
  const auto add = [&](const std::string& axis, const std::string& of, const std::string& range,
                       const std::string& limits, const std::string& speed, const std::string& limit) {
    lines.push_back(fmt::format("{:<{}}  {}{}  {:>17}  {:>14}  {:>15}  {:>13}", axis, name, of,
                                std::string(column - pipeline::columns_of(of), ' '), range, limits, speed, limit));
  };
  const auto tenths = [](double angle) { return std::round(10 * angle * degrees) / 10 + 0.; };  // + 0. avoids -0.0
  add("axis", "column", "range [deg]", "limits [deg]", "fastest [deg/s]", "limit [deg/s]");
  for (std::size_t i = 0; i < log.columns.size(); ++i) {
    const AxisOfLog& of = log.columns[i];
    add(of.axis.name, of.column, fmt::format("{:.1f} .. {:.1f}", tenths(of.low), tenths(of.high)),
        fmt::format("{:.4g} .. {:.4g}", of.axis.lower * degrees, of.axis.upper * degrees),
        fmt::format("{:.3g}", course.fastest[i] * degrees), fmt::format("{:.4g}", of.axis.speed * degrees));
  }
  if (const std::string order = order_words(log.columns, course.fastest); !order.empty())
    lines.push_back("warning: " + order);
  if (!log.external.empty())
    lines.push_back(fmt::format(
        "warning: left out, because the robot of the job has no such axes: {}. If they carry the robot, describe them as robot.external_axes",
        fmt::join(log.external, ", ")));
  for (std::string words : {radians_words(log), times_words(log, course), spacing_words(log)})
    if (!words.empty()) lines.push_back(std::move(words));
  return lines;
}

std::vector<std::string> log_words(const Recording& log, const Course& course, const Cycles& cycles,
                                   const std::vector<LogMotion>& motions) {
  std::vector<std::string> lines{fmt::format("{} rows, {:.3g} per second, {}; the robot stands still in {} of it",
                                             log.rows, 1 / log.interval, time_words(course.log_seconds),
                                             time_words(course.stand_seconds))};
  if (log.left_out > 0)
    lines.push_back(
        fmt::format("{} rows left out, first line {}: numbers are missing", log.left_out, log.first_left_out));
  if (log.same_stamp > 0)
    lines.push_back(
        fmt::format("{} rows with the time of the row before: equal ones left out, others spread", log.same_stamp));
  if (log.back > 0)
    lines.push_back(
        fmt::format("{} rows with an earlier time than the row before, first line {}: time continues from there",
                    log.back, log.first_back));
  const auto lines_text = [](const std::vector<std::uint32_t>& of) {
    constexpr std::size_t most = 5;
    const auto shown = std::span(of).first(std::min(of.size(), most));
    return fmt::format("line{} {}{}", of.size() == 1 ? "" : "s", fmt::join(shown, ", "), of.size() > most ? " .." : "");
  };
  if (const auto& glitches = log.impossible.glitches; !glitches.empty())
    lines.push_back(fmt::format("warning: {} row{} left out, because no axis can get there and back in time: {}",
                                glitches.size(), glitches.size() == 1 ? "" : "s", lines_text(glitches)));
  if (const auto& jumps = log.impossible.jumps; !jumps.empty())
    lines.push_back(fmt::format(
        "warning: {} row{} that no axis could reach stay{} in the motion: {}. Correct the log, or cut it there",
        jumps.size(), jumps.size() == 1 ? "" : "s", jumps.size() == 1 ? "s" : "", lines_text(jumps)));
  if (log.pauses > 0)
    lines.push_back(fmt::format(
        "warning: {} pause{} without rows, {} together, the longest {} before line {}: standing where the robot keeps its "
        "pose, else no time of the log. If the logger was off or a time is wrong, the rates are too low: cut the log there",
        log.pauses, log.pauses == 1 ? "" : "s", time_words(log.pause_seconds), time_words(log.longest_pause),
        log.line_of_pause));
  if (course.gaps > 0)
    lines.push_back(fmt::format("{} gap{} in which the robot moved, {} together, {} not counted", course.gaps,
                                course.gaps == 1 ? "" : "s", time_words(course.gap_seconds),
                                course.gaps == 1 ? "is" : "are"));
  lines.push_back(fmt::format("smoothed by at most {:.2g} deg", course.largest_smoothing * degrees));
  for (const TooFast& fast : course.too_fast)
    lines.push_back(fmt::format(
        "warning: {} turns {:.4g} deg/s in line {} (its limit is {:.4g} deg/s, it is faster at {} moments): "
        "check the times of the log and the robot of the job",
        fast.axis, fast.speed * degrees, fast.line, fast.limit * degrees, fast.knots));
  double rest = 0;
  std::size_t rests = 0;
  for (const LogMotion& motion : motions) {
    if (motion.is_rest) {
      rest += motion.duration();
      ++rests;
      continue;
    }
    lines.push_back(fmt::format("{}: {} times {:.3g} s, up to {:.2g} deg apart, as from line {}", motion.name,
                                motion.count, motion.duration(), motion.difference * degrees,
                                course.line(cycles.parts[motion.part].begin)));
  }
  lines.push_back(rests == 0 ? "no rest"
                             : fmt::format("rest without repeats: {} motion{}, {}", rests, rests == 1 ? "" : "s",
                                           time_words(rest)));
  constexpr double little = 1.01;
  if (const double longer = occupied_seconds(motions); longer > little * course.log_seconds)
    lines.push_back(fmt::format(
        "warning: the motions of the study take {}, the log takes {}: cycles without a standstill get a stop, and gaps a move. "
        "Divide the hours of dresslife duty by {:.3g}",
        time_words(longer), time_words(course.log_seconds), longer / course.log_seconds));
  const double all = seconds_of(motions);
  lines.push_back(fmt::format(
      "estimate for dresslife duty: {} of one core, {} MB. The dresspack changes this by factors; dresslife duty shows the remaining time",
      time_words(all * seconds_per_second), pipeline::readable(all * megabytes_per_second, 2)));
  return lines;
}

}  // namespace dresslife::sim
