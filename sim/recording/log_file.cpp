#include "sim/recording/log_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/base/constants.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/lists.h"
#include "sim/program/axis_names.h"
#include "sim/recording/log_columns.h"
#include "sim/recording/log_time.h"
#include "sim/robot/robot.h"

namespace dresslife::sim {
namespace {

using pipeline::CsvCell;
using pipeline::CsvRow;
using pipeline::InputError;

constexpr double short_stand = 0.5;  // [s] shorter standstills keep their rows
constexpr double start = 0.05;  // [s] rows at the end of a standstill that are kept, because a slow start is no jump
// [s], [1]: waits of a process are shorter, and loggers skip only a few rows
constexpr double shortest_pause = 10, pause_intervals = 100;
constexpr double longest_interval = 2;            // [s]: a longer interval may hide a move of a robot
constexpr double coarsest_clock = 1;              // [s] of logs with times of day
constexpr double most_faults = 0.01;              // share of the rows: a larger share means another kind of file
constexpr std::size_t few_faults = 10;            // number that is allowed in a short log, too
constexpr std::size_t most_rows = 30'000'000;     // moving rows: 1.8 GB for six axes
constexpr std::size_t rows_of_interval = 20'000;  // number of rows whose median interval is used for the log
// [rad] Wrapped angles step by a turn, less or more by the way of the axis between the rows.
constexpr double least_wrap = 270 * degree, least_way_at_wrap = 10 * degree;
constexpr const char* unwrap =
    "unwrap the column: add 360 deg to it from that row on, or subtract them, so that it continues (numpy: unwrap(angles_deg, period=360))";
constexpr const char* separators = ";\t,| ";
constexpr std::size_t sample_bytes = 65'536;  // some hundred rows

/// Throws InputError for files that need a converter.
void refuse_other_kinds(const std::filesystem::path& file, const std::string& begin) {
  const std::string ending = file.extension().string();
  const auto refuse = [&](const char* what, const char* remedy) { throw InputError({file.string()}, what, remedy); };
  if (ending == ".bag" || begin.starts_with("#ROSBAG"))
    refuse("is a ROS bag", "convert it: rostopic echo -b FILE.bag -p /joint_states > log.csv");
  if (ending == ".db3" || ending == ".mcap")
    refuse(
        "is a ROS 2 bag",
        "convert it: open it in PlotJuggler and export the positions of the joints as CSV, or play it with ros2 bag play and "
        "record /joint_states as CSV with a line of names");
  if (begin.find("#BEGINGLOBALHEADER") != begin.npos)
    refuse("is a KUKA trace in DIAdem format, with its numbers in a binary file",
           "convert it to CSV: github.com/xikuibin/KukaTraceHelper, or open it in DIAdem");
  if (begin.starts_with("PK")) refuse("is a workbook or an archive", "export the table as CSV");
  if (begin.starts_with("\xFF\xFE") || begin.starts_with("\xFE\xFF"))
    refuse("is a text in UTF-16", "export it as UTF-8: iconv -f UTF-16 -t UTF-8 FILE > log.csv");
  if (begin.find('\0') != begin.npos) refuse("is no text", "export the log as CSV");
}

/// Makes rows with increasing times and without standstills.
class Rows {
 public:
  Rows(Recording& made, const std::filesystem::path& file, const pipeline::Robot& robot, double still)
      : made_(made), file_(file), robot_(robot), still_(still), filter_(axes_of(robot), still, [this](LogRow row) {
          settle(std::move(row));
        }) {}

  void add(double stamp, std::vector<double> angles, std::uint32_t line) {
    ++made_.rows;
    if (same_.empty()) begin_ = last_stamp_ = stamp;
    if (stamp == last_stamp_ && !same_.empty()) {
      ++made_.same_stamp;
      if (angles == same_.back().angles) return;
    } else if (!same_.empty()) {
      const double step = stamp - last_stamp_;
      if (step < 0) {
        if (++made_.back == 1) made_.first_back = static_cast<int>(line);
        begin_ += step - made_interval();
      } else if (intervals_.size() < rows_of_interval) {
        intervals_.push_back(step / static_cast<double>(same_.size()));
      }
      if (step > shortest_pause && step > pause_intervals * made_interval()) note_pause(step, line);
      spread(step < 0 ? made_interval() : step);
      last_stamp_ = stamp;
    }
    same_.push_back({stamp - begin_, std::move(angles), line});
  }

