#include "sim/robot/path_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double curvature_share = 0.7;   // of A_i, for the acceleration by the curvature of a path
constexpr int rounds = 30;                // of reducing the speed where a limit is exceeded
constexpr double least_lowering = 0.995;  // of a squared speed, so that the rounds make progress
// ratio of squared speeds: smaller differences belong to legs of one line, not to two programmed speeds
constexpr double alike = 1.05;
constexpr double slowest = 1e-9;  // speed at a leg's end inside a path [rad/s]: the robot never stands still there

double quotient(const VectorXd& numerator, const VectorXd& denominator) {
  return numerator.cwiseAbs().cwiseQuotient(denominator).maxCoeff();
}

/// The curve (M8) and its speed profile (M9).
class Profile {
 public:
  Profile(std::span<const Leg> legs, const VectorXd& planned)
      : legs_(legs), planned_(planned), lowered_(legs.size(), 1) {
    for (const Leg& leg : legs) place_.push_back(leg.from);
    place_.push_back(legs.back().from + legs.back().length * legs.back().direction);
    for (std::size_t k = 0; k <= legs.size(); ++k) {
      slope_.push_back(slope(k));
      bend_.push_back(k == 0 || k == legs.size() ? VectorXd::Zero(planned.size())
                                                 : VectorXd((legs[k].direction - legs[k - 1].direction).cwiseAbs() /
                                                            ((legs[k].length + legs[k - 1].length) / 2)));
    }
  }

  /// Computes the speeds at the legs' ends and the times at which they are passed.
  void lay_out() {
    const std::size_t n = legs_.size();
    squared_.assign(n + 1, 0);
    for (std::size_t k = 1; k < n; ++k) {
      // Between legs of one line the mean is nearer to the tool's speed than the lower speed.
      const double before = cap(k - 1), behind = cap(k), slower = std::min(before, behind);
      const double mean = (before + behind) / 2, cruise = mean < alike * slower ? mean : slower;
      const double bent = quotient(bend_[k], curvature_share * planned_);
      squared_[k] = std::max(bent > 0 ? std::min(cruise, 1 / bent) : cruise, slowest * slowest);
    }
    for (std::size_t k = 0; k < n; ++k) squared_[k + 1] = std::min(squared_[k + 1], reachable(k, squared_[k]));
    for (std::size_t k = n; k-- > 0;) squared_[k] = std::min(squared_[k], reachable(k, squared_[k + 1]));
    times_.assign(1, 0);
    for (std::size_t k = 0; k < n; ++k) times_.push_back(times_.back() + time_on(k));
  }

  double duration() const { return times_.back(); }
  std::size_t leg_at(double time) const {
    const auto after = std::ranges::upper_bound(times_, time);
    return static_cast<std::size_t>(
        std::clamp<long>(after - times_.begin() - 1, 0, static_cast<long>(legs_.size()) - 1));
  }

  VectorXd at(double time) const {
    if (time >= duration()) return place_.back();
    const std::size_t k = leg_at(time);
    const double length = legs_[k].length, s = way_on(k, time - times_[k]), u = s / length, v = 1 - u;
    return v * v * (1 + 2 * u) * place_[k] + u * u * (1 + 2 * v) * place_[k + 1] +
           u * v * length * (v * slope_[k] - u * slope_[k + 1]);
  }

  /// Reduces the squared speed on the legs that are passed between two times to this share of its present value.
  void lower(double from, double to, double share) {
    for (std::size_t k = leg_at(from); k <= leg_at(to); ++k) lowered_[k] = std::min(lowered_[k], share * now(k));
  }

 private:
  /// Returns the largest squared speed on leg k.
  double cap(std::size_t k) const { return lowered_[k] * legs_[k].cruise * legs_[k].cruise; }

  /// Returns the present squared speed as a share of the squared cruising speed.
  double now(std::size_t k) const {
    const double top = course(k).top;
    return std::min(lowered_[k], top * top / (legs_[k].cruise * legs_[k].cruise));
  }

  VectorXd slope(std::size_t k) const {
    const std::size_t n = legs_.size();
    if (k == 0 || (k < n && legs_[k].straight)) return legs_[std::min(k, n - 1)].direction;
    if (k == n || legs_[k - 1].straight) return legs_[k - 1].direction;
    const double before = legs_[k - 1].length, behind = legs_[k].length;
    return (behind * legs_[k - 1].direction + before * legs_[k].direction) / (before + behind);
  }

  /// Returns the acceleration that leg k can use to change its speed, from this squared speed.
  double acceleration(std::size_t k, double squared) const {
    const VectorXd bend = bend_[k].cwiseMax(bend_[k + 1]);
    const VectorXd left = (planned_ - squared * bend).cwiseMax((1 - curvature_share) * planned_);
    double least = legs_[k].acceleration;
    for (long i = 0; i < left.size(); ++i)
      if (const double way = std::abs(legs_[k].direction[i]); way > 0) least = std::min(least, left[i] / way);
    return least;
  }
  /// Returns the squared speed that can be reached at the other end of leg k, from this squared speed at one end.
  double reachable(std::size_t k, double from) const { return from + 2 * acceleration(k, from) * legs_[k].length; }

