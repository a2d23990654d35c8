// From the poses of the segments to curvature, twist and elongation of the dresspack in each segment (README
// W1-W4).
//
// Links: 0 ties the base clamp to segment 0, link i segment i-1 to segment i, link N the last segment to the
// tool clamp. A link spans the rest length between what it ties: half a segment at a clamp.
//
// `rotation_vector` (default): phi_i = log(q_a^* q_b) of link i, in the frame both sides share (a rotation
// leaves its axis where it is), over the link's length: (curvature1, curvature2, twist) at the link (W1). In
// the simulated chain that is the curvature there to the accuracy of the simulation, but for the two
// outermost links, whose compliances are 5/12 and 13/12 of a segment instead of 1/2 and 1 (Gregory's end
// correction). They enter through their sum only,
//     (phi_0 + phi_1) / (3/2 l) = (5/12 kappa(0) + 13/12 kappa(l)) / (3/2),
// which is also right for a uniform curve whose clamp links are half a segment. A segment takes the value at
// its centre of the cubic through the four links around it, the outermost three segments of the parabola
// through that sum and the next two links (W2): fourth and third order in l for the simulated chain. On poses
// sampled from a smooth curve phi_i is the mean over the link: second order inside; 0.03 of the change of
// curvature over one segment in the outermost ones.
//
// A hose bends most at its clamps, half a segment beyond the centre of its outermost segment. The same parabola gives
// the rates there, with third order in l (W39):
//     rate at the clamp = (54 (phi_0 + phi_1)/(3/2 l) - 39 phi_2/l + 13 phi_3/l) / 28.
//
// `thesis` (Backman 3.2): 1/r = 4 K/(A B C) of the circle through three successive centres (24), pointing to
// the side of the neighbours in the segment's own frame; twist = the angle of q_{i-1}^* q_i about the tangent
// over the length, mean of both sides (W4). End segments take the curvature of their neighbour. Error of
// second order inside, of first at the ends.
//
// Elongation, both: gap between the ends that a link ties, along the tangent, over the link's length, mean of
// both sides (W3).
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

/// Poses at one sample, laid out as in motion.h5: clamps are the base end (first) and the tool end (last).
struct ChainPose {
  std::span<const double> segment_position;     ///< (segment, xyz) [m]
  std::span<const double> segment_orientation;  ///< (segment, wxyz), body to world, body z = tangent
  std::span<const double> clamp_position;       ///< (clamp, xyz) [m]
  std::span<const double> clamp_orientation;    ///< (clamp, wxyz)
};

class DeformationGauge {
 public:
  /// lengths: rest length of each segment [m]. free_end: where the tool end is free, the rotation rates of
  /// the unloaded dresspack about d1, d2, d3, which it has there [1/m].
  DeformationGauge(std::vector<double> lengths, pipeline::DeformationMeasure measure,
                   std::optional<Eigen::Vector3d> free_end = {});

  /// The deformation of every segment. Precondition: `pose` has as many segments, `out` too.
  void measure(const ChainPose& pose, std::span<Deformation> out);
  /// Whether base and tool end have a deformation of their own (W39). A free end does not need one, and `thesis`, unequal
  /// lengths and fewer than seven segments do not give one.
  std::array<bool, 2> knows_ends() const;
  /// Replaces the outermost segments' deformation, as measure() gave it last, by that at the ends which knows_ends() names.
  void move_to_ends(std::span<Deformation> out) const;

 private:
  /// Per link: what ties a to b.
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