  void finish() {
    spread(made_interval());
    filter_.finish();
    end_stand();
    made_.interval = made_interval();
    made_.impossible = std::move(filter_.found);
    if (!outside_) {
      if (wrap_.empty()) return;
      throw InputError({file_.string(), static_cast<int>(line_of_wrap_), 1}, wrap_, unwrap);
    }
    const std::string more =
        rows_outside_ > 1 ? fmt::format(", and {} rows are outside of limits in all", rows_outside_) : "";
    const std::string order = order_words(made_.columns, {});
    throw InputError(
        {file_.string(), static_cast<int>(line_outside_), 1}, outside_->what + more,
        (wrap_.empty() ? "" : fmt::format("in line {} {}: {}; else ", line_of_wrap_, wrap_, unwrap)) +
            (order.empty() ? "" : order + "; else ") +
            "check the unit (--value unit=deg), the order of the columns (--value joints=NAME,NAME,..) and the robot of the job");
  }

 private:
  double made_interval() {
    if (intervals_.empty()) return 1;
    const auto middle = intervals_.begin() + static_cast<long>(intervals_.size() / 2);
    std::nth_element(intervals_.begin(), middle, intervals_.end());
    return *middle;
  }

  void note_pause(double step, std::uint32_t line) {
    ++made_.pauses;
    made_.pause_seconds += step;
    if (step <= made_.longest_pause) return;
    made_.longest_pause = step;
    made_.line_of_pause = static_cast<int>(line);
  }

  /// Distributes rows with one stamp until the next stamp.
  void spread(double step) {
    const double share = std::min(step, coarsest_clock) / static_cast<double>(std::max<std::size_t>(1, same_.size()));
    for (std::size_t k = 0; k < same_.size(); ++k) {
      same_[k].time += static_cast<double>(k) * share;
      if (wrap_.empty()) note_wrap(same_[k]);
      filter_.add(std::move(same_[k]));
    }
    same_.clear();
  }

  /// Notes the first step of about a turn. The axis may move meanwhile, but in a pause without rows only for an interval.
  void note_wrap(const LogRow& row) {
    for (std::size_t i = 0; i < last_.angles.size(); ++i) {
      const double way = std::abs(row.angles[i] - last_.angles[i]);
      if (way < least_wrap) continue;
      const Axis& axis = made_.columns[i].axis;
      const double moved = axis.speed * std::min(row.time - last_.time, made_interval());
      if (std::abs(way - 2 * std::numbers::pi) > std::max(moved, least_way_at_wrap)) continue;
      line_of_wrap_ = row.line;
      wrap_ =
          fmt::format("{} ({}) turns by {:.4g} deg in {:.3g} s, from {:.4g} to {:.4g} deg: its angle wraps at a turn",
                      axis.name, made_.columns[i].column, way / degree, row.time - last_.time, last_.angles[i] / degree,
                      row.angles[i] / degree);
    }
    last_ = row;
  }

  void note_range(const LogRow& row) {
    bool inside = true;
    for (std::size_t i = 0; i < row.angles.size(); ++i) {
      AxisOfLog& of = made_.columns[i];
      of.low = range_begun_ ? std::min(of.low, row.angles[i]) : row.angles[i];
      of.high = range_begun_ ? std::max(of.high, row.angles[i]) : row.angles[i];
      inside &= row.angles[i] >= of.axis.lower && row.angles[i] <= of.axis.upper;
    }
    range_begun_ = true;
    if (inside) return;
    const auto fault = limit_fault(robot_, row.angles, "the row");
    if (!fault) return;
    ++rows_outside_;
    if (!outside_) outside_ = fault, line_outside_ = row.line;
  }

  void settle(LogRow row) {
    note_range(row);
    if (!stand_.empty()) {
      bool moves = false;
      for (std::size_t i = 0; i < row.angles.size(); ++i)
        moves |= std::abs(row.angles[i] - stand_.front().angles[i]) > still_;
      if (moves) end_stand();
    }
    is_long_ |= !stand_.empty() && row.time - stand_.front().time >= short_stand;
    while (is_long_ && stand_.size() > 1 && stand_[1].time < row.time - start) stand_.erase(stand_.begin() + 1);
    stand_.push_back(std::move(row));
  }

