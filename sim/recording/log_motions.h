// The motions of a log: one per cycle that repeats, and the rest. Rows of joint angles with times, for
// motion.rows: spline.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/recording/cycles.h"

namespace dresslife::sim {

struct LogMotion {
  std::string name;                   ///< cycle_1, cycle_1_b, rest_1
  std::vector<double> times;          ///< [s] from 0
  std::vector<Eigen::VectorXd> rows;  ///< (axis) [rad]
  std::size_t count = 1;              ///< in the log
  double difference = 0;              ///< of the parts from the cycle, at most [rad]
  bool is_rest = false;
  std::string recording_of;  ///< "cycle_1" of its recordings cycle_1, cycle_1_b; empty: there is one
  std::size_t part = 0;  ///< of Cycles::parts that it is taken from; of a rest not used

  double duration() const { return times.back(); }
};

/// A cycle has up to `recordings` motions; more than three only as far as they take 600 s together. Its parts are in the order of their
/// damage, by the sum of the fifth powers of the axes' successive ranges (the slope of strain-life curves of copper is near it) times the
/// third power of their speed, and cut into so many groups. A motion is the part whose damage is nearest to the mean
/// of its group. It is turned so that it begins
/// behind its longest stand, else at its slowest moment, and closed: the difference of its ends, within the bound, is
/// spread over its motion. Its longest stand is shortened if the cycle takes longer than the mean of those alike. The
/// rest has the cycles taken out. Where they were, a difference of poses vanishes within 1 s. It is cut at stands
/// after 200 s, or anywhere after 300 s or 50,000 rows. A motion that begins or ends in motion gets a ramp
/// of 0.3 s.
std::vector<LogMotion> motions_of(const Course& course, const Cycles& cycles, double bound, int recordings);

/// A table with the columns time_s and axis_1_deg ..
std::string motion_csv(const LogMotion& motion);

}  // namespace dresslife::sim
