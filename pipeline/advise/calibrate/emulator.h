// What a model says over its parameters, from few runs of it: one at a centre, two along each axis.
//
//     f(z) = f(c) + sum over j of g_j(z_j - c_j)                                          (P1)
//
// g_j is the parabola through the three values on axis j, and straight beyond them: with the parabola's slope
// there, within none and twice that of the chord, so that nothing turns back where nobody has looked. What
// parameters do together beyond their sum is left out; a calibration moves the centre to where it ends up.
#pragma once

#include <Eigen/Core>

namespace dresslife::pipeline {

class Emulator {
 public:
  Emulator() = default;
  /// A constant: of a model that depends on no parameter.
  explicit Emulator(double value) : value_(value) {}
  /// low, high (axis): values at centre - step and centre + step along each. step (axis) > 0.
  Emulator(Eigen::VectorXd centre, Eigen::VectorXd step, double value, const Eigen::VectorXd& low,
           const Eigen::VectorXd& high);

  double operator()(const Eigen::VectorXd& z) const;
  double at_centre() const { return value_; }

 private:
  double value_ = 0;
  Eigen::VectorXd centre_, step_;
  Eigen::VectorXd slope_, bend_;            ///< (axis) of the parabola in steps: slope d + bend d^2
  Eigen::VectorXd slope_low_, slope_high_;  ///< (axis) of what is straight beyond
};

}  // namespace dresslife::pipeline
