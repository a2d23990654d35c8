// Path, force and elongation of the cables of one span between its two clamps ((W32) to (W37) in strain/theory.md).
// Cables are the parts of the first level that hold parts and slide. Their wires are evaluated later.
//
// A cable with a fixed place has the path of this place (W5). A loose cable has the path on which it rests (loose/).
// Both slide along their paths under friction and grips (sliding_line.h). pipeline/cable/cable_pulls.h computes the
// force from the strain, because it knows the metal. The memory of clamps and friction is that of a motion that was
// repeated many times: at least its last quarter is computed first, and the last repeat counts.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/cable/cable_pulls.h"
#include "strain/cable_rubbing.h"
#include "strain/loose/loose_cables.h"
#include "strain/path_rates.h"
#include "strain/segment_motion.h"
#include "strain/segment_rows.h"
#include "strain/sliding_line.h"

namespace dresslife::strain {

/// Samples of one span: deformation of the hose in each segment, and the accelerations that load its contents.
struct SpanBlock {
  const DeformationHistory& deformation;
  /// Gravity minus acceleration along d1 and d2 (sample, segment, 2) [m/s2]; empty: no load.
  std::span<const double> pull{};
  double step = 0.04;  ///< time between samples [s]
  /// Deformation at base and tool end, where KnownEnds is true (sample, 2).
  std::span<const Deformation> ends{};
};

/// Ends of a span, base and tool, at which the hose's own deformation is known (W39). Wires of the outermost segments are
/// evaluated there and not at the segments' centres.
using KnownEnds = std::array<bool, 2>;

/// How the cables of the job itself move along the hose.
struct CablesInJob {
  bool rub = false;    ///< they slide with friction
  bool stick = false;  ///< they stick to the hose, each segment with its own strain: they slide only in a bound
  /// The hose's tool end is free: only a tool_grip_N of the job holds its cables there.
  bool free_tool_end = false;
  std::size_t elements_per_segment =
      0;  ///< elements of loose cables; 0: the number follows from the length of their waves
  KnownEnds known_ends{};
  std::array<double, 2>
      relief_stiffness{};       ///< of the bend reliefs at base and tool end, which bend with the hose [N m2]
  double stiffness_factor = 1;  ///< of the hose in this motion, on its bending stiffness
};

class CablePaths {
 public:
  /// plan: how each layer slides. lengths, arcs: of the span's segments [m].
  CablePaths(const Construction& construction, const std::vector<LayerSlip>& plan, const CablesInJob& job,
             std::vector<double> lengths, const std::vector<double>& arcs, std::size_t samples,
             const Scratch& scratch = {});

  /// Returns whether any cable can slide.
  bool any() const { return !cables_.empty(); }
  bool any_loose() const { return loose_ != nullptr; }
  /// Returns whether strains depend on the past through clamps or friction. Then they are known only after finish().
  bool remembers() const;

  /// Uses the loose cables of `other`, if they rest at the same places. For example, friction along the hose does not move them.
  /// other: the same span of the same dresspack with other factors. Call before the first sample.
  void share_loose(const CablePaths& other);
  bool shares_loose(const CablePaths& other) const { return loose_ && loose_ == other.loose_; }

  /// Returns whether loose cables form a ring. The rest of a ring depends on its start.
  bool any_ring() const { return loose_ && loose_->any_ring(); }
  /// Starts the rings in a randomly wound shape. Call before the first sample.
  void wind(std::uint64_t seed) { loose_->wind(seed); }
  /// Moves the loose cables to the positions of `other`, which is the same span of the same dresspack with other factors. Their
  /// own slack is fed in over the first `feeding` seconds. Call between samples of a lead-in, before the first own sample.
  void go_on_from(const CablePaths& other);
  /// Returns the distance between loose cables and the same cables from another start (LooseCables::apart()).
  double apart(const CablePaths& other) const { return loose_->apart(*other.loose_); }
  /// Computes for each segment and loose cable the sum over turning points of (change of curvature)^8, the largest of four
  /// directions. Precondition: all samples were added.
  void find_bent();
  /// Returns the parts of the loose cables whose sum in this segment is at least a thousandth of the largest sum of their
  /// component. Precondition: find_bent().
  std::vector<int> bent_most(std::size_t segment) const;

