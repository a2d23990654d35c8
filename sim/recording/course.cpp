#include "sim/recording/course.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sim/robot/robot.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double longest_stand = 3;     // [s]
constexpr double shortest_stand = 0.4;  // [s] of equal rows; shorter standstills may be one step of an encoder
constexpr double gap_intervals = 5, shortest_gap = 0.5;  // [1], [s]
constexpr double fine_rows = 0.04,
                 knot_distance = 0.05;  // [s]: drives change their accelerations in 0.1 s or more
constexpr int halvings = 2;

struct Knot {
  double time;
  VectorXd angles;
  double window;  // [s] half of the interval of the log that gives the value; 0: the value of a row
  std::size_t row;
};

/// Computes the knots for the rows [begin, end] of a run.
class Smoothing {
 public:
  Smoothing(const std::vector<double>& times, const std::vector<double>& angles, std::size_t axes, std::size_t begin,
            std::size_t end)
      : times_(times), angles_(angles), axes_(axes), begin_(begin), end_(end) {}

  std::vector<Knot> knots(double bound, double& largest) {
    const double length = times_[end_] - times_[begin_];
    const int parts = std::max(1, static_cast<int>(std::lround(length / knot_distance)));
    std::vector<Knot> knots{row(begin_)};
    for (int k = 1; k < parts; ++k)
      add_fitted(knots, times_[begin_] + length * k / parts, length / parts, times_[end_]);
    knots.push_back(row(end_));
    for (int round = 0;; ++round) {
      bool good = true;
      std::vector<Knot> next;
      const CubicSpline spline = spline_of(knots);
      double furthest = 0;
      std::size_t at = begin_;
      for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        double off = 0;
        const std::size_t first = at;
        for (; at <= end_ && times_[at] < knots[k + 1].time; ++at)
          off = std::max(off, (spline.at(times_[at]) - value(at)).lpNorm<Eigen::Infinity>());
        furthest = std::max(furthest, off);
        next.push_back(knots[k]);
        if (off <= bound) continue;
        good = false;
        const double half = (knots[k + 1].time - knots[k].time) / 2;
        if (round < halvings) {
          add_fitted(next, knots[k].time + half, half, knots[k + 1].time);
          continue;
        }
        if (next.back().window > 0) next.pop_back();
        for (std::size_t i = first; i < at; ++i)
          if (next.empty() || times_[i] > next.back().time) next.push_back(row(i));
        if (k + 2 < knots.size() && at <= end_) {
          knots[k + 1] = row(at);
          const auto later = std::find_if(knots.begin() + static_cast<long>(k) + 2, knots.end(),
                                          [&](const Knot& knot) { return knot.time > times_[at]; });
          knots.erase(knots.begin() + static_cast<long>(k) + 2, later);  // rows are missing there
        }
      }
      if (good) {
        largest = std::max(largest, furthest);
        return knots;
      }
      next.push_back(knots.back());
      knots = std::move(next);
    }
  }

 private:
  VectorXd value(std::size_t row) const {
    return Eigen::Map<const VectorXd>(&angles_[row * axes_], static_cast<long>(axes_));
  }
  Knot row(std::size_t k) const { return {times_[k], value(k), 0, k}; }
  std::size_t first_from(double time) const {
    return static_cast<std::size_t>(
        std::lower_bound(times_.begin() + static_cast<long>(begin_), times_.begin() + static_cast<long>(end_), time) -
        times_.begin());
  }

  CubicSpline spline_of(const std::vector<Knot>& knots) const {
    std::vector<double> times;
    Eigen::MatrixXd values(static_cast<long>(axes_), static_cast<long>(knots.size()));
    for (const Knot& knot : knots) {
      values.col(static_cast<long>(times.size())) = knot.angles;
      times.push_back(knot.time);
    }
    return {std::move(times), std::move(values), SplineEnds::at_rest};
  }

  /// Adds fitted knots between the last knot and `end` if the distance is large enough: rows may be missing there.
  void add_fitted(std::vector<Knot>& knots, double time, double window, double end) const {
    Knot knot = fitted(time, window);
    if (knot.time > knots.back().time && knot.time < end) knots.push_back(std::move(knot));
  }

  /// Returns the knot from the parabola a + b x + c x^2, x = (t - time)/window, at x = 0. If a side has fewer than two rows: the
  /// nearest row.
  Knot fitted(double time, double window) const {
    const std::size_t from = first_from(time - window), to = first_from(time + window), nearest = first_from(time);
    if (nearest < from + 2 || to < nearest + 2) return row(std::clamp(nearest, begin_ + 1, end_ - 1));
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(3, static_cast<long>(axes_));
    for (std::size_t k = from; k < to; ++k) {
      const double x = (times_[k] - time) / window;
      const Eigen::Vector3d powers(1, x, x * x);
      normal += powers * powers.transpose();
      right += powers * value(k).transpose();
    }
    return {time, normal.ldlt().solve(right).row(0).transpose(), window, nearest};
  }

  const std::vector<double>&times_, &angles_;
  std::size_t axes_, begin_, end_;
};

}  // namespace

Course::Course(const Recording& log, const pipeline::Robot& robot, double still) : axes_(log.axes) {
  cut(log, robot);
  smooth(log.interval, still);
  check_speeds(robot);
}

void Course::add(double time, const double* angles, std::uint32_t line, double logged) {
  times_.push_back(time);
  angles_.insert(angles_.end(), angles, angles + axes_);
  lines_.push_back(line);
  logged_.push_back(logged);
}

