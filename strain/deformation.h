// Curvature, twist and elongation of the dresspack in each segment, from the poses of the segments ((W1) to (W4), (W39)).
//
// Links: link 0 connects the base clamp to segment 0, link i segment i-1 to segment i, link N the last segment to the tool
// clamp. A link has the rest length between the poses that it connects: half a segment at a clamp.
//
// `rotation_vector` (default): phi_i = log(q_a^* q_b) of link i, in the frame that both sides share (a rotation does not
// change its axis). phi_i over the link's length is (curvature1, curvature2, twist) at the link (W1). In the simulated chain
// this is the curvature to the accuracy of the simulation, except at the two outermost links. Their compliances are 5/12 and
// 13/12 of a segment instead of 1/2 and 1 (Gregory's end correction). They enter by their sum only:
//     (phi_0 + phi_1) / (3/2 l) = (5/12 kappa(0) + 13/12 kappa(l)) / (3/2).
// This holds also for a uniform curve whose clamp links are half a segment. The value of a segment (W2) is that of a curve at
// the segment's centre: of the cubic through the four links around it, or in the outermost three segments of the parabola
// through this sum and the next two links. For the simulated chain the errors are of fourth and third order in l. For poses
// sampled from a smooth curve phi_i is the mean over the link: second order inside, and in the outermost segments an error of
// 0.03 of the change of curvature over one segment.
//
// A hose bends most at its clamps, half a segment beyond the centre of its outermost segment. The same parabola gives the rates
// at the clamp, with an error of third order in l (W39):
//     rate at the clamp = (54 (phi_0 + phi_1)/(3/2 l) - 39 phi_2/l + 13 phi_3/l) / 28.
//
// `thesis` (Backman 3.2): 1/r = 4 K/(A B C) of the circle through three successive centres (24), directed to the side of the
// neighbours in the segment's own frame. Twist = the angle of q_{i-1}^* q_i about the tangent over the length, mean of both
// sides (W4). End segments have the curvature of their neighbour. The error is of second order inside, of first order at the
// ends.
//
// Elongation, in both: distance between the poses that a link connects, along the tangent, over the link's length; mean of both
// sides (W3).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/job/strain.h"

namespace dresslife::strain {

/// State of the dresspack in one segment, in the segment's frame (d1, d2, d3 = tangent toward the tool).
struct Deformation {
  double curvature1 = 0, curvature2 = 0;  ///< rotation rate about d1 and d2 [1/m]
  double twist = 0;                       ///< rotation rate about the tangent [rad/m]
  double elongation = 0;                  ///< relative change of length
};

/// Poses at one sample, in the layout of motion.h5. Of the clamps, the first is the base end and the last the tool end.
struct ChainPose {
  std::span<const double> segment_position;     ///< (segment, xyz) [m]
  std::span<const double> segment_orientation;  ///< (segment, wxyz), body to world, body z = tangent
  std::span<const double> clamp_position;       ///< (clamp, xyz) [m]
  std::span<const double> clamp_orientation;    ///< (clamp, wxyz)
};

class DeformationGauge {
 public:
  /// lengths: rest length of each segment [m]. free_end: rotation rates of the unloaded dresspack about d1, d2, d3 [1/m], which
  /// a free tool end has; empty: a clamp holds the tool end.
  DeformationGauge(std::vector<double> lengths, pipeline::DeformationMeasure measure,
                   std::optional<Eigen::Vector3d> free_end = {});

  /// Writes the deformation of every segment. Precondition: `pose` and `out` have one entry per segment of `lengths`.
  void measure(const ChainPose& pose, std::span<Deformation> out);
  /// Returns whether the deformation at the base end and at the tool end is known (W39). A free end does not need it. `thesis`,
  /// unequal lengths and fewer than seven segments do not give it.
  std::array<bool, 2> knows_ends() const;
  /// Replaces the outermost segments' deformation of the last measure() by that at the ends for which knows_ends() is true.
  void move_to_ends(std::span<Deformation> out) const;

 private:
  /// One link, which connects pose a to pose b.
  struct Link {
    Eigen::Vector3d rotation;  ///< log(q_a^* q_b) [rad]
    double tangent_angle;      ///< of q_a^* q_b about the tangent [rad]
    double gap;                ///< [m]
  };

  void measure_links(const ChainPose& pose);
  void rotation_vectors(std::span<Deformation> out) const;
  void rotation_vectors_on_lines(std::span<Deformation> out) const;
  void circles(const ChainPose& pose, std::span<Deformation> out) const;
  void elongations(std::span<Deformation> out) const;

  std::vector<double> lengths_, link_lengths_;
  bool equal_lengths_;
  pipeline::DeformationMeasure measure_;
  std::optional<Eigen::Vector3d> free_end_;
  std::vector<Link> links_;
};

}  // namespace dresslife::strain
