// Smooth curves through recorded values: the C2 cubic spline, several channels at once.
//
// (R5) On [t_k, t_k+1], h = t_k+1 - t_k, a = (t_k+1 - t)/h, b = 1 - a:
//      y = a y_k + b y_k+1 + h^2/6 ((a^3 - a) m_k + (b^3 - b) m_k+1),
// with second derivatives m from continuous slopes, h_k-1 m_k-1 + 2 (h_k-1 + h_k) m_k + h_k m_k+1 =
// 6 ((y_k+1 - y_k)/h_k - (y_k - y_k-1)/h_k-1), and, at both ends, a continuous third derivative ("not a
// knot"), so that the error is of fourth order up to the ends. Three knots give a parabola, two a straight
// line. Alternative: slopes of 0 at both ends (at_rest): 2 h_0 m_0 + h_0 m_1 = 6 (y_1 - y_0)/h_0, and its mirror image.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dresslife::sim {

enum class SplineEnds { not_a_knot, at_rest };

class CubicSpline {
 public:
  /// times: (knot) increasing, at least one; values: (channel, knot).
  CubicSpline(std::vector<double> times, Eigen::MatrixXd values, SplineEnds ends = SplineEnds::not_a_knot);

  /// Returns the values, (channel), at time t; outside the knots the values at the nearest end.
  Eigen::VectorXd at(double time) const;
  /// Returns the slopes, (channel), behind knot k. Precondition: k is not the last knot.
  Eigen::VectorXd slope(long k) const;
  const std::vector<double>& times() const { return times_; }
  const Eigen::MatrixXd& values() const { return values_; }              ///< (channel, knot)
  const Eigen::MatrixXd& second_derivatives() const { return second_; }  ///< m: (channel, knot)

 private:
  void find_second_derivatives();
  void find_second_derivatives_at_rest();

  std::vector<double> times_;
  Eigen::MatrixXd values_, second_;  // y, m: (channel, knot)
};

}  // namespace dresslife::sim
