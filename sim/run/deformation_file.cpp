#include "sim/run/deformation_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/warning_words.h"

namespace dresslife::sim {
namespace {

using pipeline::CsvCell;
using pipeline::CsvRow;
using pipeline::InputError;

enum Quantity { time, position, curvature1, curvature2, twist, elongation, quantities };

struct Column {
  std::string_view name;
  Quantity quantity;
  double to_si;
  bool is_tension = false;
};
constexpr Column known[] = {{"t_s", time, 1},
                            {"position_m", position, 1},
                            {"kappa_1_1_per_m", curvature1, 1},
                            {"kappa_2_1_per_m", curvature2, 1},
                            {"twist_deg_per_m", twist, EIGEN_PI / 180},
                            {"twist_rad_per_m", twist, 1},
                            {"elongation", elongation, 1},
                            {"tension_N", elongation, 1, true}};

class Reader {
 public:
  explicit Reader(const pipeline::Setup& setup)
      : file_(setup.motion.deformation.string()),
        length_(setup.dresspacks.front().routing.free_length),
        segment_(length_ / setup.simulation.segments),
        stiffness_(axial_stiffness(setup.dresspacks.front().dresspack)) {
    pipeline::CsvReader reader(pipeline::read_text(setup.motion.deformation), file_);
    for (CsvRow cells = reader.next(); !cells.empty(); cells = reader.next()) {
      line_ = reader.line();
      columns_.empty() ? read_header(cells) : read_row(cells);
    }
    line_ = reader.line();
    if (result_.times.empty())
      fail(0, "deformation holds no row", "write a header (t_s, kappa_1_1_per_m, ...) and a row per time");
    finish_time();
    if (worst_.angle > most_turn) refuse_turn();
    result_.steps.assign(result_.times.size(), 0);
    result_.step_texts = {"deformation of " + setup.motion.deformation.filename().string()};
  }

  PrescribedDeformation take() { return std::move(result_); }

 private:
  [[noreturn]] void fail(int column, const std::string& what, const std::string& remedy) const {
    throw InputError({file_, line_, column}, what, remedy);
  }

  void read_header(const CsvRow& cells) {
    std::array<std::string_view, quantities> names{};
    for (const CsvCell& cell : cells) {
      const auto* column = std::ranges::find(known, cell.text, &Column::name);
      if (column == std::end(known)) {
        fail(cell.column, fmt::format("'{}' is no column of a deformation", cell.text),
             "the first line names the columns, of: " + pipeline::joined(pipeline::mapped(known, &Column::name), ", "));
      }
      if (!names[column->quantity].empty())
        fail(cell.column, fmt::format("column {} beside {} (both say the same)", cell.text, names[column->quantity]),
             "keep one of the two");
      names[column->quantity] = column->name;
      columns_.push_back(column);
    }
    if (names[time].empty()) fail(1, "deformation has no column t_s", "give the time of each row in seconds");
    if (names[curvature1].empty() && names[curvature2].empty() && names[twist].empty() && names[elongation].empty())
      fail(1, "deformation has a time and nothing that deforms",
           "add kappa_1_1_per_m, kappa_2_1_per_m, twist_deg_per_m or elongation");
    has_places_ = !names[position].empty();
  }

  void read_row(const CsvRow& cells) {
    if (cells.size() != columns_.size())
      fail(cells.back().column, fmt::format("row has {} cells (its header has {})", cells.size(), columns_.size()),
           "write one number per column, separated by commas");
    std::array<double, quantities> value{};
    std::array<int, quantities> at{};
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const Column& column = *columns_[c];
      const std::optional<double> number = pipeline::number_in(cells[c].text);
      if (!number || !std::isfinite(*number))
        fail(cells[c].column, fmt::format("'{}' is not a finite number ({})", cells[c].text, column.name),
             "write a decimal number");
      value[column.quantity] = *number * column.to_si;
      at[column.quantity] = cells[c].column;
      if (column.is_tension) value[elongation] = elongation_of(*number, cells[c].column);
    }
    see_turn({value[curvature1], value[curvature2], value[twist]},
             at[twist] ? at[twist] : std::max(at[curvature1], at[curvature2]));
    if (std::abs(value[elongation]) > most_elongation)
      fail(at[elongation],
           fmt::format("elongation is {:.6g} (must be -0.5 .. 0.5: relative, 0.01 is one percent)", value[elongation]),
           "check its unit, or the E A by which a tension becomes one");
    add(value, at);
  }

  double elongation_of(double tension, int column) const {
    if (stiffness_ <= 0)
      fail(
          column,
          "tension_N is given and the dresspack has no axial_stiffness_N and no wires (it becomes an elongation by E A)",
          "give dresspack.axial_stiffness_N, or a column elongation");
    return tension / stiffness_;
  }

  void see_turn(const Vector3& rate, int column) {
    if (const double angle = rate.norm() * segment_; angle > worst_.angle) worst_ = {angle, line_, column};
  }