  void end_stand() {
    if (is_long_) stand_[1].angles = stand_.front().angles;
    for (const LogRow& row : stand_) push(row);
    stand_.clear();
    is_long_ = false;
  }

  void push(const LogRow& row) {
    if (made_.size() == most_rows)
      throw InputError({file_.string(), static_cast<int>(row.line), 1},
                       fmt::format("the log has more than {} rows that move", most_rows), "split the log");
    made_.times.push_back(row.time);
    made_.angles.insert(made_.angles.end(), row.angles.begin(), row.angles.end());
    made_.lines.push_back(row.line);
  }

  Recording& made_;
  const std::filesystem::path& file_;
  const pipeline::Robot& robot_;
  double still_;
  StepFilter filter_;
  bool range_begun_ = false;
  std::optional<LimitFault> outside_;  // the first row outside
  std::uint32_t line_outside_ = 0;
  std::size_t rows_outside_ = 0;
  LogRow last_;       // of note_wrap()
  std::string wrap_;  // description of the first wrapped angle
  std::uint32_t line_of_wrap_ = 0;
  double begin_ = 0, last_stamp_ = 0;
  std::vector<LogRow> same_;  // rows with one stamp
  std::vector<LogRow>
      stand_;  // rows near the first row of a standstill; of a long standstill the first and the last rows
  bool is_long_ = false;
  std::vector<double> intervals_;
};

/// Reads the file once.
class Pass {
 public:
  Pass(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options)
      : Pass(file, robot, options, pipeline::CsvReader(pipeline::PlainFile(file), separators)) {}
  Pass(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options,
       pipeline::CsvReader log)
      : file_(file), options_(options), log_(std::move(log)) {
    titles_ = log_.next();
    if (titles_.empty())
      throw InputError({file.string(), 1, 1}, "the log is empty",
                       "name a CSV file with a line of names, then one row per time");
    columns_ = log_columns(log_, titles_, robot.axes(), options.joints);
    if (!columns_.time && options.rate == 0)
      throw InputError(log_.where(titles_.front()), "the log has no column of times (time, timestamp, t, ..)",
                       "name it 'time', or give --value rate_Hz=10 with the rows per second");
  }

  std::optional<double> radians() const {
    if (options_.unit == "deg") return degree;
    if (options_.unit == "rad") return 1;
    return columns_.radians;
  }

  /// Reads every row. take: called with time [s], angles as written, and line.
  template <class Take>
  void run(const std::function<void(double)>& progress, const Take& take) {
    run_some(progress, take);
    check_faults();
  }

