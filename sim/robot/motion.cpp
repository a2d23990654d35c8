#include "sim/robot/motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pipeline/base/halving.h"

#include "sim/robot/legs.h"
#include "sim/robot/path_motion.h"
#include "sim/robot/robot.h"
#include "sim/robot/spline.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

// sigma' for ramps with the share r; its largest value is 1/(1 - r).
double slope(double r, double u) { return std::min({u / r, 1.0, (1 - u) / r}) / (1 - r); }

double rise(double r, double u) {
  if (u < r) return u * u / (2 * r * (1 - r));
  if (u > 1 - r) return 1 - rise(r, 1 - u);
  return (u - r / 2) / (1 - r);
}

/// Returns S(u), the integral of sigma from 0. Above the middle it uses the symmetry sigma(u) = 1 - sigma(1 - u).
double integrated_rise(double r, double u) {
  if (u < r) return u * u * u / (6 * r * (1 - r));
  if (u > 1 - r) return u - 0.5 + integrated_rise(r, 1 - u);
  return ((u - r) * u / 2 + r * r / 6) / (1 - r);
}

/// Returns A_i (M2) of every axis [rad/s2].
VectorXd mean_accelerations(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  const std::vector<Axis> axes = axes_of(robot);
  VectorXd accelerations(static_cast<long>(axes.size()));
  for (long i = 0; i < accelerations.size(); ++i)
    accelerations[i] = (1 - motion.ramp_percent / 100) * axes[i].acceleration * motion.acceleration_percent / 100;
  return accelerations;
}

/// Returns the highest speed that a leg with a jerk limit reaches over this length between two speeds (M13). Uses bisection,
/// because the length increases with the speed.
double reached_speed(const Leg& leg, double length, double v0, double v1) {
  const auto way = [&](double top) {
    return (v0 + top) / 2 * change_on(leg, top - v0).duration + (top + v1) / 2 * change_on(leg, top - v1).duration;
  };
  const double low = std::max(v0, v1), high = std::max(leg.cruise, low);
  if (way(high) <= length) return high;
  return pipeline::halved(low, high, 50, [&](double top) { return way(top) <= length; }).low;  // 2^-50 of the speed
}

/// The transition from leg k to leg k + 1.
struct Corner {
  double limit = 0;                                    // w [rad/s]
  double in = 0, out = 0;                              // speeds v, v' [rad/s]
  double duration = 0;                                 // tau [s]
  double ramp = 0;                                     // r
  double before() const { return in * duration / 2; }  // begin and end of the blend, as distances from the waypoint
  double after() const { return out * duration / 2; }
};

// ---- speeds at the corners (M4), (M5) --------------------------------------------------------------------

class CornerSpeeds {
 public:
  /// jerks: J_i of (M13), then accelerations are a_i; empty: accelerations are A_i.
  CornerSpeeds(const std::vector<Leg>& legs, const VectorXd& accelerations, const VectorXd& jerks)
      : legs_(legs), accelerations_(accelerations), jerks_(jerks), corners_(legs.size()) {
    for (size_t k = 0; k + 1 < legs.size(); ++k) {
      if (legs[k].dwell > 0 || legs[k + 1].dwell > 0 || legs[k].zone == 0) continue;
      const double top = std::max(legs[k].cruise, legs[k + 1].cruise);
      corners_[k] = slowed(k, top, [&](const Corner& corner) { return fits(k, corner); });
    }
    while (sweep()) {
    }
  }

  /// Returns the corner at the end of leg k; before the first leg (k = -1) and after the last the robot stands still.
  const Corner& at_end(int k) const { return k < 0 ? still_ : corners_[k]; }

 private:
  Corner corner(size_t k, double limit) const {
    const Leg &leg = legs_[k], &next = legs_[k + 1], &softer = leg.ramp > next.ramp ? leg : next;
    Corner c{limit, std::min(limit, leg.cruise), std::min(limit, next.cruise), 0, softer.ramp};
    const VectorXd change = (c.out * next.direction - c.in * leg.direction).cwiseAbs();
    const double at_full = change.cwiseQuotient(accelerations_).maxCoeff();
    if (jerks_.size() == 0) {
      c.duration = at_full / softer.slowing;
    } else if (at_full > 0) {
      const double by_jerk = change.cwiseQuotient(jerks_).maxCoeff() / std::min(leg.jerk, next.jerk);
      const SpeedChange limited = limited_change(at_full, by_jerk);
      c.duration = limited.duration, c.ramp = limited.ramp;
    }
    return c;
  }

  bool fits(size_t k, const Corner& c) const {  // (M4)
    const double zone = legs_[k].zone;
    return c.before() <= std::min(zone, legs_[k].length / 2) &&
           c.after() <= std::min(legs_[k].zone_behind, legs_[k + 1].length / 2);
  }

