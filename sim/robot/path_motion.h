// The time law of a tool path: one speed profile from stop to stop, and smooth motion of the axes along the path.
//
// A path is a chain of short legs in joint space with lengths L_k (largest axis), each with the largest speed
// c_k that its axes and its tool allow. If they were computed one by one like joint moves (motion.h), every leg would
// have separate accelerations, at 40 Hz for points 10 mm apart at 0.4 m/s. Instead:
// (M8) q(s): a curve of cubics passes through the ends of the legs, s is the length along the legs. The slope at an
//      end is that of the parabola through it and its neighbours; a leg that is a whole joint move stays
//      straight.
// (M9) u = ds/dt: with q'' = q_ss u^2 + q_s u', u <= c_k, |q_ss,i| u^2 <= 0.7 A_i; the remainder of A_i
//      changes the speed, forward from the stop at the begin and backward from the stop at the end.
// (M10) The control points P_j = q(s(j h)) make a uniform cubic B-spline in time. h = motion.path_smoothing_ms, or the largest
//      a/(2 j) of a leg with the tool's acceleration a and j = motion.path_jerk_m_per_s3. q_i' is a mean of
//      (P_j+1 - P_j)/h, q_i'' a mean of (P_j+1 - 2 P_j + P_j-1)/h^2, so no axis is faster than its control points.
//      Three equal control points at each end make it begin and end at rest, without a jump of acceleration. It deviates from
//      the curve by (h u)^2/6 of its curvature: 6 um for 0.4 m/s on a radius of 1 m and 15 ms. Acceleration rises
//      within 2 h.
//
// If the control points exceed a limit, u is reduced at that place and (M9), (M10) are repeated. If this is not enough, h is
// increased, so no limit is exceeded. (B-spline: L. Biagiotti, C. Melchiorri, 2008, chapter 8.)
#pragma once

#include <span>
#include <vector>

#include "sim/robot/legs.h"
#include "sim/robot/motion.h"

namespace dresslife::sim {

/// Limits of each axis [rad/s, rad/s2; external axes m].
struct AxisLimits {
  Eigen::VectorXd speed, acceleration;
};

/// Returns the motion of a chain of legs without a stop inside, from the time `start` [s]. planned: A of (M9), at most the axes'
/// accelerations. smoothing: h of (M10) [s]; the least jerk of the legs increases it (M11). Preconditions: each leg begins at the
/// end of the previous one; none is a dwell.
std::vector<MotionPiece> path_pieces(std::span<const Leg> legs, const Eigen::VectorXd& planned,
                                     const AxisLimits& limits, double smoothing, double start);

}  // namespace dresslife::sim