  /// Motion on leg k: acceleration to the top speed, constant speed, deceleration. Only a whole joint move has a separate top
  /// speed.
  struct Course {
    double acceleration, begin, top, end;  // speeds
    double up, along, down;                // times
    double way_up;
  };
  Course course(std::size_t k) const {
    const double low = std::min(squared_[k], squared_[k + 1]), high = std::max(squared_[k], squared_[k + 1]);
    const double length = legs_[k].length;
    // Along one line the speed changes uniformly, so that the tool's mean speed over a leg is the programmed one.
    const bool even = !legs_[k].straight && high > low && high < alike * low;
    const double a = even ? (high - low) / (2 * length) : acceleration(k, low);
    double top = high;
    if (legs_[k].straight) top = std::max(high, std::min(cap(k), (low + high + 2 * a * length) / 2));
    Course c{a, std::sqrt(squared_[k]), std::sqrt(top), std::sqrt(squared_[k + 1]), 0, 0, 0, 0};
    if (top == 0) {  // a path of one leg: from rest to rest
      c.top = std::sqrt(std::min(cap(k), a * length));
      top = c.top * c.top;
    }
    c.way_up = (top - squared_[k]) / (2 * a);
    const double way_down = (top - squared_[k + 1]) / (2 * a);
    // from the ways: the speeds of an even leg may be equal but for rounding
    c.up = 2 * c.way_up / (c.begin + c.top);
    c.along = std::max(0.0, length - c.way_up - way_down) / c.top;
    c.down = 2 * way_down / (c.top + c.end);
    return c;
  }
  double time_on(std::size_t k) const {
    const Course c = course(k);
    return c.up + c.along + c.down;
  }
  double way_on(std::size_t k, double time) const {
    const Course c = course(k);
    if (time < c.up) return (c.begin + c.acceleration * time / 2) * time;
    if (time < c.up + c.along) return c.way_up + c.top * (time - c.up);
    const double left = std::max(0.0, c.up + c.along + c.down - time);
    return legs_[k].length - (c.end + c.acceleration * left / 2) * left;
  }

  std::span<const Leg> legs_;
  const VectorXd& planned_;
  std::vector<double> lowered_;                 // shares of the squared cruising speeds
  std::vector<VectorXd> place_, slope_, bend_;  // at the legs' ends: q, q_s, |q_ss|
  std::vector<double> squared_, times_;         // at the legs' ends: u^2, t
};

struct Controls {
  double step;  // h [s]
  std::vector<VectorXd> points;
  std::vector<std::size_t> legs;  // index of the leg of each point
};

Controls controls_of(const Profile& profile, double step) {
  Controls made{step, {}, {}};
  const auto add = [&](double time, int times) {
    for (int i = 0; i < times; ++i) {
      made.points.push_back(profile.at(time));
      made.legs.push_back(profile.leg_at(time));
    }
  };
  constexpr double rounded = 1e-9;  // of a step: a duration of whole steps but for rounding takes no step more
  const int last = std::max(1, static_cast<int>(std::ceil(profile.duration() / step - rounded)));
  add(0, 3);
  for (int j = 1; j < last; ++j) add(j * step, 1);
  add(profile.duration(), 3);
  return made;
}

/// Returns the violation at control point j: squared speeds as a share of the allowed ones.
double excess(const Controls& c, std::size_t j, const AxisLimits& limits) {
  const double speed = quotient(c.points[j + 1] - c.points[j], limits.speed) / c.step;
  double worst = speed * speed;
  if (j > 0)
    worst = std::max(
        worst, quotient(c.points[j + 1] - 2 * c.points[j] + c.points[j - 1], limits.acceleration) / (c.step * c.step));
  return worst;
}

}  // namespace

std::vector<MotionPiece> path_pieces(std::span<const Leg> legs, const VectorXd& planned, const AxisLimits& limits,
                                     double smoothing, double start) {
  assert(!legs.empty());
  const double least_jerk = std::ranges::min_element(legs, {}, &Leg::jerk)->jerk;
  const double step = smoothing / least_jerk;
  Profile profile(legs, planned);
  Controls controls{};
  double worst = 0;
  for (int round = 0; round < rounds; ++round) {
    profile.lay_out();
    controls = controls_of(profile, step);
    worst = 0;
    for (std::size_t j = 0; j + 1 < controls.points.size(); ++j) {
      const double over = excess(controls, j, limits);
      worst = std::max(worst, over);
      const double time = (static_cast<double>(j) - 2) * step;  // time of control point j
      if (over > 1)
        profile.lower(std::max(0.0, time - step), std::min(profile.duration(), time + step),
                      std::min(least_lowering, 1 / over));
    }
    if (worst <= 1) break;
  }
  const double h = step * std::sqrt(std::max(1.0, worst));  // (M10)
  std::vector<MotionPiece> pieces;
  for (std::size_t j = 0; j + 3 < controls.points.size(); ++j) {
    const VectorXd &p0 = controls.points[j], &p1 = controls.points[j + 1], &p2 = controls.points[j + 2],
                   &p3 = controls.points[j + 3];
    MotionPiece piece;
    piece.start = start + static_cast<double>(j) * h;
    piece.duration = h;
    piece.position = (p0 + 4 * p1 + p2) / 6;
    piece.velocity_before = (p2 - p0) / (2 * h);
    piece.acceleration = (p0 - 2 * p1 + p2) / (h * h);
    piece.jerk = (p3 - 3 * p2 + 3 * p1 - p0) / (h * h * h);
    piece.velocity_change = h * (piece.acceleration + h / 2 * piece.jerk);
    piece.step = legs[controls.legs[j + 1]].step;
    piece.step_after = legs[controls.legs[j + 2]].step;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace dresslife::sim