  /// Returns the fastest corner up to `limit` for which `good` is true, by bisection; a stop if none is found.
  template <class Good>
  Corner slowed(size_t k, double limit, const Good& good) const {
    if (const Corner fastest = corner(k, limit); good(fastest)) return fastest;
    Corner best;
    double low = 0, high = limit;
    for (int i = 0; i < 50; ++i) {  // relative error 2^-50
      const Corner middle = corner(k, (low + high) / 2);
      (good(middle) ? low : high) = middle.limit;
      if (good(middle)) best = middle;
    }
    return best;
  }

  bool long_enough(size_t k, double v0, double before, double v1, double after) const {
    const Leg& leg = legs_[k];
    if (jerks_.size() > 0)
      return (v0 + v1) / 2 * change_on(leg, std::abs(v1 - v0)).duration <= leg.length - before - after;
    return std::abs(v1 * v1 - v0 * v0) <= 2 * leg.acceleration * (leg.length - before - after);
  }

  /// Reduces the speed at the faster end of every leg that is too short to change speed. Returns false if all legs are long
  /// enough.
  bool sweep() {
    bool changed = false;
    const int count = static_cast<int>(legs_.size());
    for (int pass = 0; pass < 2; ++pass)  // forward: too fast at the end of a leg; backward: too fast at its begin
      for (int i = 0; i < count; ++i) changed |= correct(pass == 0 ? i : count - 1 - i);
    return changed;
  }

  bool correct(int k) {
    if (legs_[k].dwell > 0) return false;
    const Corner entry = at_end(k - 1), exit = at_end(k);
    if (long_enough(k, entry.out, entry.after(), exit.in, exit.before())) return false;
    // At least a thousandth slower, so that the sweeps terminate.
    if (exit.in > entry.out) {
      corners_[k] = slowed(k, 0.999 * exit.limit, [&](const Corner& c) {
        return fits(k, c) && (c.in <= entry.out || long_enough(k, entry.out, entry.after(), c.in, c.before()));
      });
    } else {
      corners_[k - 1] = slowed(k - 1, 0.999 * entry.limit, [&](const Corner& c) {
        return fits(k - 1, c) && (c.out <= exit.in || long_enough(k, c.out, c.after(), exit.in, exit.before()));
      });
    }
    return true;
  }

  const std::vector<Leg>& legs_;
  const VectorXd &accelerations_, &jerks_;
  std::vector<Corner> corners_;
  Corner still_;
};

// ---- legs into pieces ------------------------------------------------------------------------------------

class Pieces {
 public:
  std::vector<MotionPiece> pieces;
  double time = 0;

  void add(const VectorXd& position, const VectorXd& before, const VectorXd& after, double duration, int step,
           int step_after, double ramp) {
    if (duration <= 0) return;
    pieces.push_back({time, duration, position, before, after - before, step, step_after, ramp});
    time += duration;
  }

  void append(std::vector<MotionPiece> more) {
    if (more.empty()) return;
    time = more.back().start + more.back().duration;
    std::move(more.begin(), more.end(), std::back_inserter(pieces));
  }

  /// Adds the part of a leg between its blends: acceleration to the top speed, constant speed, deceleration (M3).
  void add_leg(const Leg& leg, const Corner& entry, const Corner& exit) {
    const double v0 = entry.out, v1 = exit.in, twice = 2 * leg.acceleration;
    const double length = leg.length - entry.after() - exit.before();
    const double reached =
        leg.jerk_limit > 0 ? reached_speed(leg, length, v0, v1) : std::sqrt((twice * length + v0 * v0 + v1 * v1) / 2);
    const double top = std::max({std::min(leg.cruise, reached), v0, v1});
    const SpeedChange rise = change_on(leg, top - v0), fall = change_on(leg, top - v1);
    const auto way = [&](double v, const SpeedChange& change) {
      return leg.jerk_limit > 0 ? (top + v) / 2 * change.duration : (top * top - v * v) / twice;
    };
    const double up = way(v0, rise), down = way(v1, fall);
    const double along = std::max(0.0, length - up - down);
    const auto at = [&](double s) { return VectorXd(leg.from + (entry.after() + s) * leg.direction); };
    const auto speed = [&](double v) { return VectorXd(v * leg.direction); };
    add(at(0), speed(v0), speed(top), rise.duration, leg.step, leg.step, rise.ramp);
    add(at(up), speed(top), speed(top), along / top, leg.step, leg.step, leg.ramp);
    add(at(up + along), speed(top), speed(v1), fall.duration, leg.step, leg.step, fall.ramp);
  }

