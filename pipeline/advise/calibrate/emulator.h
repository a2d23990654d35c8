// Approximation of a model as a function of its parameters, from few runs: one at a centre, two along each axis.
//
//     f(z) = f(c) + sum over j of g_j(z_j - c_j)                                          (P1)
//
// g_j is the parabola through the three values on axis j. Outside the runs it is a straight line with the parabola's end slope,
// limited to 0 .. 2 times the slope of the chord, so that it is monotonous outside the runs. Interactions of parameters
// are left out; therefore a calibration moves the centre to its result.
#pragma once

#include <Eigen/Core>

namespace dresslife::pipeline {

class Emulator {
 public:
  Emulator() = default;
  /// Makes an emulator of a constant.
  explicit Emulator(double value) : value_(value) {}
  /// low, high: (axis) values at centre - step and centre + step along each axis. Precondition: step (axis) > 0.
  Emulator(Eigen::VectorXd centre, Eigen::VectorXd step, double value, const Eigen::VectorXd& low,
           const Eigen::VectorXd& high);

  double operator()(const Eigen::VectorXd& z) const;

 private:
  double value_ = 0;
  Eigen::VectorXd centre_, step_;
  Eigen::VectorXd slope_, bend_;            ///< (axis) parabola in steps d from the centre: slope d + bend d^2
  Eigen::VectorXd slope_low_, slope_high_;  ///< (axis) slopes of the straight lines
};

}  // namespace dresslife::pipeline
