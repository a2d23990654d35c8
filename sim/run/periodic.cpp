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

/// Returns the state at a share of the step between two states: what state_distance() compares, linear in time.
RodState between(const RodState& from, const RodState& to, double share) {
  RodState state = to;
  for (std::size_t i = 0; i < to.position.size(); ++i) {
    state.position[i] = (1 - share) * from.position[i] + share * to.position[i];
    state.orientation[i] = from.orientation[i].slerp(share, to.orientation[i]);
    state.velocity[i] = (1 - share) * from.velocity[i] + share * to.velocity[i];
  }
  for (std::size_t k = 0; k < to.travel.size(); ++k) {
    state.travel[k].way = (1 - share) * from.travel[k].way + share * to.travel[k].way;
    state.travel[k].speed = (1 - share) * from.travel[k].speed + share * to.travel[k].speed;
  }
  return state;
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

LeftOutRounds::LeftOutRounds(const Rod& rod, const ClampPath& path, double tolerance)
    : rod_(rod), tolerance_(tolerance) {
  if (const auto* robot = dynamic_cast<const RobotPath*>(&path)) loops_ = loops_of(robot->motion());
}

double LeftOutRounds::see(double time, double step, const RodState& state) {
  if (loop_ == loops_.size()) return 0;
  const MotionLoop& loop = loops_[loop_];
  const double begins = loop.begin + round_ * loop.round;
  double left_out = 0;
  if (time >= begins) {
    RodState now = before_.position.empty() ? state : between(before_, state, 1 - (time - begins) / step);
    if (at_begin_ && state_distance(rod_, *at_begin_, now) <= tolerance_) {
      left_out = loop.end() - begins;
      round_ = loop.rounds;
    } else {
      at_begin_ = std::move(now);
      ++round_;
    }
    if (round_ == loop.rounds) {
      ++loop_, round_ = 0;
      at_begin_.reset();
    }
  }
  before_ = state;
  return left_out;
}

bool returns(const ClampPath& path) {
  const Pose begin = path.at(0), end = path.at(path.duration());
  // Joints distinguish full turns, which clamps do not.
  if (begin.joints.size() > 0) return (begin.joints - end.joints).lpNorm<Eigen::Infinity>() < same_pose;
  return same(begin.clamps.base, end.clamps.base) && same(begin.clamps.tool, end.clamps.tool);
}

}  // namespace dresslife::sim