  /// Lets cables with friction record where they rub, see rubbing(). Call before the first sample.
  void record_rubbing();
  void add(const SpanBlock& block);  ///< blocks in order of time
  /// Adds a block to the paths of several evaluations of one span and computes their loose cables side by side. Each result is
  /// that of a separate call. Precondition: `all` contains every object that shares loose cables with one of `all`.
  static void add(std::span<CablePaths* const> all, const SpanBlock& block);
  /// Moves the loose cables through samples before the first one, to the places where a repeat of the motion leaves them. The
  /// block can have more samples than the history of the cables, which may follow a shortened motion.
  static void lead_in(std::span<CablePaths* const> all, const SpanBlock& block);
  /// Ends a repeat of a lead-in and begins the next one, or the one that counts. further: see LooseCables::end_repeat().
  static void end_repeat(std::span<CablePaths* const> all, double further);
  /// Returns whether the loose cables have all of their slack and have reached a cycle (LooseCables::in_cycle()).
  bool in_cycle() const { return loose_ && loose_->in_cycle(); }
  /// Forgets the samples but not where the loose cables are, so that the motion can follow once more. Call it instead of finish()
  /// after the last sample, for all objects that share loose cables.
  void repeat();
  void finish();  ///< after the last sample; a second call changes nothing

  // ---- after finish() ------------------------------------------------------------------------------

  /// State of one segment at `count` samples from `first` on. hose: the hose's columns at these samples. Loose cables have their
  /// mean curvature in the segment; with at_wires the curvature where the wires are evaluated. Valid until the next of().
  class Keeper {
   public:
    const SegmentMotion& of(const CablePaths& paths, std::size_t segment, const DeformationColumns& hose,
                            std::size_t first, std::size_t count, bool at_wires = false);

   private:
    SegmentMotion motion_;
    std::vector<std::vector<double>> rows_;
  };

  std::size_t samples() const { return next_; }
  std::size_t cables() const { return cables_.size(); }
  const std::string& name(std::size_t cable) const;
  /// Returns the law of the cable's force and its places at the clamps.
  const pipeline::PulledCable& pulled(std::size_t cable) const { return cables_[cable].pulled; }
  /// Returns where the cable's force is largest at a sample, from the base end of the span [m]; -1: it is the same along the cable.
  double place_of_force(std::size_t cable, std::size_t sample) const;
  /// Returns the index among the dresspack's components.
  int component(std::size_t cable) const;
  /// Returns the sliding distance in both directions together in one repeat of the motion, at base and tool clamp [m].
  std::array<double, 2> grip_slip(std::size_t cable) const { return cables_[cable].grip_slip; }
  /// Returns where the jacket rubs in one repeat; null: it was not recorded.
  const CableRubbing* rubbing(std::size_t cable) const {
    return cables_[cable].rubbing ? &*cables_[cable].rubbing : nullptr;
  }
  /// Returns the radius of the helix into which the cable can wind [m]; 0: it is held.
  double room(std::size_t cable) const { return cables_[cable].room; }
  /// Reads samples of the curvature of a loose cable. part: of the cable. row: 0: base end, then the segments, then the tool end.
  /// Returns whether the cable is loose.
  bool read_curvature(int part, std::size_t row, int about, std::size_t first, std::size_t count, double* to) const;
  /// Reads samples of the strain of a cable in a segment. part: of the cable; 0 if it sticks to the hose.
  void read_strain(int part, std::size_t segment, std::size_t first, std::size_t count, double* to) const;
  /// Returns the largest curvature of the path where the wires are evaluated [1/m]; 0: it is held.
  double largest_curvature(std::size_t cable) const;
  /// Returns the least and the largest growth of the path over the motion, relative to its length as installed without slack.
  /// Least: the cable goes as far outward in each bend as its room allows. Largest: it goes inward. Cables of a ring move only by
  /// the gap to their neighbours. Twist counts as the shortening that it would cause. A slack between the two values is neither
  /// too long nor too short at any time.
  const std::array<double, 2>& path_gain(std::size_t cable) const { return cables_[cable].path_gain; }
  /// Returns the moment that bends the simulated hose: the larger one of both clamps (sample) [N m].
  const std::vector<double>& hose_moment() const { return hose_moment_; }
  /// Samples for which offsets() has the places of loose cables.
  const std::vector<std::size_t>& offset_samples() const { return offset_samples_; }
  const std::vector<double>& offsets() const {
    return offsets_;
  }  ///< (sample, cable, segment, 2) from their own places [m]
  /// Returns the number of elements of a loose cable in each segment; 0: no cable is loose.
  std::size_t elements_per_segment() const { return loose_ ? (nodes_.size() - 1) / node_segments() : 0; }
  /// Returns the share of the curvature of loose cables that the distance of their nodes misses; 0: no cable is loose.
  double mesh_error() const { return loose_ ? loose_->mesh_error() : 0; }
  /// Returns the number of samples at which a loose cable did not come to rest.
  std::size_t restless() const { return loose_ ? loose_->restless() : 0; }
  /// Returns the change of curvature of loose cables in the repeat (LooseCables::changed()).
  double changed() const { return loose_ ? loose_->changed() : 0; }
  /// Returns whether the repeat leaves the loose cables where it found them.
  bool closes() const { return !(changed() > LooseCables::most_change); }
  /// Returns where it changed most: the cable, and the place from the base end of the span. Precondition: changed() > 0.
  ChangedPlace most_changed() const;

