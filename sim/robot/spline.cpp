#include "sim/robot/spline.h"

#include <algorithm>
#include <cassert>

namespace dresslife::sim {

using Eigen::VectorXd;

CubicSpline::CubicSpline(std::vector<double> times, Eigen::MatrixXd values, SplineEnds ends)
    : times_(std::move(times)), values_(std::move(values)) {
  assert(!times_.empty() && values_.cols() == static_cast<long>(times_.size()));
  second_ = Eigen::MatrixXd::Zero(values_.rows(), values_.cols());
  if (ends == SplineEnds::at_rest && times_.size() > 1)
    find_second_derivatives_at_rest();
  else if (times_.size() > 2)
    find_second_derivatives();
}

/// Solves the tridiagonal equations for all m. An additional knot with the same value at distance 0 beyond each end gives the
/// slope 0.
void CubicSpline::find_second_derivatives_at_rest() {
  const long last = static_cast<long>(times_.size()) - 1;
  const auto step = [&](long k) { return k < 0 || k == last ? 0 : times_[k + 1] - times_[k]; };
  VectorXd diagonal(last + 1), slope = VectorXd::Zero(values_.rows());
  for (long k = 0; k <= last; ++k) {
    VectorXd next = VectorXd::Zero(values_.rows());
    if (k < last) next = (values_.col(k + 1) - values_.col(k)) / step(k);
    second_.col(k) = 6 * (next - slope);
    diagonal[k] = 2 * (step(k - 1) + step(k));
    slope = next;
    if (k == 0) continue;
    const double share = step(k - 1) / diagonal[k - 1];
    diagonal[k] -= share * step(k - 1);
    second_.col(k) -= share * second_.col(k - 1);
  }
  second_.col(last) /= diagonal[last];
  for (long k = last - 1; k >= 0; --k) second_.col(k) = (second_.col(k) - step(k) * second_.col(k + 1)) / diagonal[k];
}

VectorXd CubicSpline::slope(long k) const {
  const double h = times_[k + 1] - times_[k];
  return (values_.col(k + 1) - values_.col(k)) / h - h / 6 * (2 * second_.col(k) + second_.col(k + 1));
}

/// The end conditions, (m_1 - m_0)/h_0 = (m_2 - m_1)/h_1, give m_0 = m_1 + (h_0/h_1)(m_1 - m_2) in the
/// first equation, and the same holds at the other end; the other equations are tridiagonal in m_1 .. m_n-1. With three
/// knots both conditions are the same: m_0 = m_1 = m_2.
void CubicSpline::find_second_derivatives() {
  const long last = static_cast<long>(times_.size()) - 1;
  const auto step = [&](long k) { return times_[k + 1] - times_[k]; };
  const auto slope = [&](long k) { return VectorXd((values_.col(k + 1) - values_.col(k)) / step(k)); };
  VectorXd diagonal(last + 1), above(last + 1);
  for (long k = 1; k < last; ++k) {
    double below = step(k - 1);
    diagonal[k] = 2 * (step(k - 1) + step(k));
    above[k] = step(k);
    if (last == 2) diagonal[k] += below + above[k];
    if (last > 2 && k == 1) {
      diagonal[k] += below + below * below / above[k];
      above[k] -= below * below / above[k];
    }
    if (last > 2 && k == last - 1) {
      diagonal[k] += step(k) + step(k) * step(k) / step(k - 1);
      below -= step(k) * step(k) / step(k - 1);
    }
    second_.col(k) = 6 * (slope(k) - slope(k - 1));
    if (k == 1) continue;
    diagonal[k] -= below / diagonal[k - 1] * above[k - 1];
    second_.col(k) -= below / diagonal[k - 1] * second_.col(k - 1);
  }
  second_.col(last - 1) /= diagonal[last - 1];
  for (long k = last - 2; k >= 1; --k) second_.col(k) = (second_.col(k) - above[k] * second_.col(k + 1)) / diagonal[k];
  if (last == 2) {
    second_.col(0) = second_.col(2) = second_.col(1);
    return;
  }
  second_.col(0) = second_.col(1) + step(0) / step(1) * (second_.col(1) - second_.col(2));
  second_.col(last) =
      second_.col(last - 1) + step(last - 1) / step(last - 2) * (second_.col(last - 1) - second_.col(last - 2));
}

VectorXd CubicSpline::at(double time) const {
  if (time <= times_.front()) return values_.col(0);
  if (time >= times_.back()) return values_.col(values_.cols() - 1);
  const long k = std::ranges::upper_bound(times_, time) - times_.begin() - 1;
  const double h = times_[k + 1] - times_[k];
  const double a = (times_[k + 1] - time) / h, b = 1 - a;
  return a * values_.col(k) + b * values_.col(k + 1) +
         h * h / 6 * ((a * a * a - a) * second_.col(k) + (b * b * b - b) * second_.col(k + 1));  // (R5)
}

}  // namespace dresslife::sim