  /// Refuses the largest turn of all rows, so that its number of segments suits every row.
  [[noreturn]] void refuse_turn() const {
    throw InputError({file_, worst_.line, worst_.column},
                     fmt::format("curvature and twist turn a segment of {:.4g} mm by {:.4g} deg (at most 120)",
                                 1e3 * segment_, worst_.angle * 180 / EIGEN_PI),
                     fmt::format("check the units, or give simulation.segments: {:.0f}",
                                 std::ceil(length_ / segment_ * worst_.angle / most_turn)));
  }

  void add(const std::array<double, quantities>& value, const std::array<int, quantities>& at) {
    const bool same_time = !result_.times.empty() && value[time] == result_.times.back();
    if (same_time && !has_places_)
      fail(at[time], fmt::format("time {} s is listed twice", value[time]),
           "drop a row, or give its place in a column position_m");
    if (!same_time) begin_time(value[time], at[time]);
    const std::size_t place = result_.states.size() - (result_.times.size() - 1) * places_;
    if (has_places_) check_place(value[position], place, at[position]);
    if (result_.times.size() == 1) result_.positions.push_back(value[position]);
    result_.states.push_back({{value[curvature1], value[curvature2], value[twist]}, value[elongation]});
  }

  void begin_time(double value, int column) {
    if (result_.times.empty() && value != 0)
      fail(column, fmt::format("first time is {} s (must be 0)", value), "subtract it from every row");
    if (!result_.times.empty() && value < result_.times.back())
      fail(column, fmt::format("time {} s does not follow {} s (must increase)", value, result_.times.back()),
           "sort the rows by time, then by position_m");
    finish_time();
    result_.times.push_back(value);
  }

  /// Checks that every time has the places of the first time.
  void finish_time() {
    if (result_.times.empty()) return;
    if (result_.times.size() == 1) places_ = result_.positions.size();
    if (const std::size_t left = result_.times.size() * places_ - result_.states.size(); left > 0)
      fail(0, fmt::format("time {} s has {} places (the first has {})", result_.times.back(), places_ - left, places_),
           "give every time a row for each position_m");
  }

  void check_place(double value, std::size_t place, int column) const {
    constexpr double rounding = 1e-6;  // relative to the length, for rounded decimals
    if (value < 0 || value > length_ * (1 + rounding))
      fail(column, fmt::format("position_m is {} (must lie in 0 .. {}, the dresspack's free_length_m)", value, length_),
           "measure it from the base clamp along the dresspack");
    if (result_.times.size() == 1) {
      if (place > 0 && value <= result_.positions.back())
        fail(column, fmt::format("position_m {} does not follow {}", value, result_.positions.back()),
             "sort the rows of a time by position_m");
    } else if (place >= places_ || value != result_.positions[place]) {
      fail(column, fmt::format("position_m {} is not the place that the first time has here", value),
           "give every time the same places in the same order");
    }
  }

  static constexpr double most_elongation = 0.5;
  struct Turn {
    double angle = 0;  // of a segment [rad]
    int line = 0, column = 0;
  };
  Turn worst_;
  std::string file_;
  int line_ = 0;
  double length_, segment_, stiffness_;
  std::vector<const Column*> columns_;
  bool has_places_ = false;
  std::size_t places_ = 0;  // number of places per time, known after the first time
  PrescribedDeformation result_;
};

}  // namespace

PrescribedDeformation read_deformation(const pipeline::Setup& setup) { return Reader(setup).take(); }

std::vector<pipeline::Warning> doubts_of_times(const PrescribedDeformation& deformation, const pipeline::Setup& setup) {
  // Of the strain of bending, twist and pull at the surface [1/s]. A hose of 50 mm that is bent to 0.2 m in a second has 0.13, on a
  // swift robot 1, a cable of 5 mm in a test with 10 bends a second 2. An arm of 1 m at 0.5 deg/s bends that hose with 2e-4.
  constexpr double fastest = 10, slowest = 1e-4;
  constexpr double shortest_in_ms = 100;  // [s]: no robot repeats its motion in 0.1 s
  const double outer = setup.dresspacks.front().dresspack.diameter / 2;
  const std::size_t places = deformation.positions.size();
  double speed = 0;
  for (std::size_t k = places; k < deformation.states.size(); ++k) {
    const auto &now = deformation.states[k], &before = deformation.states[k - places];
    const double change = outer * (now.rate - before.rate).norm() + std::abs(now.elongation - before.elongation);
    speed = std::max(speed, change / (deformation.times[k / places] - deformation.times[k / places - 1]));
  }
  const double repeat = deformation.times.back();
  const bool fast = speed > fastest, slow = speed > 0 && speed < slowest && repeat >= shortest_in_ms;
  if (!fast && !slow) return {};
  return {pipeline::warning_of(
      pipeline::WarningKind::motion, setup.motion.deformation.string(),
      fmt::format(
          "a repeat of the deformation takes {:.3g} s, and the strain at the surface changes by up to {:.2g} per second "
          "(limits {:g} .. {:g})",
          repeat, speed, slowest, fastest),
      fast ? "times a thousand times too small" : "milliseconds instead of seconds",
      fast ? fmt::format("t_s in seconds: a repeat of {:.3g} s if so", 1000 * repeat)
           : fmt::format("t_s in seconds: a repeat of {:.3g} s if so; leave it if it deforms so slowly",
                         repeat / 1000))};
}

}  // namespace dresslife::sim
