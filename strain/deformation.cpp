#include "strain/deformation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace dresslife::strain {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d position_at(std::span<const double> positions, std::size_t i) {
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

Quaterniond orientation_at(std::span<const double> orientations, std::size_t i) {
  return {orientations[4 * i], orientations[4 * i + 1], orientations[4 * i + 2], orientations[4 * i + 3]};
}

/// Returns the rotation vector of a quaternion, at most half a turn. The norm of the quaternion has no influence.
Vector3d logarithm(const Quaterniond& q) {
  const double side = q.w() < 0 ? -1 : 1, sine = q.vec().norm();
  // angle/sine of the half angle tends to 2/w; below 1e-9 the difference is less than rounding
  if (sine < 1e-9 * std::abs(q.w())) return 2 / q.w() * q.vec();
  return side * 2 * std::atan2(sine, side * q.w()) / sine * q.vec();
}

/// Returns the rotation about body z that a quaternion contains, in (-pi, pi].
double angle_about_tangent(const Quaterniond& q) {
  const double side = q.w() < 0 ? -1 : 1;
  return 2 * std::atan2(side * q.z(), side * q.w());
}

/// Returns the value at `at` on the line through (from, a) and (to, b).
Vector3d on_line(double at, double from, const Vector3d& a, double to, const Vector3d& b) {
  return a + (at - from) / (to - from) * (b - a);
}

void set(Deformation& deformation, const Vector3d& rate) {
  deformation.curvature1 = rate[0];
  deformation.curvature2 = rate[1];
  deformation.twist = rate[2];
}

/// Returns the curvature vector of the circle through b and its neighbours a and c, in the frame of b: t x (direction to
/// the centre)/r. Its size is 4 K / (A B C), K the area of the triangle (24).
Vector3d circle_curvature(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Quaterniond& frame) {
  const Vector3d before = b - a, after = c - b, across = c - a;
  const Vector3d normal = before.cross(after);  // length: twice the area; direction: axis of the bend
  return frame.conjugate() * (2 * normal / (before.norm() * after.norm() * across.norm()));
}

constexpr std::size_t fewest_for_curves = 7;

/// Values at 1/2, 3/2 and 5/2 of the parabola p through (5/12 p(0) + 13/12 p(1)) / (3/2), p(2) and p(3): factors of
/// these three data.
constexpr std::array<std::array<double, 3>, 3> end_weights{{{135.0 / 112, -55.0 / 224, 9.0 / 224},
                                                            {27.0 / 112, 213.0 / 224, -43.0 / 224},
                                                            {-9.0 / 112, 153.0 / 224, 89.0 / 224}}};
/// Factors for the value of this parabola at 0.
constexpr std::array<double, 3> clamp_weights{54.0 / 28, -39.0 / 28, 13.0 / 28};

}  // namespace

DeformationGauge::DeformationGauge(std::vector<double> lengths, pipeline::DeformationMeasure measure,
                                   std::optional<Vector3d> free_end)
    : lengths_(std::move(lengths)), measure_(measure), free_end_(std::move(free_end)), links_(lengths_.size() + 1) {
  assert(!lengths_.empty());
  const auto [shortest, longest] = std::ranges::minmax_element(lengths_);
  equal_lengths_ =
      *longest - *shortest <= 1e-9 * *longest;  // rounding when a length is divided by the number of segments
  link_lengths_.push_back(lengths_.front() / 2);
  for (std::size_t i = 1; i < lengths_.size(); ++i) link_lengths_.push_back((lengths_[i - 1] + lengths_[i]) / 2);
  link_lengths_.push_back(lengths_.back() / 2);
}

void DeformationGauge::measure(const ChainPose& pose, std::span<Deformation> out) {
  assert(out.size() == lengths_.size() && pose.segment_position.size() == 3 * lengths_.size());
  measure_links(pose);
  if (is_thesis(measure_) && lengths_.size() >= 3)
    circles(pose, out);
  else
    rotation_vectors(out);
  elongations(out);
}

std::array<bool, 2> DeformationGauge::knows_ends() const {
  const bool knows = !is_thesis(measure_) && equal_lengths_ && lengths_.size() >= fewest_for_curves;
  return {knows, knows && !free_end_};
}

void DeformationGauge::move_to_ends(std::span<Deformation> out) const {
  const std::size_t segments = lengths_.size();
  const auto [base, tool] = knows_ends();
  const auto at_end = [&](std::size_t first, std::size_t second, std::size_t third, std::size_t fourth) {
    const auto turn = [&](std::size_t link) { return links_[link].rotation; };
    return Vector3d((clamp_weights[0] / 1.5 * (turn(first) + turn(second)) + clamp_weights[1] * turn(third) +
                     clamp_weights[2] * turn(fourth)) /
                    lengths_.front());
  };
  if (base) set(out.front(), at_end(0, 1, 2, 3));
  if (tool) set(out.back(), at_end(segments, segments - 1, segments - 2, segments - 3));
}