  void add_blend(const Leg& leg, const Leg& next, const Corner& corner) {
    add(next.from - corner.before() * leg.direction, corner.in * leg.direction, corner.out * next.direction,
        corner.duration, leg.step, next.step, corner.ramp);
  }
};

/// Adds legs that belong to no path, one by one.
void add_legs(const std::vector<Leg>& legs, const VectorXd& accelerations, const VectorXd& jerks, Pieces& pieces) {
  const CornerSpeeds corners(legs, accelerations, jerks);
  for (int k = 0; k < static_cast<int>(legs.size()); ++k) {
    const Leg& leg = legs[k];
    if (leg.dwell > 0) {
      const VectorXd rest = VectorXd::Zero(leg.from.size());
      pieces.add(leg.from, rest, rest, leg.dwell, leg.step, leg.step, leg.ramp);
      continue;
    }
    pieces.add_leg(leg, corners.at_end(k - 1), corners.at_end(k));
    if (corners.at_end(k).limit > 0) pieces.add_blend(leg, legs[k + 1], corners.at_end(k));
  }
}

/// Returns the motion through the rows of a recording (M12).
std::vector<MotionPiece> spline_pieces(const pipeline::Motion& motion, const std::vector<VectorXd>& rows) {
  std::vector<double> times{0};
  for (std::size_t k = 1; k < motion.steps.size(); ++k) {
    const pipeline::MotionStep& step = motion.steps[k];
    if (!step.duration || step.path != pipeline::PathKind::joint || step.dwell > 0)
      throw pipeline::InputError(step.where,
                                 "is no joint move with a duration (motion.rows: spline needs all moves to be)",
                                 "give joint angles with times, or leave out motion.rows");
    times.push_back(times.back() + *step.duration * 100 / motion.override_percent);
  }
  std::vector<MotionPiece> pieces;
  const auto add = [&](std::size_t row, const VectorXd& velocity, const VectorXd& acceleration, const VectorXd& jerk) {
    const int step = static_cast<int>(row) + 1;
    pieces.push_back({times[row], times[row + 1] - times[row], rows[row], velocity, VectorXd(), step, step, 0.25,
                      acceleration, jerk});
  };
  const VectorXd none = VectorXd::Zero(rows.front().size());
  for (std::size_t begin = 0, end; begin + 1 < rows.size(); begin = end) {
    end = begin + 1;
    if (rows[begin] == rows[end]) {
      add(begin, none, none, none);
      continue;
    }
    while (end + 1 < rows.size() && rows[end] != rows[end + 1]) ++end;
    Eigen::MatrixXd values(none.size(), static_cast<long>(end - begin) + 1);
    for (std::size_t row = begin; row <= end; ++row) values.col(static_cast<long>(row - begin)) = rows[row];
    const CubicSpline spline({times.begin() + static_cast<long>(begin), times.begin() + static_cast<long>(end) + 1},
                             std::move(values), SplineEnds::at_rest);
    for (long k = 0; k < static_cast<long>(end - begin); ++k) {
      const auto& second = spline.second_derivatives();
      const double h = spline.times()[k + 1] - spline.times()[k];
      add(begin + static_cast<std::size_t>(k), spline.slope(k), second.col(k), (second.col(k + 1) - second.col(k)) / h);
    }
  }
  return pieces;
}

/// Returns h (M10) of a chain: the acceleration of the tool rises within 2 h.
double smoothing_of(const pipeline::Motion& motion, const std::vector<Leg>& legs) {
  if (!motion.path_jerk) return motion.path_smoothing;
  double most = 0;  // acceleration of the tool [m/s2]
  for (const Leg& leg : legs) most = std::max(most, leg.tool_share * leg.acceleration);
  constexpr double shortest = 1e-3;  // smallest value of motion.path_smoothing_ms
  return most > 0 ? std::max(shortest, most / (2 * *motion.path_jerk)) : motion.path_smoothing;
}

AxisLimits limits_of(const pipeline::Robot& robot, double override_percent) {
  const std::vector<Axis> axes = axes_of(robot);
  AxisLimits limits{VectorXd(static_cast<long>(axes.size())), VectorXd(static_cast<long>(axes.size()))};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    limits.speed[static_cast<long>(i)] = axes[i].speed * override_percent / 100;
    limits.acceleration[static_cast<long>(i)] = axes[i].acceleration;
  }
  return limits;
}

}  // namespace

