#include "sim/rod/rotation.h"

namespace dresslife::sim {

Quaternion turn_between(const Vector3& from, const Vector3& to) {
  // Near half a turn the cross product loses the axis to rounding, so two quarter turns are used.
  constexpr double opposite = -1 + 1e-12;
  const Vector3 a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < opposite) {
    const Vector3 across = a.unitOrthogonal();
    return turn_between(across, b) * turn_between(a, across);
  }
  const double twice = std::sqrt((1 + cosine) * 2);  // cosine of half the turn
  const Vector3 axis = a.cross(b) * (1 / twice);
  return {twice * 0.5, axis.x(), axis.y(), axis.z()};
}

}  // namespace dresslife::sim
