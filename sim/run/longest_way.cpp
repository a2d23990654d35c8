#include "sim/run/longest_way.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "pipeline/job/setup.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double most_moments = 1e6;

struct SamePiece {
  bool operator()(const MotionPiece* a, const MotionPiece* b) const {
    const auto same = [](const VectorXd& x, const VectorXd& y) { return x.size() == y.size() && x == y; };
    return a->duration == b->duration && a->ramp == b->ramp && same(a->position, b->position) &&
           same(a->velocity_before, b->velocity_before) && same(a->velocity_change, b->velocity_change) &&
           same(a->acceleration, b->acceleration) && same(a->jerk, b->jerk);
  }
};
struct HashPiece {
  std::size_t operator()(const MotionPiece* piece) const {
    std::size_t hash = std::hash<double>{}(piece->duration);
    for (const VectorXd* of : {&piece->position, &piece->velocity_before})
      for (const double value : *of) hash = 31 * hash + std::hash<double>{}(value);
    return hash;
  }
};

/// Returns the pieces without those that are equal to an earlier one.
std::vector<const MotionPiece*> different_pieces(const JointMotion& motion) {
  std::unordered_set<const MotionPiece*, HashPiece, SamePiece> known;
  std::vector<const MotionPiece*> pieces;
  for (const MotionPiece& piece : motion.pieces())
    if (known.insert(&piece).second) pieces.push_back(&piece);
  return pieces;
}

}  // namespace

std::vector<LongestWay> longest_ways(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, double step) {
  std::vector<LongestWay> longest(rod.spans().size());
  const auto see = [&](double time) {
    const Pose pose = path.at(time);
    const std::vector<double> ways = shortest_ways(setup, rod, pose.clamps, pose.rings);
    for (std::size_t span = 0; span < ways.size(); ++span)
      if (rod.spans()[span].properties.tool_end != End::free && ways[span] > longest[span].way)
        longest[span] = {ways[span], time};
  };
  const auto* robot = dynamic_cast<const RobotPath*>(&path);
  if (!robot) {
    step = std::max(step, path.duration() / most_moments);
    const auto steps = static_cast<int>(std::ceil(path.duration() / step));
    for (int k = 0; k <= steps; ++k) see(std::min(k * step, path.duration()));
    return longest;
  }
  const std::vector<const MotionPiece*> pieces = different_pieces(robot->motion());
  double duration = 0;
  for (const MotionPiece* piece : pieces) duration += piece->duration;
  step = std::max(step, duration / most_moments);
  for (const MotionPiece* piece : pieces)
    for (int k = 0; k * step < piece->duration; ++k) see(piece->start + k * step);
  return longest;
}

}  // namespace dresslife::sim