bool Course::stands(std::size_t k) const {
  return std::equal(angles_.begin() + static_cast<long>(k * axes_),
                    angles_.begin() + static_cast<long>((k + 1) * axes_),
                    angles_.begin() + static_cast<long>((k + 1) * axes_));
}

void Course::cut(const Recording& log, const pipeline::Robot& robot) {
  const std::vector<Axis> axes = axes_of(robot);
  double time = 0;
  const auto row = [&](std::size_t k) { add(time, log.at(k), log.lines[k], log.times[k]); };
  for (std::size_t k = 0; k < log.size(); ++k) {
    if (k == 0) {
      row(0);
      continue;
    }
    const double step = log.times[k] - log.times[k - 1];
    double share = 0,
           needed = 0;  // share: of the largest distance in two intervals; needed: [s] for a move at half speed
    for (std::size_t i = 0; i < axes_; ++i) {
      const double way = std::abs(log.at(k)[i] - log.at(k - 1)[i]);
      share = std::max(share, way / (2 * log.interval * axes[i].speed));
      needed = std::max(needed, 3 * way / axes[i].speed);  // the largest speed, at the middle, is 3/2 of the mean speed
    }
    log_seconds += step;
    if (share == 0 && step >= shortest_stand) {
      stand_seconds += step;
      time += std::min(step, longest_stand);
    } else if (step <= std::max(gap_intervals * log.interval, shortest_gap)) {
      time += step;
    } else if (share <= 1) {  // a log that records only changes: the robot stood still until shortly before
      stand_seconds += step - log.interval;
      time += std::min(step - log.interval, longest_stand);
      add(time, log.at(k - 1), log.lines[k - 1], log.times[k] - log.interval);
      time += log.interval;
    } else {
      ++gaps;
      gap_seconds += step;
      log_seconds -= step;
      add(time += log.interval, log.at(k - 1), log.lines[k - 1], log.times[k - 1]);
      add(time += std::max(needed, log.interval), log.at(k), log.lines[k], log.times[k]);
      time += log.interval;
    }
    row(k);
  }
}

void Course::smooth(double interval, double still) {
  const std::vector<double> times = std::move(times_), angles = std::move(angles_), logged = std::move(logged_);
  const std::vector<std::uint32_t> lines = std::move(lines_);
  times_.clear(), angles_.clear(), logged_.clear(), lines_.clear();
  const auto same = [&](std::size_t k) {
    return (interval >= fine_rows || times[k + 1] - times[k] >= shortest_stand) &&
           std::equal(&angles[k * axes_], &angles[k * axes_] + axes_, &angles[(k + 1) * axes_]);
  };
  if (times.empty()) return;
  add(times[0], &angles[0], lines[0], logged[0]);
  for (std::size_t begin = 0, end; begin + 1 < times.size(); begin = end) {
    end = begin + 1;
    if (same(begin)) {
      add(times[end], &angles[end * axes_], lines[end], logged[end]);
      continue;
    }
    while (end + 1 < times.size() && !same(end)) ++end;
    const std::size_t first = times_.size() - 1;
    if (interval < fine_rows && end - begin > 2) {
      const std::vector<Knot> knots = Smoothing(times, angles, axes_, begin, end).knots(still, largest_smoothing);
      for (std::size_t k = 1; k < knots.size(); ++k)
        add(knots[k].time, knots[k].angles.data(), lines[knots[k].row], logged[knots[k].row]);
    } else {
      for (std::size_t k = begin + 1; k <= end; ++k) add(times[k], &angles[k * axes_], lines[k], logged[k]);
    }
    const long count = static_cast<long>(times_.size() - first);
    Eigen::MatrixXd values =
        Eigen::Map<const Eigen::MatrixXd>(&angles_[first * axes_], static_cast<long>(axes_), count);
    runs_.push_back({first, times_.size() - 1,
                     CubicSpline({times_.begin() + static_cast<long>(first), times_.end()}, std::move(values),
                                 SplineEnds::at_rest)});
  }
}

void Course::check_speeds(const pipeline::Robot& robot) {
  const std::vector<Axis> axes = axes_of(robot);
  std::vector<TooFast> found(axes_);
  fastest.assign(axes_, 0);
  for (const Run& run : runs_)
    for (std::size_t k = run.begin; k < run.end; ++k) {
      const VectorXd speed = run.spline.slope(static_cast<long>(k - run.begin)).cwiseAbs();
      for (std::size_t i = 0; i < axes_; ++i) {
        fastest[i] = std::max(fastest[i], speed[static_cast<long>(i)]);
        if (speed[static_cast<long>(i)] <= axes[i].speed) continue;
        TooFast& worst = found[i];
        ++worst.knots;
        if (speed[static_cast<long>(i)] > worst.speed)
          worst = {axes[i].name, speed[static_cast<long>(i)], axes[i].speed, logged_[k], lines_[k], worst.knots};
      }
    }
  for (TooFast& worst : found)
    if (worst.knots > 0) too_fast.push_back(std::move(worst));
}

VectorXd Course::at(double time) const {
  const auto after = std::ranges::upper_bound(runs_, time, {}, [&](const Run& run) { return times_[run.begin]; });
  if (after == runs_.begin()) return knot(0);
  return std::prev(after)->spline.at(time);
}

std::uint32_t Course::line(double time) const {
  const auto after = std::ranges::upper_bound(times_, time);
  return lines_[static_cast<std::size_t>(std::max<long>(0, after - times_.begin() - 1))];
}

}  // namespace dresslife::sim