JointMotion::JointMotion(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  const VectorXd accelerations = mean_accelerations(motion, robot);
  Legs program = legs_of(motion, robot, accelerations);
  if (motion.rows == pipeline::RecordedRows::spline) program.legs.clear();
  const AxisLimits limits = limits_of(robot, motion.override_percent);
  const VectorXd jerks = motion.jerk ? jerk_limits(motion, robot) : VectorXd();
  const VectorXd full = limits.acceleration * (motion.acceleration_percent / 100);
  Pieces pieces;
  if (motion.rows == pipeline::RecordedRows::spline) pieces.append(spline_pieces(motion, program.targets));
  for (auto begin = program.legs.begin(); begin != program.legs.end();) {
    const auto end = std::find_if(begin, program.legs.end(), [&](const Leg& leg) { return leg.path != begin->path; });
    const std::vector<Leg> legs(begin, end);
    if (begin->path == 0)
      add_legs(legs, motion.jerk ? full : accelerations, jerks, pieces);
    else
      pieces.append(path_pieces(legs, accelerations, limits, smoothing_of(motion, legs), pieces.time));
    begin = end;
  }
  duration_ = pieces.time;
  // The standstill at the end, of any duration; a program without motion consists of it.
  const int last = static_cast<int>(program.texts.size()) - 1;
  const VectorXd rest = VectorXd::Zero(program.place.size());
  pieces.pieces.push_back({duration_, 1, program.place, rest, rest, last, last});
  pieces_ = std::move(pieces.pieces);
  step_texts_ = std::move(program.texts);
}

void JointMotion::hold(std::size_t axis) {
  const auto of = static_cast<Eigen::Index>(axis);
  const auto [low, high] = std::ranges::minmax_element(
      pieces_, [&](const auto& a, const auto& b) { return a.position[of] < b.position[of]; });
  const double middle = (low->position[of] + high->position[of]) / 2;
  for (MotionPiece& piece : pieces_) {
    piece.position[of] = middle;
    piece.velocity_before[of] = 0;
    if (piece.velocity_change.size() > 0) piece.velocity_change[of] = 0;
    if (piece.jerk.size() > 0) piece.acceleration[of] = piece.jerk[of] = 0;
  }
}

void JointMotion::shorten_waits(double longest) {
  const auto stands = [](const MotionPiece& piece) {
    return piece.velocity_before.isZero(0) && piece.velocity_change.isZero(0) && piece.acceleration.isZero(0) &&
           piece.jerk.isZero(0);
  };
  std::vector<MotionPiece> kept;
  double stood = 0, missing = 0;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    MotionPiece& piece = pieces_[k];
    piece.start -= missing;
    if (k + 1 == pieces_.size()) {  // the standstill after the end
      duration_ = piece.start;
      kept.push_back(std::move(piece));
      break;
    }
    stood = stands(piece) ? stood + piece.duration : 0;
    if (const double more = std::min(stood - longest, piece.duration); more > 0) {
      piece.duration -= more;
      missing += more;
      cuts_.push_back({piece.start + piece.duration, more});
    }
    if (piece.duration > 0) kept.push_back(std::move(piece));
  }
  pieces_ = std::move(kept);
}

double JointMotion::program_time(double time) const {
  double missing = 0;
  for (const Cut& cut : cuts_)
    if (cut.time <= time) missing += cut.missing;
  return time + missing;
}

const MotionPiece& JointMotion::piece_at(double time) const {
  const auto after = std::ranges::upper_bound(pieces_, time, {}, &MotionPiece::start);
  return after == pieces_.begin() ? *after : *(after - 1);
}

namespace {

/// Returns u of (M1).
double fraction(const MotionPiece& piece, double time) {
  return std::clamp((time - piece.start) / piece.duration, 0.0, 1.0);
}

}  // namespace

VectorXd JointMotion::position(double time) const {
  const MotionPiece& piece = piece_at(time);
  const double u = fraction(piece, time), t = u * piece.duration;
  if (piece.jerk.size() > 0)
    return piece.position + t * (piece.velocity_before + t / 2 * (piece.acceleration + t / 3 * piece.jerk));
  return piece.position +
         piece.duration * (u * piece.velocity_before + integrated_rise(piece.ramp, u) * piece.velocity_change);
}

VectorXd JointMotion::velocity(double time) const {
  const MotionPiece& piece = piece_at(time);
  const double u = fraction(piece, time), t = u * piece.duration;
  if (piece.jerk.size() > 0) return piece.velocity_before + t * (piece.acceleration + t / 2 * piece.jerk);
  return piece.velocity_before + rise(piece.ramp, u) * piece.velocity_change;
}

VectorXd JointMotion::acceleration(double time) const {
  const MotionPiece& piece = piece_at(time);
  const double u = fraction(piece, time);
  if (piece.jerk.size() > 0) return piece.acceleration + u * piece.duration * piece.jerk;
  return slope(piece.ramp, u) / piece.duration * piece.velocity_change;
}

int JointMotion::step(double time) const {
  const MotionPiece& piece = piece_at(time);
  return fraction(piece, time) < 0.5 ? piece.step : piece.step_after;
}

}  // namespace dresslife::sim
