// An independent reference for the nested kinematics: helices in space on a bent, twisted and stretched rod. Their lengths
// and frames are finite differences of positions. It uses no formula of pipeline/cable/helix.h, only the definition of a
// helix.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace space_curve {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

struct Level {
  Real radius, lay_angle, phase;  // [m], [rad] signed, [rad]
};

/// A rod of uniform strain through the origin, and the components nested in it.
struct Curves {
  Real stretch;
  Vector rate;  // rotation rate in the rod's own frame [1/m]
  std::vector<Level> levels;
  Real step = 2e-5L;  // of the finite differences: (step / 5 mm)^6 = 4e-15 of truncation

  Matrix cross(const Vector& w) const {
    Matrix m;
    m << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return m;
  }
  // Frame and position of the rod by the closed forms of a uniform rotation rate.
  Matrix rod_frame(Real s) const {
    const Real w = rate.norm();
    const Matrix k = cross(rate);
    if (w == 0) return Matrix::Identity();
    return Matrix::Identity() + std::sin(w * s) / w * k + (1 - std::cos(w * s)) / (w * w) * k * k;
  }
  Vector rod_position(Real s) const {
    const Real w = rate.norm();
    const Vector z(0, 0, 1);
    if (w == 0) return stretch * s * z;
    const Matrix k = cross(rate);
    return stretch *
           (s * z + (1 - std::cos(w * s)) / (w * w) * k * z + (w * s - std::sin(w * s)) / (w * w * w) * k * k * z);
  }
  /// Returns the ideal length of the component of level `depth` (0: the rod) per length of the rod.
  Real ideal_rate(int depth) const {
    Real rate_of_length = 1;
    for (int k = 0; k < depth; ++k) rate_of_length /= std::cos(levels[k].lay_angle);
    return rate_of_length;
  }
  Vector position(int depth, Real s) const {
    if (depth == 0) return rod_position(s);
    const Level& level = levels[depth - 1];
    Real angle = level.phase;
    if (level.radius > 0) angle += s * ideal_rate(depth - 1) * std::tan(level.lay_angle) / level.radius;
    return position(depth - 1, s) +
           frame(depth - 1, s) * Vector(level.radius * std::cos(angle), level.radius * std::sin(angle), 0);
  }
  template <class F>
  auto derivative(const F& f, Real s) const {
    using Value = decltype(f(s));
    const Real h = step;
    const Value d1 = f(s + h) - f(s - h), d2 = f(s + 2 * h) - f(s - 2 * h), d3 = f(s + 3 * h) - f(s - 3 * h);
    return Value((45 * d1 - 9 * d2 + d3) / (60 * h));
  }
  Vector path(int depth, Real s) const {
    return derivative([&](Real at) { return position(depth, at); }, s);
  }
  /// Columns: inward radial direction orthogonal to the tangent, binormal, tangent.
  Matrix frame(int depth, Real s) const {
    if (depth == 0) return rod_frame(s);
    const Vector tangent = path(depth, s).normalized();
    Vector inward = position(depth - 1, s) - position(depth, s);
    inward = (inward - inward.dot(tangent) * tangent).normalized();
    Matrix f;
    f << inward, tangent.cross(inward), tangent;
    return f;
  }
  /// Returns the path length of the innermost component per ideal length of this component, at s = 0.
  Real stretch_of_last() const {
    const int depth = static_cast<int>(levels.size());
    return path(depth, 0).norm() / ideal_rate(depth);
  }
  /// Returns the rotation rate of the innermost component's frame, in this frame, per ideal length, at s = 0.
  Vector rate_of_last() const {
    const int depth = static_cast<int>(levels.size());
    const Matrix turn = frame(depth, 0).transpose() * derivative([&](Real at) { return frame(depth, at); }, 0);
    return Vector(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)) / 2 / ideal_rate(depth);
  }
};

}  // namespace space_curve
