#include "sim/recording/log_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double near_knots = 1e-3;  // [s] knots at a smaller distance would give a spline with a large slope
constexpr double ramp = 0.3;         // [s] that a robot needs to start or stop
constexpr double slow = std::numbers::pi / 180;  // [rad/s] a smaller speed needs no ramp
constexpr double settling = 1;                   // [s]
// [s] The strains of a motion take 3.4 MB per second (ten loose cables, 64 segments): two motions of 300 s at the same time take
// 2 GB.
constexpr double long_rest = 200, longest_rest = 300;
constexpr std::size_t most_rows_of_a_motion = 50'000;  // half of the limit of a motion
constexpr double damage_exponent = 5;
// A faster hose swings farther. In two groups of 10 and 8 cycles of `hard` with loose cables and speeds of +- 5 and 8 %, the damage
// increased with the powers 3.2 and 2.5 of the speed (correlation 0.9) and did not depend on the ranges.
constexpr double speed_exponent = 3;
constexpr double recorded_seconds = 600;  // three cycles of 180 s, the usual length of a program, take nearly as long
constexpr double few_recordings = 3;

struct StretchRows {
  std::vector<double> times;
  std::vector<VectorXd> values;

  std::size_t count() const { return times.size(); }
  void add(double time, VectorXd value) {
    times.push_back(time);
    values.push_back(std::move(value));
  }
  double speed(std::size_t k) const {
    const std::size_t a = k > 0 ? k - 1 : 0, b = std::min(k + 1, count() - 1);
    return (values[b] - values[a]).lpNorm<Eigen::Infinity>() / (times[b] - times[a]);
  }
};

StretchRows rows_between(const Course& course, double begin, double end) {
  const std::vector<double>& knots = course.knots();
  const auto knot = [&](auto at) { return course.knot(static_cast<std::size_t>(at - knots.begin())); };
  const auto end_row = [&](double time) {  // of a knot near it, so that a standstill keeps equal rows
    const auto near = std::ranges::lower_bound(knots, time - near_knots);
    return near != knots.end() && *near <= time + near_knots ? knot(near) : course.at(time);
  };
  StretchRows rows;
  rows.add(0, end_row(begin));
  auto at = std::ranges::upper_bound(knots, begin + near_knots);
  for (; at != knots.end() && *at < end - near_knots; ++at) rows.add(*at - begin, knot(at));
  rows.add(end - begin, end_row(end));
  return rows;
}

/// Returns the mean square of the axes' speeds, weighted by the square [rad2/s2].
double square_speed(const StretchRows& rows) {
  double squares = 0, fourths = 0;
  for (std::size_t k = 1; k < rows.count(); ++k) {
    const double seconds = rows.times[k] - rows.times[k - 1];
    const Eigen::ArrayXd square = ((rows.values[k] - rows.values[k - 1]) / seconds).array().square();
    squares += seconds * square.sum(), fourths += seconds * square.square().sum();
  }
  return squares > 0 ? fourths / squares : 0;
}

/// Returns the sum of the fifth powers of successive ranges of each axis, times the third power of the speed.
double damage_of(const StretchRows& rows, double bound) {
  double sum = 0;
  for (long axis = 0; axis < rows.values.front().size(); ++axis) {
    double turn = rows.values.front()[axis], extreme = turn;
    for (const VectorXd& row : rows.values) {
      const double value = row[axis];
      if ((extreme - turn) * (value - extreme) >= 0) {
        extreme = value;
      } else if (std::abs(value - extreme) > bound) {
        sum += std::pow(std::abs(extreme - turn), damage_exponent);
        turn = extreme, extreme = value;
      }
    }
    sum += std::pow(std::abs(extreme - turn), damage_exponent);
  }
  return sum * std::pow(square_speed(rows), speed_exponent / 2);
}

/// Slows the motion near its ends, so that the speed there is 0: t' = 2 sqrt(P t) until t = P.
void add_ramps(StretchRows& rows, bool begins_at_rest) {
  const double length = rows.times.back(), part = std::min(ramp, length / 3);
  const auto delay = [&](double t) { return t < part ? 2 * std::sqrt(part * t) - t : part; };  // t' - t
  const bool at_begin = !begins_at_rest && rows.speed(0) > slow, at_end = rows.speed(rows.count() - 1) > slow;
  for (double& t : rows.times) {
    const double from_end = length - t;
    t += (at_begin ? delay(t) : 0) + (at_end ? part - delay(from_end) : 0);
  }
}

