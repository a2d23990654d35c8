#include "sim/run/periodic.h"

#include <algorithm>
#include <cmath>

namespace dresslife::sim {
namespace {

constexpr double sway_time = 0.1;   // tau of (R8) [s]
constexpr double same_pose = 1e-6;  // [m], [rad]: far below the repeatability of a robot, far above rounding

bool same(const Frame& a, const Frame& b) {
  return (a.position - b.position).norm() < same_pose &&
         rotation_vector(a.orientation.conjugate() * b.orientation).norm() < same_pose;
}

}  // namespace

double state_distance(const Rod& rod, const RodState& a, const RodState& b) {
  double largest = 0;
  for (int i = 0; i < rod.segments(); ++i) {
    const double turn = rotation_vector(a.orientation[i].conjugate() * b.orientation[i]).norm();
    const double radius = rod.span_of(i).properties.diameter / 2;
    largest = std::max(largest, (a.position[i] - b.position[i]).norm() + radius * turn +
                                    sway_time * (a.velocity[i] - b.velocity[i]).norm());
  }
  for (size_t k = 0; k < rod.spans().size(); ++k)
    largest = std::max(largest, std::abs(a.travel[k].way - b.travel[k].way) +
                                    sway_time * std::abs(a.travel[k].speed - b.travel[k].speed));
  return largest;
}

bool returns(const ClampPath& path) {
  const Pose begin = path.at(0), end = path.at(path.duration());
  // Joints distinguish full turns, which clamps do not.
  if (begin.joints.size() > 0) return (begin.joints - end.joints).lpNorm<Eigen::Infinity>() < same_pose;
  return same(begin.clamps.base, end.clamps.base) && same(begin.clamps.tool, end.clamps.tool);
}

}  // namespace dresslife::sim
