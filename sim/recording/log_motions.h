// The motions of a log: one per cycle that repeats, and the rest. Each is a table of joint angles with times, for
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
  std::size_t count = 1;              ///< number of occurrences in the log
  double difference = 0;              ///< largest difference of the parts from the cycle [rad]
  bool is_rest = false;
  std::string recording_of;  ///< "cycle_1" for its recordings cycle_1, cycle_1_b; empty: only one recording
  std::size_t part = 0;      ///< index in Cycles::parts of its source; not used for a rest

  double duration() const { return times.back(); }
};

/// Returns the motions. A cycle has up to `recordings` motions, but more than three only if they take 600 s or less together. Its
/// parts are sorted by their expected damage: the sum of the fifth powers of the axes' successive ranges (near the slope of
/// strain-life curves of copper), times the third power of the speed. They are divided into this number of groups. A motion is the part whose damage is nearest to the mean of its group. It is rotated in
/// time so that it begins after its longest standstill, else at its slowest moment, and closed: the difference of its ends,
/// within the bound, is distributed over its motion. Its longest standstill is shortened if the cycle takes longer than the mean
/// of its group. The rest is the log without the cycles. At their places a difference of poses vanishes within 1 s. The rest is
/// divided at standstills after 200 s, or anywhere after 300 s or 50,000 rows. A motion that begins or ends with a speed gets a
/// ramp of 0.3 s.
std::vector<LogMotion> motions_of(const Course& course, const Cycles& cycles, double bound, int recordings);

/// Moves the ends of motions to samples of the simulation [Hz], which ends at one. A standstill at the end becomes shorter by less
/// than an interval, so that the cycles fit into the time of the log. Another end comes later.
void end_at_samples(std::vector<LogMotion>& motions, double rate);

/// Returns a table with the columns time_s and axis_1_deg ..
std::string motion_csv(const LogMotion& motion);

}  // namespace dresslife::sim
