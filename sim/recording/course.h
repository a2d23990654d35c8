// The course of the axes in a log: smooth, without long standstills and without gaps.
//
// Between two standstills the course is a cubic spline (R5) at rest at both ends. A log with rows closer than 0.04 s is
// smoothed before: knots every 0.05 s, the value of each from a parabola through the rows within 0.05 s of it (least
// squares). If the distance between the course and a row exceeds the bound, knots are added at half the distance, twice; if this
// is not enough, the rows themselves become knots. So noise of half the bound does not become acceleration, and no
// row is farther from the course than the bound. Rows at distances of 0.04 s or more are knots: there noise n gives an
// acceleration of about 12 n / (0.04 s)^2, 380 deg/s2 for 0.05 deg, and 60 deg/s2 at 10 Hz. Axes of robots reach 300 to 3,000
// deg/s2.
//
// Standstills count at most 3 s, because then the hose is at rest. A gap is longer than 5 intervals and 0.5 s, and the
// robot moved farther in it than in two intervals at full speed. It is replaced by a move from rest to rest with at most half the
// axes' speeds; its time is not counted.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"
#include "sim/recording/log_file.h"
#include "sim/robot/spline.h"

namespace dresslife::sim {

/// The fastest moment of an axis that exceeds its limit.
struct TooFast {
  std::string axis;
  double speed = 0, limit = 0;  ///< [rad/s]
  double time = 0;              ///< time in the log [s]
  std::uint32_t line = 0;
  std::size_t knots = 0;  ///< number of knots with a speed above the limit
};

class Course {
 public:
  /// still: bound of the smoothing [rad]. A recording of fewer than two rows has no course. Throws no errors.
  Course(const Recording& log, const pipeline::Robot& robot, double still);

  std::size_t axes() const { return axes_; }
  double duration() const { return times_.empty() ? 0 : times_.back(); }  ///< [s]
  Eigen::VectorXd at(double time) const;                                  ///< (axis) [rad]
  std::uint32_t line(double time) const;                       ///< line of the log, the last one before this time
  const std::vector<double>& knots() const { return times_; }  ///< [s]
  Eigen::VectorXd knot(std::size_t k) const {
    return Eigen::Map<const Eigen::VectorXd>(&angles_[k * axes_], static_cast<long>(axes_));
  }
  /// Returns whether the robot stands still from knot k to the next.
  bool stands(std::size_t k) const;

  double log_seconds = 0;    ///< time of the log without gaps
  double stand_seconds = 0;  ///< part of log_seconds in which the robot stands still
  int gaps = 0;
  double gap_seconds = 0;
  double largest_smoothing = 0;   ///< largest distance of a row from the course [rad]
  std::vector<TooFast> too_fast;  ///< one for each axis that exceeds its limit
  std::vector<double> fastest;    ///< (axis) [rad/s]

 private:
  struct Run {
    std::size_t begin, end;  // knots
    CubicSpline spline;
  };
  void add(double time, const double* angles, std::uint32_t line, double logged);
  void cut(const Recording& log, const pipeline::Robot& robot);
  void smooth(double interval, double still);
  void check_speeds(const pipeline::Robot& robot);

  std::size_t axes_;
  std::vector<double> times_, angles_, logged_;  // knots: [s]; (knot, axis) [rad]; [s] of the log
  std::vector<std::uint32_t> lines_;
  std::vector<Run> runs_;
};

}  // namespace dresslife::sim