void DeformationGauge::measure_links(const ChainPose& pose) {
  const std::size_t segments = lengths_.size(), last_clamp = pose.clamp_position.size() / 3 - 1;
  Quaterniond frame = orientation_at(pose.clamp_orientation, 0);
  Vector3d centre_before = position_at(pose.clamp_position, 0);
  Vector3d half_before = Vector3d::Zero();  // of the segment on the base side of the link
  for (std::size_t i = 0; i <= segments; ++i) {
    const bool at_tool = i == segments, between = i > 0 && !at_tool;
    const Quaterniond next =
        at_tool ? orientation_at(pose.clamp_orientation, last_clamp) : orientation_at(pose.segment_orientation, i);
    const Vector3d tangent = next * Vector3d::UnitZ();
    const Vector3d centre =
        position_at(at_tool ? pose.clamp_position : pose.segment_position, at_tool ? last_clamp : i);
    const Vector3d half = at_tool ? Vector3d::Zero() : Vector3d(lengths_[i] / 2 * tangent);
    const Quaterniond turn = frame.conjugate() * next;
    const Vector3d tangent_before = frame * Vector3d::UnitZ();
    const double arms = between ? 1 + (1 - tangent_before.dot(tangent)) / 12 : 1;  // (S17)
    const Vector3d gap = centre - centre_before - arms * (half + half_before);
    links_[i] = {logarithm(turn), angle_about_tangent(turn), gap.dot((tangent_before + tangent).normalized())};
    frame = next;
    centre_before = centre;
    half_before = half;
  }
}

void DeformationGauge::rotation_vectors(std::span<Deformation> out) const {
  const std::size_t segments = lengths_.size();
  if (segments < fewest_for_curves || !equal_lengths_) return rotation_vectors_on_lines(out);
  const double l = lengths_.front();
  auto rate = [&](std::size_t link) {
    return free_end_ && link == segments ? *free_end_ : Vector3d(links_[link].rotation / l);
  };
  const auto on_cubic = [&](std::size_t i) {
    return Vector3d((9 * (rate(i) + rate(i + 1)) - rate(i - 1) - rate(i + 2)) / 16);
  };
  for (std::size_t i = end_weights.size(); i + end_weights.size() < segments; ++i) set(out[i], on_cubic(i));
  const Vector3d base = (rate(0) + rate(1)) / 1.5, tool = (rate(segments) + rate(segments - 1)) / 1.5;
  for (std::size_t i = 0; i < end_weights.size(); ++i) {
    const auto& weight = end_weights[i];
    set(out[i], weight[0] * base + weight[1] * rate(2) + weight[2] * rate(3));
    if (!free_end_)
      set(out[segments - 1 - i], weight[0] * tool + weight[1] * rate(segments - 2) + weight[2] * rate(segments - 3));
  }
  if (!free_end_) return;
  for (std::size_t i = segments - end_weights.size(); i + 1 < segments; ++i) set(out[i], on_cubic(i));
  set(out[segments - 1], (3 * *free_end_ + 6 * rate(segments - 1) - rate(segments - 2)) / 8);
}

/// Rotation rates for unequal lengths or few segments: the value at the centre, on the line through two links. The two outermost
/// links of an end are merged into one at the middle of their common length.
void DeformationGauge::rotation_vectors_on_lines(std::span<Deformation> out) const {
  const std::size_t segments = lengths_.size();
  if (segments < 4) {  // too few links for a line beside the merged end links: mean values
    for (std::size_t i = 0; i < segments; ++i)
      set(out[i], (links_[i].rotation + links_[i + 1].rotation) / (link_lengths_[i] + link_lengths_[i + 1]));
    return;
  }
  std::vector<Vector3d> rate(segments + 1);
  std::vector<double> at(segments + 1);  // arc length from the base clamp [m]
  double arc = 0;
  for (std::size_t i = 0; i <= segments; ++i) {
    rate[i] = links_[i].rotation / link_lengths_[i];
    at[i] = arc;
    if (i < segments) arc += lengths_[i];
  }
  const double total = arc, first_span = link_lengths_[0] + link_lengths_[1];
  const double last_span = link_lengths_[segments - 1] + link_lengths_[segments];
  rate[1] = (links_[0].rotation + links_[1].rotation) / first_span;
  at[1] = first_span / 2;
  rate[segments - 1] = (links_[segments - 1].rotation + links_[segments].rotation) / last_span;
  at[segments - 1] = total - last_span / 2;
  double start = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    const std::size_t a = std::min(std::max<std::size_t>(i, 1), segments - 2);
    set(out[i], on_line(start + lengths_[i] / 2, at[a], rate[a], at[a + 1], rate[a + 1]));
    start += lengths_[i];
  }
}

void DeformationGauge::circles(const ChainPose& pose, std::span<Deformation> out) const {
  const std::size_t segments = lengths_.size();
  for (std::size_t i = 1; i + 1 < segments; ++i) {
    const Vector3d curvature =
        circle_curvature(position_at(pose.segment_position, i - 1), position_at(pose.segment_position, i),
                         position_at(pose.segment_position, i + 1), orientation_at(pose.segment_orientation, i));
    const double before = links_[i].tangent_angle / link_lengths_[i];
    const double after = links_[i + 1].tangent_angle / link_lengths_[i + 1];
    set(out[i], {curvature[0], curvature[1], (before + after) / 2});
  }
  auto end_segment = [&](std::size_t i, std::size_t neighbour) {
    const double twist =
        (links_[i].tangent_angle + links_[i + 1].tangent_angle) / (link_lengths_[i] + link_lengths_[i + 1]);
    set(out[i], {out[neighbour].curvature1, out[neighbour].curvature2, twist});
  };
  end_segment(0, 1);
  end_segment(segments - 1, segments - 2);
}

void DeformationGauge::elongations(std::span<Deformation> out) const {
  for (std::size_t i = 0; i < lengths_.size(); ++i)
    out[i].elongation = (links_[i].gap / link_lengths_[i] + links_[i + 1].gap / link_lengths_[i + 1]) / 2;
}

}  // namespace dresslife::strain
