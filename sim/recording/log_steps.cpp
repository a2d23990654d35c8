#include "sim/recording/log_steps.h"

#include "pipeline/base/joined.h"
#include "sim/robot/robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dresslife::sim {
namespace {

constexpr std::size_t window = 5;     // number of rows
constexpr double turn_margin = 1.1;   // of the speed (L3)
constexpr std::size_t most_axes = 8;  // of all orders of up to 8 axes: 40,320
constexpr double speed_margin = 1.2;  // of an axis' limit, because splines through rows may overshoot

}  // namespace

bool StepFilter::is_reached(const LogRow& from, const LogRow& to) const {
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (std::abs(to.angles[i] - from.angles[i]) > speed_margin * axes_[i].speed * (to.time - from.time) + 2 * still_)
      return false;
  return true;
}

bool StepFilter::is_possible(const LogRow& before, const LogRow& row, const LogRow& after) const {
  const double h1 = row.time - before.time, h2 = after.time - row.time, h = h1 + h2;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double off = std::abs(row.angles[i] - (h2 * before.angles[i] + h1 * after.angles[i]) / h);
    const double drive = std::min(axes_[i].acceleration * h1 * h2, 2 * turn_margin * axes_[i].speed * h1 * h2 / h);
    const double clock = std::abs(after.angles[i] - before.angles[i]) * std::min(h1, h2) / (2 * h);
    if (off > drive + clock + 2 * still_) return false;
  }
  return true;
}

void StepFilter::add(LogRow row) {
  rows_.push_back(std::move(row));
  if (rows_.size() < window) return;
  // This row is possible if the next row is left out. Then the next row is wrong, and the next call checks it.
  const bool next_is_wrong = is_possible(rows_[1], rows_[2], rows_[4]);
  if (!next_is_wrong && !is_possible(rows_[1], rows_[2], rows_[3])) {
    const bool alone = is_reached(rows_[1], rows_[3]) && is_possible(rows_[0], rows_[1], rows_[3]) &&
                       is_possible(rows_[1], rows_[3], rows_[4]);
    (alone ? found.glitches : found.jumps).push_back(rows_[2].line);
    if (alone) {
      rows_.erase(rows_.begin() + 2);
      return;
    }
  }
  pass_on_(std::move(rows_.front()));
  rows_.pop_front();
}

void StepFilter::finish() {
  for (LogRow& row : rows_) pass_on_(std::move(row));
  rows_.clear();
}

std::vector<std::size_t> better_order(const std::vector<AxisOfLog>& axes, const std::vector<double>& fastest) {
  const auto fits = [&](std::size_t column, std::size_t axis) {
    const Axis& of = axes[axis].axis;
    return axes[column].low >= of.lower - limit_rounding && axes[column].high <= of.upper + limit_rounding &&
           (fastest.empty() || fastest[column] <= speed_margin * of.speed);
  };
  std::vector<std::size_t> order(axes.size()), best;
  std::iota(order.begin(), order.end(), 0);
  if (axes.size() > most_axes) return best;
  std::size_t fewest = axes.size() + 1;
  do {
    std::size_t moved = 0;
    bool good = true;
    for (std::size_t axis = 0; axis < order.size() && good; ++axis) {
      good = fits(order[axis], axis);
      moved += order[axis] != axis;
    }
    if (good && moved < fewest) fewest = moved, best = order;
  } while (fewest > 0 && std::next_permutation(order.begin(), order.end()));
  if (fewest == 0) best.clear();
  return best;
}

std::string order_words(const std::vector<AxisOfLog>& axes, const std::vector<double>& fastest) {
  const std::vector<std::size_t> order = better_order(axes, fastest);
  if (order.empty()) return "";
  std::vector<std::string> columns, moved;
  for (std::size_t axis = 0; axis < order.size(); ++axis) {
    columns.push_back(axes[order[axis]].column);
    if (order[axis] != axis) moved.push_back(axes[axis].axis.name);
  }
  return fmt::format(
      "the columns of {} may be exchanged: every column keeps the limits of its axis with --value \"joints={}\"",
      pipeline::joined(moved, ", "), pipeline::joined(columns, ","));
}

}  // namespace dresslife::sim
