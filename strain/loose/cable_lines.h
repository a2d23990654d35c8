// Rest of loose cables between two clamps, each cable by itself ((W32) to (W36) in strain/theory.md).
//
// A cable at A(s) in the hose's untwisted frame (strain/loose/hose_line.h) has the energy
//     Pi = L W(mean g) + int E I |K - K0 + A'' - A0''|^2 / 2 - w . A + eta |A - A_before|^2 / 2 + contact ds,
//     g = e - K . A + |A'|^2 / 2,
// W is the energy of its tension (strain/loose/tension.h), w weight and inertia per length, eta |..| the drag that holds it
// sideways (W36, W42). Contact is k_w depth^2 / 2 with the hose's wall, its core, and the limits of its place. At the clamps it stays
// at its place A0 as it was laid, whatever the hose's twist (b = 0, A' = A0').
//
// Dry friction (W42) holds a cable by a spring that slides: in one direction the force per length is k u, at most mu N. u is the
// displacement from the point where the cable sticks; where the force is mu N, this point follows. Around the hose N is the
// force on wall and core plus the line load, outward it is the force on neighbours. N and the direction are those of the
// previous sample, so the force has an energy, k u^2/2 or mu N |u| - (mu N)^2/(2 k), which is added to Pi.
//
// Newton's method: bending and tension connect a node with the next two, so the matrix has two bands of 2 x 2
// blocks. The stretch of the free length adds a matrix of rank one (Sherman and Morrison). Cables do not depend on each other
// here and are computed side by side in the lanes of a register (strain/loose/line_bench.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "strain/loose/cable.h"
#include "strain/loose/hose_line.h"
#include "strain/loose/kernels/loose_kernels.h"
#include "strain/loose/tension.h"

namespace dresslife::strain {

/// Starts at a cache line.
class LaneRows {
 public:
  void assign(std::size_t rows, std::size_t in_row) { blocks_.assign(rows * in_row / most_lanes, {}); }
  double* data() { return blocks_.empty() ? nullptr : blocks_.front().of; }
  const double* data() const { return blocks_.empty() ? nullptr : blocks_.front().of; }
  double& operator[](std::size_t k) { return data()[k]; }
  double operator[](std::size_t k) const { return data()[k]; }

 private:
  struct alignas(64) Block {
    double of[most_lanes] = {};
  };
  std::vector<Block> blocks_;
};

/// Returns the curvature of a cable at a clamp. A cable with the tension T between clamps bends there by B e^(-s/l),
/// l = sqrt(E I/T), in addition to a slow variation. At nodes h apart, with q = (h/l)^2, the same angle makes second differences
/// B' r^i, r + 1/r = 2 + q, whose value at the clamp is
///     B' = B/sqrt(1 + q/4).
/// at_clamp, next, after_next: curvature at the clamp and at the next two nodes [1/m]; the slow variation is taken as linear.
/// q: 0 for a cable without tension; then an eighth of the second difference is added.
Eigen::Vector2d bend_at_clamp(const Eigen::Vector2d& at_clamp, const Eigen::Vector2d& next,
                              const Eigen::Vector2d& after_next, double q);

class CableLines {
 public:
  /// What the cables are for: their rest with or without the contact forces, or the turn of their ring.
  enum class Use { presses, rests, turns };
  /// hose: gives the number of nodes.
  CableLines(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature, Use use);
  CableLines(CableLines&&) = default;  // the addresses of the rows are kept

  std::size_t count() const { return cables_.size(); }
  const LooseCable& cable(std::size_t k) const { return cables_[k]; }
  const LineBatch& batch() const { return batch_; }

  /// (node) the frame in which a cable's place is constant, as cosine and sine against the untwisted frame: the hose's frame, or
  /// that of its ring.
  using Frame = std::vector<Eigen::Vector2d>;
  /// Starts the next sample. frames: (cable). step: since the previous sample [s]. goes_on: the cable starts with its velocity in
  /// the frame at the previous sample, else at its previous position in the frame. rubs: dry friction acts; false while the
  /// cables are installed.
  void begin(const HoseLine& hose, std::span<const Frame* const> frames, double step, bool goes_on, bool rubs);
  /// Moves cables with their ring over their support. radii: of their places (lane), 0: not in the ring [m]. turned: of the ring
  /// against the hose since the previous sample (node) [rad].
  void carry(const std::vector<double>& radii, const std::vector<double>& turned);
  /// Takes over the friction around the hose. numbers: of the cables in another object with the same number of nodes.
  void take_friction(const CableLines& from, std::span<const std::size_t> numbers);
  /// Returns the numbers of iterations to rest (cable), written by LineBench.
  std::span<std::int32_t> iterations() { return iterations_; }
  /// Move the cables of a ring (strain/loose/ring.h) to their places in a frame, see LooseKernels.
  void place(const Frame& frame);
  void turn(const Frame& frame, const std::vector<double>& turned, const RingSystem& system);
  /// Ends the sample. step: as in begin(); 0: there was no previous sample. states: (cable); empty: not needed. whole: fills them,
  /// otherwise only their strain.
  void end(const HoseLine& hose, double step, std::span<CableState> states, bool whole);

  /// Returns the length of its path beyond the hose's axis at installation, over the length of the axis.
  double laid_in(std::size_t k) const { return tensions_[k].laid_in(); }

  /// Continues from the state of another object with the same numbers of cables and nodes. Call before the first sample.
  void go_on_from(const CableLines& other);
  void feed_in(double share);                                                         ///< see CableTension
  void shorten(std::size_t cable, double share) { tensions_[cable].shorten(share); }  ///< see CableTension

  /// Error by the distance h of the nodes: second differences of a wave have a curvature a that is wrong by h^2 a'' / 12. bent()
  /// and missed() are the squares of curvature and error, summed over nodes and over the samples whose state was asked for.
  double bent(std::size_t cable) const { return lane_rows_[bent_sum * batch_.lanes + cable]; }  ///< of curvature [1/m2]
  double missed(std::size_t cable) const {
    return lane_rows_[missed_sum * batch_.lanes + cable];
  }  ///< of h^2 a'' / 12 [1/m2]

  static constexpr int most_iterations = 600;            ///< per sample; usually 2 to 60, more in a snap
  static constexpr int most_iterations_at_start = 2000;  ///< from its place to its first rest

 private:
  /// Rows with one value per lane.
  enum OfLane {
    bending_stiffness,
    axial_stiffness,
    mass_per_length,
    wall_stiffness,
    play,
    farthest,
    nearest,
    gap,
    per_radius,
    drag,
    friction,
    line_load,
    stick,
    free_length_rate,
    slipped,
    least_strain,
    most_strain,
    counts,
    strain,
    tension,
    stiffness,
    mean_gain,
    bent_sum,
    missed_sum,
    lane_rows
  };
  /// Rows with a vector per node, each (node, 2, lane): of LineBatch, LineMemory and LineAnswer.
  enum OfNode {
    laid,
    laid_bent,
    rest,
    path,
    place_at,
    before,
    velocity,
    frame_at,
    bends,
    hose_bends,
    offset,
    around,
    stretch,
    most_friction,
    node_rows
  };

  void lay(std::size_t k);
  double laid_gain(std::size_t k) const;
  void put_state(const HoseLine& hose, std::size_t k, CableState& state) const;
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
