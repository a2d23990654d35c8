#include "sim/program/krl/spline.h"

#include <algorithm>
#include <vector>

namespace dresslife::sim {
namespace {

constexpr double spline_step = 0.02;  // length of the lines along the curve [m]
constexpr int most_steps = 50;        // from one SPL point to the next

/// Returns the unit tangent of the curve at point k: the slope of the parabola through three points, with the chord
/// length as its parameter.
Vector3 slope_at(const std::vector<Frame>& points, std::size_t k) {
  const auto chord = [&](std::size_t i) { return Vector3(points[i + 1].position - points[i].position); };
  const auto along = [&](std::size_t i) { return Vector3(chord(i) / std::max(chord(i).norm(), 1e-12)); };
  if (points.size() < 3) return along(0);
  const auto mirrored = [](const Vector3& slope, const Vector3& across) {
    return Vector3(2 * across.dot(slope) * across - slope);
  };
  if (k == 0) return mirrored(slope_at(points, 1), along(0));
  if (k + 1 == points.size()) return mirrored(slope_at(points, k - 1), along(k - 1));
  const double before = chord(k - 1).norm(), behind = chord(k).norm();
  return (behind * along(k - 1) + before * along(k)).normalized();
}

/// Appends the cubic from point k to point k + 1 as lines. target: the move to point k + 1.
void add_curve(const std::vector<Frame>& points, std::size_t k, const Instruction& target,
               std::vector<Instruction>& bent) {
  const Frame &from = points[k], &to = points[k + 1];
  const double length = (to.position - from.position).norm();
  const int steps = points.size() < 3 ? 1 : std::clamp(static_cast<int>(length / spline_step), 1, most_steps);
  const Vector3 begin = length * slope_at(points, k), finish = length * slope_at(points, k + 1);
  for (int step = 1; step <= steps; ++step) {
    const double u = static_cast<double>(step) / steps, v = 1 - u;
    Instruction part = target;
    if (step < steps) {
      part.zone = {0, 100};
      part.target.pose = {
          v * v * (1 + 2 * u) * from.position + u * u * (1 + 2 * v) * to.position + u * v * (v * begin - u * finish),
          from.orientation.slerp(u, to.orientation)};
    }
    bent.push_back(std::move(part));
  }
}

/// Whether the poses of two moves have the same tool and work object.
bool same_frames(const Instruction& a, const Instruction& b) {
  return a.kind != Instruction::Kind::dwell && a.target.joints.empty() && b.target.joints.empty() && a.tool == b.tool &&
         a.work_object == b.work_object;
}

}  // namespace

void bend_splines(const std::set<std::size_t>& spline_points, Program& program) {
  const std::vector<Instruction>& moves = program.instructions;
  std::vector<Instruction> bent;
  for (std::size_t i = 0; i < moves.size();) {
    std::size_t end = i;  // end of the SPL points with the frames of the move before them
    while (i > 0 && end < moves.size() && spline_points.contains(end) && same_frames(moves[i - 1], moves[end])) ++end;
    if (end == i) {
      bent.push_back(moves[i++]);
      continue;
    }
    std::vector<Frame> points;
    for (std::size_t k = i - 1; k < end; ++k) points.push_back(moves[k].target.pose);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) add_curve(points, k, moves[i + k], bent);
    i = end;
  }
  program.instructions = std::move(bent);
}

}  // namespace dresslife::sim