  /// Reads rows without an error for rows that cannot be read.
  template <class Take>
  void run_some(const std::function<void(double)>& progress, const Take& take) {
    LogTime clock(columns_.seconds);
    for (CsvRow row = log_.next(); !row.empty(); row = log_.next()) {
      ++rows_;
      if (progress && rows_ % 10'000 == 0) progress(log_.share_read());
      while (row.size() > titles_.size() && row.back().text.empty()) row.pop_back();
      if (row.size() == titles_.size() && row.front().text == titles_.front().text &&
          row.back().text == titles_.back().text)
        continue;
      if (row.size() == titles_.size()) order_by_names(row);
      const auto time = time_of(row, clock);
      std::vector<double> angles;
      for (const std::size_t column : columns_.axes)
        if (const auto angle = row.size() == titles_.size() ? number(row[column].text) : std::nullopt)
          angles.push_back(*angle);
      if (!time || angles.size() != columns_.axes.size()) {
        leave_out(row, time.has_value());
        continue;
      }
      take(*time, std::move(angles), static_cast<std::uint32_t>(log_.line()));
    }
    clock_words_ = clock.words();
  }

  /// Returns titles of columns that seem to be axes beyond those of the robot.
  std::vector<std::string> external() const {
    const auto stem = [](const std::string& title) {
      std::vector<std::string> words = words_of_name(title);
      std::erase_if(words, [](const std::string& word) { return word[0] >= '0' && word[0] <= '9'; });
      return words;
    };
    std::vector<std::string> found;
    for (std::size_t k = 0; k < titles_.size(); ++k) {
      if (std::ranges::find(columns_.axes, k) != columns_.axes.end() || k == columns_.time || k == columns_.date)
        continue;
      const std::vector<std::string> words = stem(titles_[k].text);
      const bool named = std::ranges::any_of(words, [](const std::string& word) {
        return word == "e" || word == "ext" || word == "external" || word == "eax" || word == "extax" ||
               word == "rail" || word == "track" || word == "extern";
      });
      if ((named || words == stem(titles_[columns_.axes[0]].text)) &&
          words.size() != words_of_name(titles_[k].text).size())
        found.push_back(titles_[k].text);
    }
    return found;
  }

  /// Returns "separator ';', decimal commas; column Zeit: seconds; angles in degrees by the names of the columns". Precondition:
  /// run() was called.
  std::string words(bool unit_by_size) const {
    const char separator = log_.separator();
    std::string text = fmt::format("separator {}", separator == '\t'  ? "tab"
                                                   : separator == ' ' ? "blank"
                                                                      : fmt::format("'{}'", separator));
    if (comma_seen_) text += ", decimal commas";
    if (options_.rate > 0) {
      text += fmt::format("; times by --value rate_Hz={:g}", options_.rate);
    } else {
      const std::string date = columns_.date ? fmt::format("{} and ", titles_[*columns_.date].text) : "";
      text += fmt::format("; times in {}{}: {}", date, titles_[*columns_.time].text, clock_words_);
    }
    return text + fmt::format("; angles in {} {}", (unit_by_size || *radians() != 1) ? "degrees" : "radians",
                              !options_.unit.empty() ? "by --value unit"
                              : unit_by_size         ? "because they are too large for radians"
                                                     : "by the names of the columns");
  }

  std::string title(std::size_t axis) const { return titles_[columns_.axes[axis]].text; }

  std::size_t left_out = 0;
  int first_left_out = 0;

 private:
  std::optional<double> number(std::string text) {
    if (log_.separator() != ',')
      if (const std::size_t comma = text.find(','); comma != text.npos) text[comma] = '.', comma_seen_ = true;
    const auto value = pipeline::number_in(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  std::optional<double> time_of(const CsvRow& row, LogTime& clock) {
    if (options_.rate > 0) return static_cast<double>(rows_ - 1) / options_.rate;
    if (row.size() != titles_.size()) return {};
    std::string text = row[*columns_.time].text;
    if (columns_.date) text = row[*columns_.date].text + ' ' + text;
    if (text.find(':') == text.npos) {
      const auto value = number(text);
      return value ? clock.read(fmt::format("{:.17g}", *value)) : std::nullopt;
    }
    return clock.read(text);
  }

  /// Assigns the columns to joints by the names in the first row.
  void order_by_names(const CsvRow& row) {
    if (columns_.names.empty()) return;
    const auto order = order_of_axes(
        pipeline::mapped(columns_.names, [&](std::size_t column) { return std::string(row[column].text); }), "");
    if (!order)
      throw InputError(
          log_.where(row[columns_.names.front()]), "the names of the joints do not give their order on the robot",
          "give --value joints=NAME,NAME,.. with the columns of the positions in the order of the robot's axes");
    columns_.axes = pipeline::mapped(*order, [&](std::size_t k) { return columns_.axes[k]; });
    columns_.names.clear();
  }

  void leave_out(const CsvRow& row, bool has_time) {
    if (left_out++ > 0) return;
    first_left_out = row.front().line;
    first_fault_ = row.size() != titles_.size()
                       ? fmt::format("has {} cells (there are {} names)", row.size(), titles_.size())
                       : fmt::format("has no {}", has_time ? "number for every axis" : "time stamp that can be read");
    if (log_.separator() == ',' && row.size() > titles_.size())
      first_fault_ += "; decimal commas need another separator";
  }

  void check_faults() const {
    const pipeline::Where where{file_.string(), first_left_out, 1};
    if (rows_ == 0) throw InputError({file_.string(), 1, 1}, "the log has no rows", "name a log with one row per time");
    if (left_out > few_faults && static_cast<double>(left_out) > most_faults * static_cast<double>(rows_))
      throw InputError(where,
                       fmt::format("{} of {} rows cannot be read; the first one {}", left_out, rows_, first_fault_),
                       "export the log with one number per axis and a time stamp in every row");
    if (left_out == rows_)
      throw InputError(where, "no row can be read; the first one " + first_fault_, "correct the rows");
  }

  const std::filesystem::path& file_;
  const LogOptions& options_;
  pipeline::CsvReader log_;
  CsvRow titles_;
  LogColumns columns_;
  std::size_t rows_ = 0;
  std::string first_fault_, clock_words_;
  bool comma_seen_ = false;
};

/// Returns the factor to rad for a log without a unit: degrees if the angles are too large for radians.
double unit_by_size(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options) {
  constexpr double widest = 4 * std::numbers::pi;  // two turns to either side
  double largest = 0;
  Pass(file, robot, options).run({}, [&](double, const std::vector<double>& angles, std::uint32_t) {
    for (const double angle : angles) largest = std::max(largest, std::abs(angle));
  });
  if (largest > widest) return degree;
  throw InputError({file.string(), 1, 1}, "the log gives angles without a unit (none is too large for radians)",
                   "give --value unit=deg or --value unit=rad");
}

}  // namespace

LogSize size_of_log(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options) {
  const pipeline::PlainFile log(file);
  std::string text = log.beginning(sample_bytes);
  refuse_other_kinds(file, text);
  const double bytes = static_cast<double>(log.size());
  if (const std::size_t end = text.rfind('\n'); static_cast<double>(text.size()) < bytes && end != text.npos)
    text.resize(end + 1);
  const double share = static_cast<double>(text.size()) / bytes;
  std::vector<double> times;
  Pass(file, robot, options, pipeline::CsvReader(std::move(text), file.string(), separators))
      .run_some({}, [&](double time, const std::vector<double>&, std::uint32_t) { times.push_back(time); });
  LogSize size{bytes / 1e6, static_cast<double>(times.size()) / share, 0};
  if (!times.empty()) size.seconds = std::max(0., times.back() - times.front()) / share;
  return size;
}

Recording read_log(const std::filesystem::path& file, const pipeline::Robot& robot, const LogOptions& options,
                   const std::function<void(double)>& progress) {
  refuse_other_kinds(file, pipeline::beginning_of(file, 4096));
  Pass pass(file, robot, options);
  const auto known = pass.radians();
  const double unit = known ? *known : unit_by_size(file, robot, options);
  Recording made;
  made.axes = robot.axes();
  const std::vector<Axis> axes = axes_of(robot);
  for (std::size_t i = 0; i < made.axes; ++i) made.columns.push_back({axes[i], pass.title(i)});
  Rows rows(made, file, robot, options.still);
  pass.run(progress, [&](double time, std::vector<double> angles, std::uint32_t line) {
    for (double& angle : angles) angle *= unit;
    rows.add(time, std::move(angles), line);
  });
  for (std::size_t i = 0; i < made.axes; ++i)
    made.columns[i].column = pass.title(i);  // a row may contain the names of the joints
  made.format = pass.words(!known);
  made.external = pass.external();
  rows.finish();
  made.left_out = pass.left_out;
  made.first_left_out = pass.first_left_out;
  bool moves = false;
  for (std::size_t k = made.axes; k < made.angles.size(); ++k)
    moves |= std::abs(made.angles[k] - made.angles[k % made.axes]) > options.still;
  if (moves && made.interval > longest_interval)
    throw InputError({file.string()},
                     fmt::format("has rows that are {:.3g} s apart (limit {:g} s), between which a robot moves",
                                 made.interval, longest_interval),
                     "record more often; if its times are milliseconds, divide them by 1000");
  if (made.back > few_faults && static_cast<double>(made.back) > most_faults * static_cast<double>(made.rows))
    throw InputError({file.string()},
                     fmt::format("{} of {} rows have an earlier time than the row before", made.back, made.rows),
                     "sort the rows by time");
  return made;
}

}  // namespace dresslife::sim
