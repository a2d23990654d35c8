// Joint angles of a six-axis arm whose flange is to be in a place, by iteration: for arms that no closed form
// solves (no common point of axes 4, 5, 6), and for arms that nearly fit one (a URDF with rounded angles),
// from the closed form's answer.
//
// (K4) flange(q) = e1(q1) ... e6(q6) F0, e_i(q) the turn about the axis (p_i, w_i) at zero angles, F0 the
//      flange there.
// (K5) Newton with damping (Levenberg, Marquardt): error e = (position [m], rotation vector [rad]) from
//      flange(q) to the wanted one, dq = J^T (J J^T + m I)^-1 e, J's columns (w x (flange - p), w); m falls
//      by ten where |e| shrinks and grows by ten where not. From a start near enough it stays on its branch
//      of arms: a path that is followed in small steps keeps its configuration.
// All arms are sought from many starts: the limits' box by a Halton sequence, so that two runs find the same.
// Arms in narrow corners of the box may be missed; an arm that is found is right to `rounding`.
//
// Orocos KDL (liborocos-kdl-dev, LGPL, 1.5 MB) has the same iteration; it needs a second description of every
// robot, solves from one start only and does not return branches, so that all but the forty lines of (K5)
// would be here anyway. It is not used. Source: S. Chiaverini, B. Siciliano, O. Egeland, Review of the damped
// least-squares inverse kinematics, 1994.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// The angle less whole turns, in (-pi, pi].
double wrapped(double angle);

class NumericalInverse {
 public:
  using Angles = Eigen::Matrix<double, 6, 1>;

  /// Of the flange's place behind a solution [m, rad]: some products of numbers near 1 and lengths of some
  /// metres.
  static constexpr double rounding = 1e-11;

  /// points, axes (unit), flange: at zero angles. lower, upper: where starts are sought [rad].
  NumericalInverse(const std::array<Vector3, 6>& points, const std::array<Vector3, 6>& axes,
                   const Frame& flange, const Angles& lower, const Angles& upper);

  Frame flange(const Angles& joints) const;  ///< (K4)

  /// The arm that the iteration reaches from `start`; angles as they come out, some turns away perhaps.
  /// Absent: none.
  std::optional<Angles> solve(const Frame& flange, const Angles& start) const;

  /// All different arms that are found, angles within (-pi, pi]; the first one from `start` where that leads
  /// to one.
  std::vector<Angles> arms(const Frame& flange, const Angles& start) const;

  /// Smallest singular value of J over its largest: 0 where the arm cannot turn or move in some direction.
  double dexterity(const Angles& joints) const;

 private:
  using Jacobian = Eigen::Matrix<double, 6, 6>;
  Frame place(const Angles& joints, Jacobian* jacobian) const;

  std::array<Vector3, 6> points_, axes_;
  Frame zero_;
  Angles lower_, upper_;
};

}  // namespace dresslife::sim
