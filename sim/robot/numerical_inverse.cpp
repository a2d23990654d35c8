#include "sim/robot/numerical_inverse.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cmath>

#include "pipeline/base/constants.h"

namespace dresslife::sim {
namespace {

constexpr int steps = 60;  // of one iteration: convergence is quadratic near a solution and slow only at a singular arm
constexpr int starts = 240;  // at most
// without a new arm: one that is reached from 5 % of the box is missed with the probability 0.95^60 = 5 %
constexpr int starts_in_vain = 60;
constexpr double same_arm = 1e-6;  // [rad]

/// Returns the difference (position [m], rotation [rad]) from one pose to the other.
NumericalInverse::Angles apart(const Frame& from, const Frame& to) {
  NumericalInverse::Angles e;
  e << to.position - from.position, rotation_vector(to.orientation * from.orientation.conjugate());
  return e;
}

/// Returns the n-th number of the van der Corput sequence to this base, in (0, 1).
double halton(int n, int base) {
  double value = 0, share = 1;
  for (; n > 0; n /= base) value += (share /= base) * (n % base);
  return value;
}

}  // namespace

double wrapped(double angle) {
  angle = std::remainder(angle, 2 * pi);
  return angle <= -pi ? angle + 2 * pi : angle;
}

NumericalInverse::NumericalInverse(const std::array<Vector3, 6>& points, const std::array<Vector3, 6>& axes,
                                   const Frame& flange, const Angles& lower, const Angles& upper)
    : points_(points), axes_(axes), zero_(flange), lower_(lower.cwiseMax(-pi)), upper_(upper.cwiseMin(pi)) {}

Frame NumericalInverse::place(const Angles& joints, Jacobian* jacobian) const {
  Frame turned;  // e1 ... ei
  std::array<Vector3, 6> points, axes;
  for (int i = 0; i < 6; ++i) {
    points[i] = turned.point(points_[i]);
    axes[i] = turned.orientation * axes_[i];
    const Quaternion turn(Eigen::AngleAxisd(joints[i], axes_[i]));
    turned = turned * Frame{points_[i] - turn * points_[i], turn};
  }
  const Frame flange = turned * zero_;
  if (jacobian)
    for (int i = 0; i < 6; ++i) jacobian->col(i) << axes[i].cross(flange.position - points[i]), axes[i];
  return flange;
}

Frame NumericalInverse::flange(const Angles& joints) const { return place(joints, nullptr); }

std::optional<NumericalInverse::Angles> NumericalInverse::solve(const Frame& flange, const Angles& start) const {
  Angles joints = start;
  Jacobian j;
  Angles error = apart(place(joints, &j), flange);
  double damping = 1e-3;
  for (int step = 0; step < steps; ++step) {
    if (error.head<3>().norm() < rounding && error.tail<3>().norm() < rounding) return joints;
    const Jacobian matrix = j * j.transpose() + damping * Jacobian::Identity();
    const Angles change = j.transpose() * matrix.ldlt().solve(error);
    // A longer step would leave the branch.
    constexpr double longest = 0.5;  // [rad]
    const double largest = change.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) return {};
    const Angles next = joints + change * std::min(1.0, longest / std::max(largest, longest * 1e-9));
    Jacobian there;
    const Angles left = apart(place(next, &there), flange);
    if (left.norm() < error.norm()) {
      joints = next;
      error = left;
      j = there;
      damping = std::max(damping / 10, 1e-15);
    } else {
      damping *= 10;
      if (damping > 1e3) return {};  // no step reduces the error: the iteration fails
    }
  }
  return {};
}

std::vector<NumericalInverse::Angles> NumericalInverse::arms(const Frame& flange, const Angles& start) const {
  std::vector<Angles> found;
  int in_vain = 0;
  constexpr int bases[] = {2, 3, 5, 7, 11, 13};
  for (int n = 0; n < starts && in_vain < starts_in_vain; ++n, ++in_vain) {
    Angles from = start;
    if (n > 0)
      for (int i = 0; i < 6; ++i) from[i] = lower_[i] + (upper_[i] - lower_[i]) * halton(n, bases[i]);
    auto arm = solve(flange, from);
    if (!arm) continue;
    for (double& angle : *arm) angle = wrapped(angle);
    const auto same = [&](const Angles& other) {
      double off = 0;
      for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(std::remainder((*arm)[i] - other[i], 2 * pi)));
      return off < same_arm;
    };
    if (std::ranges::any_of(found, same)) continue;
    found.push_back(*arm);
    in_vain = 0;
  }
  return found;
}

double NumericalInverse::dexterity(const Angles& joints) const {
  Jacobian j;
  place(joints, &j);
  const Eigen::JacobiSVD<Jacobian> values(j);
  return values.singularValues()[5] / values.singularValues()[0];
}

}  // namespace dresslife::sim
