// The path of a tool: a straight line or an arc in the frame of a work object, with uniform rotation of the tool.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Tool and work object of a move: tool in the flange and object in the world; if `stationary`, the
/// tool in the world and the object in the flange.
struct Tooling {
  Frame tool, object;
  bool stationary = false;

  /// Return the flange in the world for a tool at `pose` in the object; and the inverse.
  Frame flange(const Frame& pose) const {
    return stationary ? tool * inverse(object * pose) : object * pose * inverse(tool);
  }
  Frame pose(const Frame& flange) const {
    return stationary ? inverse(flange * object) * tool : inverse(object) * flange * tool;
  }
};

class ToolPath {
 public:
  ToolPath(const Tooling& tooling, const Frame& from, const Frame& to)
      : tooling_(tooling), from_(from), to_(to), length_((to.position - from.position).norm()) {
    turn_ = rotation_vector(from.orientation.conjugate() * to.orientation).norm();
  }

  /// Makes the path the arc through `via`. Returns false if start, via and end give no circle: then the path stays straight.
  bool bend(const Vector3& via) { return bend_round(via, to_.position); }

  /// Makes the path the arc of the circle through `other`, a point of the circle before the start or after the end.
  void bend_beside(const Vector3& other) { bend_round(to_.position, other); }

  double length() const { return length_; }  ///< of the tool's path [m]
  double turn() const { return turn_; }      ///< rotation of the tool [rad]
  const Tooling& tooling() const { return tooling_; }

  /// Returns the pose of the tool in the object at the share u of the path.
  Frame pose(double u) const {
    const Quaternion turned = from_.orientation.slerp(u, to_.orientation);
    if (angle_ == 0) return {from_.position + u * (to_.position - from_.position), turned};
    return {centre_ + Quaternion(Eigen::AngleAxisd(u * angle_, axis_)) * Vector3(from_.position - centre_), turned};
  }
  Frame flange(double u) const { return tooling_.flange(pose(u)); }

  bool same_tooling(const ToolPath& other) const {
    const auto same = [](const Frame& a, const Frame& b) {
      return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
    };
    return same(tooling_.tool, other.tooling_.tool) && same(tooling_.object, other.tooling_.object) &&
           tooling_.stationary == other.tooling_.stationary;
  }

 private:
  /// Makes the path the arc to the end on the circle that leads from the start to p, then to q.
  bool bend_round(const Vector3& p, const Vector3& q) {
    // Centre m of the circle through 0, a, b: 2 a.m = |a|^2, 2 b.m = |b|^2 and (a x b).m = 0, hence
    // m = (|a|^2 b - |b|^2 a) x (a x b) / (2 |a x b|^2).
    const Vector3 a = p - from_.position, b = q - from_.position, n = a.cross(b);
    // Limit of the largest side times the distance of the third point from it. Numbers in programs have steps of 0.01 or 0.001
    // mm.
    constexpr double straight = 1e-5;  // [m]
    if (n.norm() <= straight * std::max({a.norm(), b.norm(), (b - a).norm()})) return false;
    centre_ = from_.position + (a.squaredNorm() * b - b.squaredNorm() * a).cross(n) / (2 * n.squaredNorm());
    axis_ = n.normalized();
    const Vector3 first = from_.position - centre_, last = to_.position - centre_;
    angle_ = std::atan2(axis_.dot(first.cross(last)), first.dot(last));
    if (angle_ <= 0) angle_ += 2 * std::acos(-1.0);  // from p to q: less than a full turn about n
    length_ = angle_ * first.norm();
    return true;
  }

  Tooling tooling_;
  Frame from_, to_;
  double length_, turn_ = 0, angle_ = 0;
  Vector3 centre_ = Vector3::Zero(), axis_ = Vector3::UnitZ();
};

/// Returns the quadratic Bezier curve (M6) of a, b and c. window: share of the corner in which the turn is blended; the turn goes
/// to b before it, and on from b behind it.
inline Frame bezier(const Frame& a, const Frame& b, const Frame& c, double u, double window = 1) {
  const Vector3 position = (1 - u) * (1 - u) * a.position + 2 * u * (1 - u) * b.position + u * u * c.position;
  const double begin = (1 - window) / 2;
  if (u < begin) return {position, a.orientation.slerp(2 * u, b.orientation)};
  if (u > 1 - begin) return {position, b.orientation.slerp(2 * u - 1, c.orientation)};
  const double v = (u - begin) / window;
  const Quaternion from = window < 1 ? b.orientation.slerp(window, a.orientation) : a.orientation,
                   to = window < 1 ? b.orientation.slerp(window, c.orientation) : c.orientation;
  return {position, from.slerp(v, b.orientation).slerp(v, b.orientation.slerp(v, to))};
}

}  // namespace dresslife::sim
