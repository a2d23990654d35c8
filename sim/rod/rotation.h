// Rotations in space: logarithm and exponential of unit quaternions, cross-product matrix, rigid frames.
//
// A rotation vector r turns by |r| rad about r/|r| (right-handed). log gives the shortest one, |r| <= pi.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace dresslife::sim {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

/// A position [m] and an orientation (body to world).
struct Frame {
  Vector3 position = Vector3::Zero();
  Quaternion orientation = Quaternion::Identity();

  Vector3 point(const Vector3& local) const { return position + orientation * local; }
  Frame operator*(const Frame& local) const { return {point(local.position), orientation * local.orientation}; }
};

inline Frame inverse(const Frame& frame) {
  const Quaternion back = frame.orientation.conjugate();
  return {back * Vector3(-frame.position), back};
}

/// Returns the matrix of a x: skew(a) b = a x b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// log: returns the shortest rotation vector [rad] of a unit quaternion.
inline Vector3 rotation_vector(const Quaternion& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const Vector3 v = sign * q.vec();
  const double sine = v.norm(), cosine = sign * q.w();  // of half the angle
  // Below 1e-8 the series 2 v / cosine is exact to rounding.
  return sine < 1e-8 ? Vector3(2 * v / cosine) : Vector3(v * (2 * std::atan2(sine, cosine) / sine));
}

/// exp: returns the unit quaternion of a rotation vector [rad].
inline Quaternion rotation(const Vector3& r) {
  const double squared = r.squaredNorm();
  if (squared < 1e-4) {  // the next terms, r^6, are below 1e-16
    const double s = 0.5 - squared / 48 + squared * squared / 3840;
    return {1 - squared / 8 + squared * squared / 384, s * r.x(), s * r.y(), s * r.z()};
  }
  const double angle = std::sqrt(squared), s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * r.x(), s * r.y(), s * r.z()};
}

/// Returns the smallest rotation from the direction `from` to the direction `to` (lengths > 0; opposite: about any perpendicular
/// axis). Eigen's FromTwoVectors gives the same, but costs 5 s of compile time in each source by its singular value
/// decomposition.
Quaternion turn_between(const Vector3& from, const Vector3& to);

/// Returns the body z axis in the world: the tangent of a segment or clamp.
inline Vector3 tangent(const Quaternion& q) {
  return {2 * (q.x() * q.z() + q.w() * q.y()), 2 * (q.y() * q.z() - q.w() * q.x()),
          1 - 2 * (q.x() * q.x() + q.y() * q.y())};
}

/// Returns the frame turned about its own tangent by roll [rad].
inline Frame rolled(const Frame& frame, double roll) {
  return {frame.position, frame.orientation * Quaternion(Eigen::AngleAxisd(roll, Vector3::UnitZ()))};
}

}  // namespace dresslife::sim
