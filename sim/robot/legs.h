// The lines of a motion as a chain of straight legs in joint space. The time law (motion.h) computes their times.
//
// A joint move is one leg. A linear or circular move is divided into legs so short that the tool stays on its
// path: between two points at distance h, on a path with bend radius r in joint space, a leg deviates by h^2/(8 r).
// From point to point joint angles change by at most 0.1 rad, the tool moves at most 10 mm and rotates at most 2 deg.
//   linear    x(u) = x0 + u (x1 - x0)
//   circular  on the circle through start, via and target
//   both      orientation slerp(q0, q1; u), of the tool in the work object
//
// (M6) Zones of tool paths: within the zone d of a corner (at most half of either move) the path is the
//      quadratic Bezier curve of A, the corner and B. A and B are d before and behind the corner. The curve leaves and
//      joins both paths tangentially and stays in their triangle, so the tool deviates by less than d.
//      Orientations follow three slerps in the same way. With a zone of the turn (zone_turn_deg), which is a share w of what the
//      corner cuts, the turn goes on to (1 - w)/2 of the corner and is blended from there to (1 + w)/2. If one of the moves is a joint move, the curve is in
//      joint space.
// (M11) A move with a share p of the jerk has ramps 1/p times as long: r' = r/(r + p (1 - r)) and
//      A' = A p/(r + p (1 - r)) with the same acceleration. If r' would exceed 1/2, the acceleration is never
//      constant: r' = 1/2, and the acceleration reaches only a sqrt(p (1 - r)/r). A tool path has 1/p times the smoothing time.
// (M13) With a jerk limit J (motion.jerk_deg_per_s3) a change of speed by V has tau = V/a + a/J and
//      r = a/(J tau). If V < a^2/J the acceleration is never constant: tau = 2 sqrt(V/J), r = 1/2. In a blend
//      V/a and V/J are the largest of all axes, so no axis exceeds its limits. A linear external axis has the J with which its
//      acceleration rises in the same time as that of the rotary axis with the largest acceleration. A
//      share p of the jerk gives p J. Moves of a chain with a tool path are smoothed by (M10) instead.
// (M7) A leg's speed is the minimum of the limits by the axes, by the tool's speed ds/dt and by its rotation dtheta/dt.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/job/motion.h"
#include "pipeline/job/robot.h"

namespace dresslife::sim {

/// A straight leg in joint space, or (length 0) a dwell.
struct Leg {
  Eigen::VectorXd from, direction;  ///< D: the component of the largest axis is +-1
  double length = 0;                ///< length in terms of the largest axis [rad]
  double cruise = 0;                ///< cruising speed c [rad/s]
  double acceleration = 0;          ///< A along the leg [rad/s2]
  double ramp = 0.25;               ///< r of (M1); not used in a dwell
  double slowing = 1, jerk = 1;     ///< A'/A and p of (M11)
  double jerk_limit = 0;            ///< p J of (M13) along the leg [rad/s3]; then `acceleration` is a; 0: (M2), (M11)
  double tool_share = 0;            ///< distance of the tool over length [m/rad]
  double zone = 0;                  ///< at the end of the leg: blending begins at most this far before it [rad]
  double zone_behind = 0;           ///< blending ends at most this far behind the end of the leg [rad]
  double dwell = 0;                 ///< [s]
  int path = 0;           ///< number of the chain from stop to stop with a tool path, to which the leg belongs; 0: none
  bool straight = false;  ///< the leg is a whole joint move
  int step = 0;
};

/// Returns (M11) r' and A'/A of a move with a share `jerk` of the jerk, 0 < jerk <= 1, if other moves have ramps of r = `ramp`.
std::pair<double, double> ramp_of(double ramp, double jerk);

/// A change of speed.
struct SpeedChange {
  double duration, ramp;  ///< tau [s], r of (M1)
};
/// Returns a change of speed by (M13). at_full: V/a [s]; by_jerk: V/J [s2], above 0.
SpeedChange limited_change(double at_full, double by_jerk);
/// Returns the change of a leg's speed by `change` >= 0 [rad/s], by (M13), or by (M2) and (M11).
SpeedChange change_on(const Leg& leg, double change);
/// Returns J of (M13), (axis) [rad/s3, m/s3]. Precondition: motion.jerk is set.
Eigen::VectorXd jerk_limits(const pipeline::Motion& motion, const pipeline::Robot& robot);

struct Legs {
  std::vector<Leg> legs;
  std::vector<std::string> texts;  ///< texts of the program's lines; Leg::step is an index
  Eigen::VectorXd place;           ///< axes at the end of the program
  /// (move, in the order of execution) all axes at its target [rad; external axes rad or m]
  std::vector<Eigen::VectorXd> targets;
};

/// Makes the legs of a motion. accelerations: A_i of (M2) [rad/s2]. Errors: InputError at the lines of the program, all together:
/// no move at the beginning, a target outside the limits, out of reach, not reachable in its configuration or
/// along its path.
Legs legs_of(const pipeline::Motion& motion, const pipeline::Robot& robot, const Eigen::VectorXd& accelerations);

}  // namespace dresslife::sim
