// Joint angles of a six-axis arm for a pose of its flange, by iteration: for arms without a closed form
// (axes 4, 5, 6 have no common point), and for arms that nearly have one (a URDF with rounded angles),
// starting from the closed form's solution.
//
// (K4) flange(q) = e1(q1) ... e6(q6) F0, e_i(q): rotation about the axis (p_i, w_i) at zero angles, F0: flange
//      at zero angles.
// (K5) Newton with damping (Levenberg, Marquardt): error e = (position [m], rotation vector [rad]) from
//      flange(q) to the target, dq = J^T (J J^T + m I)^-1 e, columns of J: (w x (flange - p), w); m is divided
//      by ten if |e| decreases, else multiplied by ten. From a close start the iteration stays on its branch
//      of arms: a path that is followed in small steps keeps its configuration.
// All arms are searched from many starts in the box of the limits. The starts are a Halton sequence, so two runs find the same
// arms. Arms in narrow corners of the box may be missed; an arm that is found has an error of at most `rounding`.
//
// Orocos KDL (liborocos-kdl-dev, LGPL, 1.5 MB) has the same iteration. It needs a second description of every
// robot, solves from one start only and does not return branches, so it would replace only the forty lines of (K5).
// Therefore it is not used. Source: S. Chiaverini, B. Siciliano, O. Egeland, Review of the damped
// least-squares inverse kinematics, 1994.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Returns the angle minus full turns, in (-pi, pi].
double wrapped(double angle);

class NumericalInverse {
 public:
  using Angles = Eigen::Matrix<double, 6, 1>;

  /// Error of the flange's pose for a solution [m, rad]: rounding of some products of numbers near 1 and lengths of some
  /// metres.
  static constexpr double rounding = 1e-11;

  /// points, axes (unit), flange: at zero angles. lower, upper: box of the starts [rad].
  NumericalInverse(const std::array<Vector3, 6>& points, const std::array<Vector3, 6>& axes, const Frame& flange,
                   const Angles& lower, const Angles& upper);

  Frame flange(const Angles& joints) const;  ///< (K4)

  /// Returns the arm that the iteration reaches from `start`; its angles may contain full turns. Absent: the iteration fails.
  std::optional<Angles> solve(const Frame& flange, const Angles& start) const;

  /// Returns all different arms that the iteration finds, angles within (-pi, pi]; first the one from `start`, if this start
  /// leads to an arm.
  std::vector<Angles> arms(const Frame& flange, const Angles& start) const;

  /// Returns the ratio of the smallest to the largest singular value of J; 0 if the arm cannot move or rotate in some direction.
  double dexterity(const Angles& joints) const;

 private:
  using Jacobian = Eigen::Matrix<double, 6, 6>;
  Frame place(const Angles& joints, Jacobian* jacobian) const;

  std::array<Vector3, 6> points_, axes_;
  Frame zero_;
  Angles lower_, upper_;
};

}  // namespace dresslife::sim
