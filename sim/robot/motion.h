// The time law of a joint program: position of every axis at any time, within its limits of speed and acceleration.
//
// A program is a chain of straight legs in joint space. Leg k has direction D_k (1 for its largest axis, so
// its length L_k and speed are those of this axis). The motion consists of changes of velocity:
// (M1) q'(t) = V0 + (V1 - V0) sigma(u),   q(t) = q0 + tau (V0 u + (V1 - V0) S(u)),   u = (t - t0)/tau.
// sigma rises from 0 to 1 with a trapezoidal acceleration: ramps with the fraction r of tau at both ends
// (motion.ramp_percent; (M13) in legs.h), so acceleration is continuous and jerk is bounded. The largest acceleration is
// |V1 - V0| / (tau (1 - r)), so
// (M2) tau = max_i |V1_i - V0_i| / A_i,   A_i = (1 - r) a_i.
// Because S(1) = 1/2, a change between speeds v0 and v1 along a leg has the length (v0 + v1) tau/2: all closed forms of
// the trapezoidal law hold with A as acceleration. With cruising speed c = fraction min_i v_i/|D_i|,
// A = min_i A_i/|D_i|, and speeds v0, v1 at begin and end of the leg, the top speed is
// (M3) v = min(c, sqrt((2 A L + v0^2 + v1^2)/2)).
//
// Zone blending: the velocity changes from V0 = v D_k to V1 = v' D_{k+1} by (M1) from tau/2 before the
// waypoint to tau/2 after it, where tau/2 is measured at the unchanged speeds of both legs.
// (M4) The path leaves leg k at v tau/2 <= zone before the waypoint and joins leg k+1 at v' tau/2 behind it. Between
//      them it lies in the triangle of these three points (velocities are convex combinations), so no axis
//      deviates by more than the zone, nor by more than half a leg.
// (M5) Speeds v, v' = min(c_k, w), min(c_{k+1}, w) with the largest w for which (M4) holds and both legs are
//      long enough to change speed; found for each corner and repeated in sweeps until all legs agree. w = 0 (zone 0, a
//      dwell, the ends) is a full stop.
//
// A chain of moves without a stop that contains a tool path is computed as a whole (legs.h: M6, M7;
// path_motion.h). Recorded rows with motion.rows: spline have another law:
// (M12) q(t) is the cubic spline (R5) through the rows at their times, with q' = 0 at both ends and between two equal successive
//       rows. Limits of speed and acceleration do not apply, because the robot has performed this motion.
// ASSUMPTION: only axis limits, as in a controller without a dynamic model. The ramp fraction is an estimate; a program can
// reduce the jerk of its moves (M11, legs.h). (Trapezoidal law and blends: L. Biagiotti, C. Melchiorri, Trajectory Planning for
// Automatic Machines and Robots, 2008, chapters 3 and 5; the unified form is derived above.)
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "pipeline/job/motion.h"
#include "pipeline/job/robot.h"

namespace dresslife::sim {

/// One change of velocity (M1), or (with a jerk) a cubic in time.
struct MotionPiece {
  double start = 0;                 ///< t0 [s]
  double duration = 0;              ///< tau [s]
  Eigen::VectorXd position;         ///< q0 (joint) [rad]
  Eigen::VectorXd velocity_before;  ///< V0 (joint) [rad/s]
  Eigen::VectorXd velocity_change;  ///< V1 - V0 (joint) [rad/s]
  int step = 0;                     ///< program line
  int step_after = 0;               ///< program line of the second half: a blend belongs to two moves
  double ramp = 0.25;               ///< r
  Eigen::VectorXd acceleration{},
      jerk{};  ///< of a cubic: acceleration at its begin, constant jerk (joint) [rad/s2, rad/s3]
};

/// A program as a function of time. Before 0 and after duration() the robot stands still.
class JointMotion {
 public:
  /// Throws InputError at the place in the motion's file: a waypoint outside the joint limits or with the
  /// wrong number of angles, a first step that is no move.
  JointMotion(const pipeline::Motion& motion, const pipeline::Robot& robot);

  /// Holds an axis at the middle of its range in this motion. The other axes move as before, at the same times.
  /// Precondition: axis < axes of the robot.
  void hold(std::size_t axis);

  /// Shortens each standstill that is longer, also one of several successive waits. Precondition: longest > 0 [s].
  void shorten_waits(double longest);
  /// Returns the time of the program, with its whole waits, for a time of this motion [s].
  double program_time(double time) const;

  double duration() const { return duration_; }     ///< [s]
  Eigen::VectorXd position(double time) const;      ///< (joint) [rad]
  Eigen::VectorXd velocity(double time) const;      ///< (joint) [rad/s]
  Eigen::VectorXd acceleration(double time) const;  ///< (joint) [rad/s2]
  int step(double time) const;                      ///< index into step_texts()
  /// Returns one text per program line (each block once, independent of its repeats): "block: step", or "move 3" without a
  /// text.
  const std::vector<std::string>& step_texts() const { return step_texts_; }
  const std::vector<MotionPiece>& pieces() const { return pieces_; }

 private:
  const MotionPiece& piece_at(double time) const;

  std::vector<MotionPiece> pieces_;  // back to back from time 0; at least one
  std::vector<std::string> step_texts_;
  double duration_ = 0;
  struct Cut {
    double time, missing;  // in this motion; of the wait that ends there [s]
  };
  std::vector<Cut> cuts_;  // in the order of time
};

}  // namespace dresslife::sim
