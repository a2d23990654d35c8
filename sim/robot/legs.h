// A motion's lines as a chain of straight legs in joint space: what the time law (motion.h) lays out in time.
//
// A joint move is one leg. A linear or circular move is cut into legs so short that the tool stays on its
// path: between two points h apart, on a path that bends in joint space with radius r, a leg runs h^2/(8 r)
// beside it; joint angles change by at most 0.1 rad, and the tool moves at most 10 mm and turns at most 2 deg
// from point to point.
//   linear    x(u) = x0 + u (x1 - x0)
//   circular  on the circle through start, via and target
//   both      orientation slerp(q0, q1; u), tool in work object
//
// (M6) Zones of tool paths: within the zone d of a corner (at most half of either move) the path is the
//      quadratic Bezier curve of A, the corner and B, A and B being d before and behind it: it leaves and
//      joins both paths tangentially and stays in their triangle, so the tool deviates by less than d.
//      Orientations follow three slerps in the same way. Where a joint move takes part, the curve is one in
//      joint space.
// (M11) A move with a share p of the jerk has ramps 1/p times as long: r' = r/(r + p (1 - r)) and
//      A' = A p/(r + p (1 - r)) with the same acceleration. Where r' would exceed 1/2 the acceleration is never
//      constant: r' = 1/2, and it reaches a sqrt(p (1 - r)/r) only. A tool path is smoothed 1/p times as long.
// (M13) With a jerk limit J (motion.jerk_deg_per_s3) a change of speed by V has tau = V/a + a/J and
//      r = a/(J tau). Where V < a^2/J the acceleration is never constant: tau = 2 sqrt(V/J), r = 1/2. In a blend
//      V/a and V/J are the largest of all axes, so none exceeds its limits. A sliding external axis has the J that
//      builds its acceleration up in the same time as that of the turning axis with the largest acceleration. A
//      share p of the jerk makes it p J. Moves of a chain with a tool path are smoothed by (M10) instead.
// (M7) A leg's speed is the least that the axes, the tool's speed ds/dt and its turning dtheta/dt allow.
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
  Eigen::VectorXd from, direction;  ///< D: largest component +-1
  double length = 0;                ///< of the largest axis [rad]
  double cruise = 0;                ///< c [rad/s]
  double acceleration = 0;          ///< A along the leg [rad/s2]
  double ramp = 0.25;               ///< r of (M1); nothing changes in a dwell
  double slowing = 1, jerk = 1;     ///< A'/A and p of (M11)
  double jerk_limit = 0;            ///< p J of (M13) along the leg [rad/s3]; acceleration is a then. 0: (M2), (M11)
  double tool_share = 0;            ///< way of the tool over length [m/rad]
  double zone = 0;                  ///< at its end: blending begins at most this far before it [rad]
  double zone_behind = 0;           ///< and ends at most this far behind it [rad]
  double dwell = 0;                 ///< [s]
  int path = 0;           ///< which chain from stop to stop that holds a tool path it belongs to; 0: none
  bool straight = false;  ///< the whole of a joint move
  int step = 0;
};

/// (M11) r' and A'/A of a move with a share `jerk` of the jerk, 0 < jerk <= 1, where others have ramps of r = `ramp`.
std::pair<double, double> ramp_of(double ramp, double jerk);

/// A change of speed.
struct SpeedChange {
  double duration, ramp;  ///< tau [s], r of (M1)
};
/// (M13) at_full: V/a [s]; by_jerk: V/J [s2], above 0.
SpeedChange limited_change(double at_full, double by_jerk);
/// (M13), or (M2) and (M11), of a leg whose speed changes by `change` >= 0 [rad/s].
SpeedChange change_on(const Leg& leg, double change);
/// (axis) J of (M13) [rad/s3, m/s3]. Precondition: motion.jerk.
Eigen::VectorXd jerk_limits(const pipeline::Motion& motion, const pipeline::Robot& robot);

struct Legs {
  std::vector<Leg> legs;
  std::vector<std::string> texts;  ///< of the program's lines, which Leg::step counts
  Eigen::VectorXd place;           ///< where the robot ends
  std::vector<Eigen::VectorXd> targets;  ///< (move, as run) all axes at its target [rad; external ones rad or m]
};

/// accelerations: A_i of (M2) [rad/s2]. Errors: InputError at the lines of the program, all of them at once:
/// no move at the beginning, a target outside the limits, out of reach, not reached in its configuration or
/// along its path.
Legs legs_of(const pipeline::Motion& motion, const pipeline::Robot& robot,
             const Eigen::VectorXd& accelerations);

}  // namespace dresslife::sim