 private:
  struct Cable {
    int part;
    bool loose, remembers, rubs, sticks;
    double axial_stiffness, slack, friction, line_load, base_grip, tool_grip;
    double radial_share;             ///< share of its strain that remains with the bed of its layer (W31)
    double elastic;                  ///< share of the deviation from the mean that a jacket holds (W30)
    pipeline::PulledCable pulled{};  ///< at the clamps' ends
    std::array<double, 2> grip_slip{};
    double room = 0;                                                 ///< see room()
    std::array<double, 2> path_gain{without_limit, -without_limit};  ///< see path_gain()
    std::vector<double> strain{};  ///< (sample) strain of all segments; before finish(): without sliding
    std::vector<double>
        along{};  ///< (sample, segment) strain of each segment, with friction; before finish(): without sliding
    std::vector<float> pressing{};  ///< (sample, segment) curvature [1/m]; of a loose cable its contact force [N/m]
    std::optional<CableRubbing> rubbing{};
  };

  /// Number of segments into which the nodes of loose cables divide the hose: at least 8, also if the hose has fewer.
  std::size_t node_segments() const { return std::max<std::size_t>(lengths_.size(), 8); }
  /// Index into `along` and `pressing`. All segments of a sample lie side by side, because they slide together.
  std::size_t along_at(std::size_t segment, std::size_t sample) const { return sample * lengths_.size() + segment; }
  void add_hose(const SpanBlock& block);
  void add_held(const SpanBlock& block);
  static void add_loose(std::span<CablePaths* const> all, const SpanBlock& block);
  void find_nodes(const SpanBlock& block, std::size_t sample);
  double mean_twist(const SpanBlock& block, std::size_t of_block) const;
  void shorten_loose(double twist);
  void feed_slack(double step);
  void see_gain(Cable& cable, std::size_t sample, double gain, double relief);
  void see_gains(const std::vector<HoseNode>& nodes, std::size_t of_block);
  void see_held_gains();
  std::size_t wires_at(std::size_t segment) const;
  void put_loose(std::size_t of_block);
  void put_loose(std::size_t cable, std::size_t state, std::size_t sample);
  void put_curvature(std::size_t of_block);
  void put_offsets(std::size_t sample);
  void add_stuck(Cable& cable, std::size_t segment, const double* twist, std::span<const double> path, double rest);
  /// Returns the strain that makes force in addition to the strain of the axis: the shortening that twist would cause in a free
  /// cable.
  double pulled_by_twist(const Cable& cable, double twist) const;
  void slide(Cable& cable);
  void record_slide(Cable& cable, const SlidingLine& line, std::span<const double> unslid, std::size_t sample) const;
  void ask_for_forces();

  const Construction& construction_;
  std::vector<double> lengths_;
  std::size_t stride_, all_, next_ = 0;
  bool finished_ = false;
  std::vector<Cable> cables_;
  std::vector<std::size_t> held_;  ///< indices into cables_, in the order of rates_
  std::optional<PathRates> rates_;
  std::vector<std::size_t> loosened_;   ///< indices into cables_, in the order of loose_
  std::shared_ptr<LooseCables> loose_;  ///< null: no cable is loose
  KnownEnds known_ends_;
  std::array<double, 2> relief_stiffness_;
  double stiffness_factor_;
  /// (segment, base end, tool end; loose cable x 2; sample) curvature of their paths [1/m], shared like loose_
  std::shared_ptr<SegmentRows> curvature_;
  double first_share_ = 1, fed_ = 0;  ///< share of the slack at go_on_from(), and time since then [s]
  std::vector<HoseNode> nodes_;
  std::vector<double> hose_twist_;     ///< (sample) mean along the hose [rad/m]
  std::vector<float> hose_curvature_;  ///< (clamp, 2, sample) at base and tool end [1/m]
  std::vector<double> hose_moment_, offsets_;
  std::vector<std::size_t> offset_samples_;
  std::vector<double> bending_sums_;  ///< (segment, loose cable)
};

}  // namespace dresslife::strain
