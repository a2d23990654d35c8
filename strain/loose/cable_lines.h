// Loose cables between two clamps, each by itself: where they rest (README W32 to W36).
//
// At A(s) in the hose's untwisted frame (strain/loose/hose_line.h) a cable has the energy
//     Pi = L W(mean g) + int E I |K - K0 + A'' - A0''|^2 / 2 - w . A + eta |A - A_before|^2 / 2 + contact ds,
//     g = e - K . A + |A'|^2 / 2,
// W that of its tension (strain/loose/tension.h), w weight and inertia per length, eta |..| what holds it
// sideways (W36), contact k_w depth^2 / 2 with the hose's wall, its core, and the bounds of its place. At the
// clamps it stays at its place A0, as it was laid there whatever the hose's twist (b = 0, A' = A0').
//
// Newton's method: bending and tension tie a node to the two next ones, so the matrix has two bands of 2 x 2
// blocks, and the stretch of the free length adds a matrix of rank one (Sherman and Morrison). No cable knows of
// another, so they go side by side in the lanes of a register (strain/loose/line_bench.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "strain/loose/cable.h"
#include "strain/loose/hose_line.h"
#include "strain/loose/lane_rows.h"
#include "strain/loose/tension.h"

namespace dresslife::strain {

/// A cable that is pulled with T between clamps bends at a clamp by B e^(-s/l), l = sqrt(E I/T), beside what changes slowly.
/// At nodes h apart, with q = (h/l)^2, the same angle makes second differences B' r^i, r + 1/r = 2 + q, which give at the clamp
///     B' = B/sqrt(1 + q/4).
/// at_clamp, next, after_next: curvature at the clamp and the two nodes beside it [1/m]; what changes slowly counts as straight
/// there. q: 0 where the cable is not pulled; then an eighth of the second difference is left.
/// Returns the curvature at the clamp.
Eigen::Vector2d bend_at_clamp(const Eigen::Vector2d& at_clamp, const Eigen::Vector2d& next, const Eigen::Vector2d& after_next,
                              double q);

class CableLines {
 public:
  /// hose: of so many nodes; it is read again in every call. presses: whether end() computes how they press.
  CableLines(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature, bool presses);
  CableLines(CableLines&&) = default;  // rows stay where they are

  std::size_t count() const { return cables_.size(); }
  const LooseCable& cable(std::size_t k) const { return cables_[k]; }
  const LineBatch& batch() const { return batch_; }

  /// (node) the directions in which a cable's place stays, cosine and sine against the untwisted frame: the hose's, or
  /// those of its ring.
  using Frame = std::vector<Eigen::Vector2d>;
  /// The next sample. frames: (cable). step: since the sample before [s]. goes_on: moves in the frame as it did then,
  /// else it stays as it was there.
  void begin(const HoseLine& hose, std::span<const Frame* const> frames, double step, bool goes_on);
  /// (cable) that they took to rest, of LineBench.
  std::span<std::int32_t> iterations() { return iterations_; }
  /// Cables of a ring (strain/loose/ring.h) to their places in a frame. with_slope: see LooseKernels.
  void place(const Frame& frame, bool with_slope);
  /// The sample is over. step: as in begin(); step 0: there was none before. states: (cable), or empty: not needed.
  void end(const HoseLine& hose, double step, std::span<CableState> states);

  /// The length of its path beyond the hose's axis at installation, over that.
  double laid_in(std::size_t k) const { return tensions_[k].laid_in(); }

  /// Before the first sample: cables go on from where those of another of as many cables and nodes are.
  void go_on_from(const CableLines& other);
  void feed_in(double share);  ///< see CableTension
  void shorten(std::size_t cable, double share) { tensions_[cable].shorten(share); }  ///< see CableTension

  /// What the distance h of the nodes leaves out of a path's waves: second differences have their curvature a by
  /// h^2 a'' / 12 wrong. Both squared and summed over nodes and samples so far, of which a state was asked.
  double bent(std::size_t cable) const { return lane_rows_[bent_sum * batch_.lanes + cable]; }      ///< its curvature, the hose's with it [1/m2]
  double missed(std::size_t cable) const { return lane_rows_[missed_sum * batch_.lanes + cable]; }  ///< of h^2 a'' / 12 [1/m2]

  static constexpr int most_iterations = 600;            ///< from one sample to the next; 2 to 60 but for a snap
  static constexpr int most_iterations_at_start = 2000;  ///< from its place to where it rests

 private:
  /// Of what is kept by lane.
  enum OfLane {
    bending_stiffness, axial_stiffness, mass_per_length, wall_stiffness, play, farthest, nearest, gap, per_radius, drag,
    free_length_rate, slipped, least_strain, most_strain, counts, strain, tension, stiffness, mean_gain, bent_sum, missed_sum,
    lane_rows
  };
  /// Of what is kept by node, each (node, 2, lane): of LineBatch, LineMemory and LineAnswer.
  enum OfNode {
    laid, laid_bent, rest, path, place_at, before, velocity, slope, gained, frame_at, bends, hose_bends, offset, node_rows
  };

  void lay(std::size_t k);
  double laid_gain(std::size_t k) const;
  void tell(const HoseLine& hose, std::size_t k, CableState& state) const;
  LineMemory memory();
  LineAnswer answer();
  double& of_lane(OfLane row, std::size_t k) { return lane_rows_[static_cast<std::size_t>(row) * batch_.lanes + k]; }
  Eigen::Vector2d vector(OfNode row, std::size_t node, std::size_t k) const;
  void put(OfNode row, std::size_t node, std::size_t k, const Eigen::Vector2d& value);
  void point_at_rows();

  std::vector<LooseCable> cables_;
  std::vector<CableTension> tensions_;
  double rest_curvature_;
  LineBatch batch_;
  LaneRows lane_rows_, node_rows_[OfNode::node_rows], press_, gain_;
  std::vector<std::int32_t> iterations_;
};

}  // namespace dresslife::strain
