// The time law of a tool's path: one speed profile from stop to stop, and axes that move smoothly along it.
//
// A path comes as a chain of short legs in joint space, L_k long (largest axis), each with the largest speed
// c_k that its axes and its tool allow. Laid out one by one as joint moves are (motion.h), every leg would
// have accelerations of its own, at 40 Hz for points 10 mm apart at 0.4 m/s. Instead:
// (M8) q(s): through the legs' ends goes a curve of cubics, s the length along the legs, with the slope at an
//      end that of the parabola through it and its neighbours; a leg that is the whole of a joint move stays
//      straight.
// (M9) u = ds/dt: with q'' = q_ss u^2 + q_s u', u <= c_k, |q_ss,i| u^2 <= 0.7 A_i, and what is left of A_i
//      changes the speed, forward from the stop at the begin and backward from the one at the end.
// (M10) The controls P_j = q(s(j h)), h = motion.path_smoothing_ms or the largest a/(2 j) of a leg with the tool's
//      acceleration a and j = motion.path_jerk_m_per_s3, make a uniform cubic B-spline in time: q_i' is a mean of
//      (P_j+1 - P_j)/h, q_i'' one of (P_j+1 - 2 P_j + P_j-1)/h^2, so no axis is faster than its controls.
//      Ends of three equal controls make it begin and end at rest, without a jump of acceleration. It leaves
//      the curve by (h u)^2/6 of its curvature: 6 um for 0.4 m/s on a radius of 1 m and 15 ms. Acceleration rises
//      within 2 h.
//
// Where the controls exceed a limit, u is lowered there and (M9), (M10) done again; at last h is stretched,
// so no limit is exceeded. (B-spline: L. Biagiotti, C. Melchiorri, 2008, chapter 8.)
#pragma once

#include <span>
#include <vector>

#include "sim/robot/legs.h"
#include "sim/robot/motion.h"

namespace dresslife::sim {

/// What each axis can do [rad/s, rad/s2; external ones m].
struct AxisLimits {
  Eigen::VectorXd speed, acceleration;
};

/// A chain of legs without a stop inside, in time from `start` [s] on. planned: A of (M9), at most the axes'
/// accelerations. smoothing: h of (M10) [s]; the least jerk of the legs makes it longer (M11). Precondition: each leg begins where the one before ends, none is a dwell.
std::vector<MotionPiece> path_pieces(std::span<const Leg> legs, const Eigen::VectorXd& planned,
                                     const AxisLimits& limits, double smoothing, double start);

}  // namespace dresslife::sim
