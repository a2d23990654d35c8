#include "sim/rod/start_curve.h"

namespace dresslife::sim {
namespace {

constexpr int points_per_segment = 16;

/// Hermite cubic plus a sag 16 u^2 (1-u)^2, which does not change the ends and their directions.
struct Curve {
  Vector3 from, to, from_tangent, to_tangent, sag_direction;
  double speed = 0, sag = 0;  // [m]

  Vector3 at(double u) const {
    const double v = 1 - u;
    return v * v * (1 + 2 * u) * from + u * u * (3 - 2 * u) * to + speed * u * v * (v * from_tangent - u * to_tangent) +
           16 * sag * u * u * v * v * sag_direction;
  }
  std::vector<Vector3> points(int count) const {
    std::vector<Vector3> list;
    for (int k = 0; k <= count; ++k) list.push_back(at(static_cast<double>(k) / count));
    return list;
  }
};

double length_of(const std::vector<Vector3>& points) {
  double length = 0;
  for (size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  return length;
}

// Finds the largest value of a parameter in [0, most] with which the curve is not longer than `length`, by bisection.
// The length grows with the parameter, except for a small dip, which has no effect.
void stretch_to(Curve& curve, double Curve::*parameter, double most, double length, int count, int halvings) {
  double low = 0, high = most;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (low + high) / 2;
    curve.*parameter = middle;
    (length_of(curve.points(count)) > length ? high : low) = middle;
  }
  curve.*parameter = low;
}

Vector3 sag_direction(const Rod& rod, const Vector3& chord, const Vector3& base_tangent) {
  const Vector3 along = chord.norm() > 1e-9 ? Vector3(chord.normalized()) : base_tangent;
  const Vector3 gravity = rod.properties().gravity;
  const Vector3 across = gravity - gravity.dot(along) * along;
  return across.norm() > 1e-3 * gravity.norm() && gravity.norm() > 0 ? Vector3(across.normalized())
                                                                     : along.unitOrthogonal();
}

Curve fitted_curve(const Rod& rod, const ClampFrames& clamps, double most_speed, int count, int halvings) {
  const double length = rod.properties().length;
  Curve curve{clamps.base.position, clamps.tool.position, tangent(clamps.base.orientation),
              tangent(clamps.tool.orientation), Vector3::Zero()};
  curve.sag_direction = sag_direction(rod, curve.to - curve.from, curve.from_tangent);
  curve.speed = most_speed * length;
  if (length_of(curve.points(count)) > length)
    stretch_to(curve, &Curve::speed, most_speed * length, length, count, halvings);
  else
    stretch_to(curve, &Curve::sag, length, length, count, halvings);
  return curve;
}

// Returns points at equal distances along a polyline, including both ends.
std::vector<Vector3> evenly(const std::vector<Vector3>& points, int parts) {
  const double spacing = length_of(points) / parts;
  std::vector<Vector3> result{points.front()};
  double passed = 0;
  for (size_t k = 1; k < points.size(); ++k) {
    const double piece = (points[k] - points[k - 1]).norm();
    while (static_cast<int>(result.size()) < parts && result.size() * spacing <= passed + piece) {
      const double share = piece > 0 ? (result.size() * spacing - passed) / piece : 0;
      result.push_back(points[k - 1] + share * (points[k] - points[k - 1]));
    }
    passed += piece;
  }
  while (static_cast<int>(result.size()) <= parts) result.push_back(points.back());
  return result;
}

// Returns q after the smallest rotation that aligns its tangent with t.
Quaternion transported(const Quaternion& q, const Vector3& t) { return (turn_between(tangent(q), t) * q).normalized(); }

}  // namespace

StartCurve start_curve(const Rod& rod, const ClampFrames& clamps, double most_speed, int halvings) {
  const int n = rod.segments(), count = points_per_segment * n;
  const std::vector<Vector3> joints = evenly(fitted_curve(rod, clamps, most_speed, count, halvings).points(count), n);
  StartCurve result;
  RodState& state = result.state;
  state = rod.straight(clamps.base);
  state.clamps = clamps;
  Quaternion q = clamps.base.orientation;
  for (int i = 0; i < n; ++i) {
    const Vector3 chord = joints[i + 1] - joints[i];
    if (chord.norm() > 0) q = transported(q, chord.normalized());
    state.position[i] = (joints[i] + joints[i + 1]) / 2;
    state.orientation[i] = q;
  }
  const Quaternion end = transported(q, tangent(clamps.tool.orientation));
  result.roll_to_tool = rotation_vector(end.conjugate() * clamps.tool.orientation).z();
  if (rod.properties().tool_end == End::free || rod.properties().tool_end == End::pinned) return result;
  for (int i = 0; i < n; ++i) {
    const double roll = result.roll_to_tool * (i + 0.5) / n;
    state.orientation[i] = state.orientation[i] * Quaternion(Eigen::AngleAxisd(roll, Vector3::UnitZ()));
  }
  return result;
}

}  // namespace dresslife::sim
