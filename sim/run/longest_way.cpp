#include "sim/run/longest_way.h"

#include <algorithm>
#include <cmath>

#include "pipeline/job/setup.h"
#include "sim/robot/loops.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double most_moments = 1e6;

/// Returns the pieces without those that are equal to an earlier one.
std::vector<const MotionPiece*> different_pieces(const JointMotion& motion) {
  const std::vector<std::size_t> first = first_equal_pieces(motion);
  std::vector<const MotionPiece*> pieces;
  for (std::size_t k = 0; k < first.size(); ++k)
    if (first[k] == k) pieces.push_back(&motion.pieces()[k]);
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