void close(StretchRows& rows) {
  std::vector<double> moved{0};
  for (std::size_t k = 1; k < rows.count(); ++k)
    moved.push_back(moved.back() + (rows.values[k] == rows.values[k - 1] ? 0 : rows.times[k] - rows.times[k - 1]));
  const VectorXd off = rows.values.back() - rows.values.front();
  for (std::size_t k = 1; k < rows.count(); ++k)  // a standstill at the end keeps equal rows
    rows.values[k] = moved[k] == moved.back() ? rows.values.front() : rows.values[k] - moved[k] / moved.back() * off;
}

/// Returns a closed motion that begins at another row.
StretchRows turned(const StretchRows& rows, std::size_t begin) {
  StretchRows made;
  const double length = rows.times.back(), start = rows.times[begin];
  for (std::size_t k = begin; k < rows.count(); ++k) made.add(rows.times[k] - start, rows.values[k]);
  for (std::size_t k = 1; k <= begin; ++k) made.add(rows.times[k] + length - start, rows.values[k]);
  return made;
}

std::size_t best_begin(const StretchRows& rows) {
  std::size_t best = 0;
  double longest = 0, slowest = INFINITY;
  for (std::size_t k = 1; k < rows.count(); ++k) {
    const double stand = rows.values[k] == rows.values[k - 1] ? rows.times[k] - rows.times[k - 1] : 0;
    if (stand > longest) longest = stand, best = k;
    if (longest == 0 && k + 1 < rows.count() && rows.speed(k) < slowest) slowest = rows.speed(k), best = k;
  }
  return best;
}

/// Damage of a part of Cycles::parts, and the part's index.
using DamagedPart = std::pair<double, std::size_t>;

/// Returns the motion that represents these parts.
LogMotion motion_for(const Course& course, const Cycles& cycles, std::span<const DamagedPart> damages) {
  LogMotion made;
  made.count = damages.size();
  double sum = 0, seconds = 0;
  for (const auto& [damage, k] : damages) {
    const CyclePart& part = cycles.parts[k];
    seconds += part.end - part.begin;
    made.difference = std::max(made.difference, part.difference);
    sum += damage;
  }
  const double mean = sum / static_cast<double>(made.count);
  made.part = std::ranges::min_element(damages, [&](const auto& a, const auto& b) {
                return std::abs(a.first - mean) < std::abs(b.first - mean);
              })->second;
  StretchRows rows = rows_between(course, cycles.parts[made.part].begin, cycles.parts[made.part].end);
  close(rows);
  rows = turned(rows, best_begin(rows));
  const bool stands =
      rows.values.back() == rows.values[rows.count() - 2];  // a standstill between its end and its begin
  if (stands) {  // waits differ between repeats: the wait is at most the mean
    const double wait = rows.times.back() - rows.times[rows.count() - 2];
    rows.times.back() -= std::clamp(rows.times.back() - seconds / static_cast<double>(made.count), 0.0, 0.9 * wait);
  }
  add_ramps(rows, stands);
  made.times = std::move(rows.times);
  made.rows = std::move(rows.values);
  return made;
}

void add_cycle(const Course& course, const Cycles& cycles, std::size_t cycle, double bound, int recordings,
               std::vector<LogMotion>& made) {
  std::vector<DamagedPart> damages;
  double seconds = 0;
  for (std::size_t k = 0; k < cycles.parts.size(); ++k)
    if (const CyclePart& part = cycles.parts[k]; part.cycle == cycle)
      damages.emplace_back(damage_of(rows_between(course, part.begin, part.end), bound), k),
          seconds += part.end - part.begin;
  std::ranges::sort(damages);
  const double cheap = std::max(few_recordings, recorded_seconds * static_cast<double>(damages.size()) / seconds);
  const std::size_t count =
      std::min({damages.size(), static_cast<std::size_t>(recordings), static_cast<std::size_t>(cheap)});
  const std::string name = fmt::format("cycle_{}", cycle + 1);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * damages.size() / count, end = (k + 1) * damages.size() / count;
    LogMotion& motion = made.emplace_back(motion_for(course, cycles, std::span(damages).subspan(begin, end - begin)));
    motion.name = k == 0 ? name : fmt::format("{}_{}", name, static_cast<char>('a' + k));
    if (count > 1) motion.recording_of = name;
  }
}

