#include "sim/program/interpreter/arc.h"

#include <cmath>
#include <numbers>

namespace dresslife::sim::krl {

std::optional<Arc> arc_through(const Vector3& first, const Vector3& second, const Vector3& third) {
  // The centre m = a + s u + t v of the points a, b, c, with u = b - a and v = c - a, has the same distance from all
  // three points: 2 (m - a) u = u^2 and 2 (m - a) v = v^2.
  const Vector3 u = second - first, v = third - first, normal = u.cross(v);
  constexpr double flat = 1e-6;  // smallest sine of the angle at `first`; below it the radius is not determined
  if (!(normal.norm() > flat * u.norm() * v.norm())) return {};
  const Vector3 to_centre =
      (u.squaredNorm() * v.cross(normal) + v.squaredNorm() * normal.cross(u)) / (2 * normal.squaredNorm());
  Arc arc{first + to_centre, normal.normalized(), 0};
  const Vector3 begin = -to_centre, end = third - arc.centre;
  arc.angle = std::atan2(arc.axis.dot(begin.cross(end)), begin.dot(end));
  if (arc.angle <= 0) arc.angle += 2 * std::numbers::pi;
  return arc;
}

std::vector<Frame> poses_along(const Arc& arc, const Frame& start, double angle, bool turning) {
  const auto pose_at = [&](double way) {
    const Quaternion turn(Eigen::AngleAxisd(way, arc.axis));
    return Frame{arc.centre + turn * (start.position - arc.centre),
                 turning ? turn * start.orientation : start.orientation};
  };
  constexpr double longest = 0.75 * std::numbers::pi;  // [rad] keeps the three points of a step well apart
  const int steps = static_cast<int>(std::ceil(std::abs(angle) / longest));
  std::vector<Frame> poses;
  for (int half = 1; half <= 2 * steps; ++half) poses.push_back(pose_at(angle * half / (2 * steps)));
  return poses;
}

}  // namespace dresslife::sim::krl