/// Returns the largest distance of a row from the first row.
double range_of(const StretchRows& rows) {
  double range = 0;
  for (const VectorXd& row : rows.values)
    range = std::max(range, (row - rows.values.front()).lpNorm<Eigen::Infinity>());
  return range;
}

/// Collects the rest as motions of limited length.
class Rest {
 public:
  Rest(std::vector<LogMotion>& made, double bound) : made_(made), bound_(bound) {}

  void add(const StretchRows& rows) {
    if (range_of(rows) <= bound_) return;  // a standstill between two cycles
    if (rows_.count() == 0) rows_.add(0, rows.values.front());
    const VectorXd off = rows_.values.back() - rows.values.front();
    const double fade = std::min(settling, rows.times.back());
    double begin = rows_.times.back();
    for (std::size_t k = 1; k < rows.count(); ++k) {
      const double s = std::min(1.0, rows.times[k] / fade);
      rows_.add(begin + rows.times[k], rows.values[k] + (1 - s) * (1 - s) * (1 + 2 * s) * off);
      const bool stands = rows_.values.back() == rows_.values[rows_.count() - 2];
      if ((stands && rows_.times.back() > long_rest) || rows_.times.back() > longest_rest ||
          rows_.count() >= most_rows_of_a_motion) {
        const VectorXd last = rows_.values.back();
        finish();
        begins_at_rest_ = stands;
        rows_.add(0, last);
        begin = -rows.times[k];
      }
    }
  }

  void finish() {
    if (range_of(rows_) > bound_) {
      add_ramps(rows_, begins_at_rest_);
      LogMotion motion;
      motion.name = fmt::format("rest_{}", ++count_);
      motion.is_rest = true;
      motion.times = std::move(rows_.times);
      motion.rows = std::move(rows_.values);
      made_.push_back(std::move(motion));
    }
    rows_ = {};
    begins_at_rest_ = false;
  }

 private:
  std::vector<LogMotion>& made_;
  double bound_;
  StretchRows rows_;
  int count_ = 0;
  bool begins_at_rest_ = false;
};

}  // namespace

std::vector<LogMotion> motions_of(const Course& course, const Cycles& cycles, double bound, int recordings) {
  std::vector<LogMotion> made;
  for (std::size_t cycle = 0; cycle < cycles.count; ++cycle) add_cycle(course, cycles, cycle, bound, recordings, made);
  Rest rest(made, bound);
  double begin = 0;
  const auto add = [&](double end) {
    if (end - begin > 2 * near_knots) rest.add(rows_between(course, begin, end));
  };
  for (const CyclePart& part : cycles.parts) {
    add(part.begin);
    begin = part.end;
  }
  add(course.duration());
  rest.finish();
  return made;
}

void end_at_samples(std::vector<LogMotion>& motions, double rate) {
  constexpr double digits = 1e6,
                   rounding = 1e-6;  // of times in motion_csv(): a time above the sample would need another one
  for (LogMotion& motion : motions) {
    const std::size_t last = motion.rows.size() - 1;
    double& end = motion.times[last];
    const double earlier = std::floor(end * rate + rounding) / rate;
    const bool stands = motion.rows[last] == motion.rows[last - 1] && earlier > motion.times[last - 1] + near_knots;
    end = std::floor((stands ? earlier : std::ceil(end * rate - rounding) / rate) * digits + rounding) / digits;
  }
}

std::string motion_csv(const LogMotion& motion) {
  std::string text = "time_s";
  for (long axis = 0; axis < motion.rows.front().size(); ++axis) text += fmt::format(",axis_{}_deg", axis + 1);
  text += '\n';
  for (std::size_t k = 0; k < motion.rows.size(); ++k) {
    text += fmt::format("{:.6f}", motion.times[k]);
    for (const double angle : motion.rows[k]) text += fmt::format(",{:.5f}", angle * 180 / std::numbers::pi);
    text += '\n';
  }
  return text;
}

}  // namespace dresslife::sim
