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

/// Samples of a span: what the hose does in each segment, and what pulls at things in it.
struct SpanBlock {
  const DeformationHistory& deformation;
  /// Gravity less acceleration along d1 and d2 (sample, segment, 2) [m/s2]; empty: nothing pulls.
  std::span<const double> pull{};
  double step = 0.04;  ///< time between samples [s]
  /// At base and tool end, where KnownEnds says so (sample, 2).
  std::span<const Deformation> ends{};
};

/// Ends of a span, base and tool, at which the hose's own deformation is known (W39). Wires of the outermost segments are
/// evaluated there and not at the segments' centres.
using KnownEnds = std::array<bool, 2>;

/// What cables do along the hose in the job itself.
struct CablesInJob {
  bool rub = false;    ///< slide with friction
  bool stick = false;  ///< to the hose, each segment with its own strain: they slide in a bound only
  /// The hose ends freely at its tool end: nothing holds its cables there but a tool_grip_N that is given.
  bool free_tool_end = false;
  std::size_t elements_per_segment = 0;  ///< of loose cables; 0: as many as their waves ask for
  KnownEnds known_ends{};
  std::array<double, 2> relief_stiffness{};  ///< of bend reliefs at base and tool end, which bend with the hose [N m2]
};

class CablePaths {
 public:
  /// plan: of all layers, as they slide. lengths, arcs: of the span's segments [m].
  CablePaths(const Construction& construction, const std::vector<LayerSlip>& plan, const CablesInJob& job,
             std::vector<double> lengths, const std::vector<double>& arcs, std::size_t samples,
             const Scratch& scratch = {});

  /// Whether there is any cable that can slide.
  bool any() const { return !cables_.empty(); }
  bool any_loose() const { return loose_ != nullptr; }
  /// Whether what clamps and friction did stays in memory: strains are known after finish() only.
  bool remembers() const;

  /// Before the first sample: takes the loose cables of `other` as its own, if they rest at the same places.
  /// Friction along the hose, for one, does not move them. other: the same span of the same dresspack, with
  /// other factors.
  void share_loose(const CablePaths& other);
  bool shares_loose(const CablePaths& other) const { return loose_ && loose_ == other.loose_; }

  /// Whether there is a ring of loose cables: where it comes to rest depends on its start.
  bool any_ring() const { return loose_ && loose_->any_ring(); }
  /// Before the first sample: rings begin wound at random.
  void wind(std::uint64_t seed) { loose_->wind(seed); }
  /// Between samples of a rehearsal, before the first one of its own: loose cables go on from where those of the same span
  /// of the same dresspack with other factors are. Their own slack is fed in over the first `feeding` seconds.
  void go_on_from(const CablePaths& other);
  /// By how much loose cables lie apart from the same ones that began otherwise (LooseCables::apart()).
  double apart(const CablePaths& other) const { return loose_->apart(*other.loose_); }
  /// Where loose cables bend most: the sum over turning points of (change of curvature)^8, the largest of four directions,
  /// for each segment and cable. Precondition: all samples were added.
  void find_bent();
  /// Parts of the loose cables whose sums in a segment are not far below the largest of their component. Precondition:
  /// find_bent().
  std::vector<int> bent_most(std::size_t segment) const;

  /// Before the first sample: cables with friction record where they rub, see rubbing().
  void record_rubbing();
  void add(const SpanBlock& block);  ///< in order of time
  /// The same for several in one span, whose loose cables go side by side: each gets what it would get alone. All that
  /// share loose cables are among them.
  static void add(std::span<CablePaths* const> all, const SpanBlock& block);
  /// Samples before the first one: loose cables move with them, and come to lie as a repeat of the motion leaves them.
  static void rehearse(std::span<CablePaths* const> all, const SpanBlock& block);
  void finish();  ///< all samples are there; again: changes nothing

  // ---- after finish()
  // --------------------------------------------------------------------------------------

  /// One segment at `count` samples from `first` on. hose: its columns there. Loose cables have their mean curvature of the
  /// segment, or with at_wires that where its wires are evaluated. Good until the next call of this keeper.
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
  /// What makes its force, and where it meets the clamps.
  const pipeline::PulledCable& pulled(std::size_t cable) const { return cables_[cable].pulled; }
  /// Of the dresspack's components.
  int component(std::size_t cable) const;
  /// Both ways along, in a repeat of the motion, at base and tool clamp [m].
  std::array<double, 2> grip_slip(std::size_t cable) const { return cables_[cable].grip_slip; }
  /// Where its jacket rubs in one repeat; null: it was not recorded.
  const CableRubbing* rubbing(std::size_t cable) const { return cables_[cable].rubbing ? &*cables_[cable].rubbing : nullptr; }
  /// Radius of the helix into which it can wind [m]; 0: it is held.
  double room(std::size_t cable) const { return cables_[cable].room; }
  /// Of its path, where its wires are evaluated [1/m]; 0: it is held.
  double largest_curvature(std::size_t cable) const;
  /// Growth of its path over the motion, relative to its length as installed, without its slack: the least, if it
  /// goes as far outward in each bend as its room allows, and the most, if it goes inward. Cables of a ring move by
  /// the gap to their neighbours only. Twist counts by what it would take from the cable's length. A slack between
  /// the two is neither too long nor too short at any time.
  const std::array<double, 2>& path_gain(std::size_t cable) const { return cables_[cable].path_gain; }
  /// That the hose carries as it was simulated: the larger of both clamps (sample) [N m].
  const std::vector<double>& hose_moment() const { return hose_moment_; }
  /// Where loose cables lie at some samples: offset from their places (cable, segment, 2) [m].
  const std::vector<std::size_t>& offset_samples() const { return offset_samples_; }
  const std::vector<double>& offsets() const { return offsets_; }  ///< (sample, cable, segment, 2)
  /// Into which loose cables are cut in each segment; 0: none lies loose.
  std::size_t elements_per_segment() const { return loose_ ? (nodes_.size() - 1) / node_segments() : 0; }
  /// Share of the curvature of loose cables that the distance of their nodes leaves out; 0: none lies loose.
  double mesh_error() const { return loose_ ? loose_->mesh_error() : 0; }
  /// Samples at which a loose cable had not come to rest.
  std::size_t restless() const { return loose_ ? loose_->restless() : 0; }

 private:
  struct Cable {
    int part;
    bool loose, remembers, rubs, sticks;
    double axial_stiffness, slack, friction, line_load, base_grip, tool_grip;
    double radial_share;             ///< of its strain that the bed of its layer leaves (W31)
    double elastic;                  ///< share of the deviation from the mean that a jacket holds (W30)
    pipeline::PulledCable pulled{};  ///< at the clamps' ends
    std::array<double, 2> grip_slip{};
    double room = 0;                                              ///< see room()
    std::array<double, 2> path_gain{without_limit, -without_limit};  ///< see path_gain()
    std::vector<double> strain{};   ///< (sample) of all segments; before finish(): unslid
    std::vector<double> along{};    ///< (sample, segment) the same, each segment its own: with friction
    std::vector<float> pressing{};  ///< (sample, segment) curvature [1/m], or press of a loose one [N/m]
    std::optional<CableRubbing> rubbing{};
  };

  /// Loose cables lie in at least so many segments: a hose of fewer is cut as if it had them.
  std::size_t node_segments() const { return std::max<std::size_t>(lengths_.size(), 8); }
  /// Of `along` and `pressing`: all segments of a sample are written and slide together.
  std::size_t along_at(std::size_t segment, std::size_t sample) const {
    return sample * lengths_.size() + segment;
  }
  void add_hose(const SpanBlock& block);
  void add_held(const SpanBlock& block);
  static void add_loose(std::span<CablePaths* const> all, const SpanBlock& block);
  void find_nodes(const SpanBlock& block, std::size_t sample);
  void shorten_loose(std::size_t of_block);
  void feed_slack(double step);
  void see_gain(Cable& cable, std::size_t sample, double gain, double relief);
  void see_gains(const std::vector<HoseNode>& nodes, std::size_t of_block);
  void see_held_gains();
  std::size_t wires_at(std::size_t segment) const;
  void put_loose(std::size_t of_block);
  void put_loose(std::size_t cable, std::size_t state, std::size_t sample);
  void put_curvature(std::size_t of_block);
  void put_offsets(std::size_t sample);
  void add_stuck(Cable& cable, std::size_t segment, const double* twist, std::span<const double> path,
                 double rest);
  /// Of its strain, beside what its axis has, that makes force: what twist would take from its length if it
  /// could.
  double pulled_by_twist(const Cable& cable, double twist) const;
  void slide(Cable& cable);
  void record_slide(Cable& cable, const SlidingLine& line, std::span<const double> unslid, std::size_t sample) const;
  void ask_for_forces();

  const Construction& construction_;
  std::vector<double> lengths_;
  std::size_t stride_, all_, next_ = 0;
  bool finished_ = false;
  std::vector<Cable> cables_;
  std::vector<std::size_t> held_;  ///< of cables_, in the order of rates_
  std::optional<PathRates> rates_;
  std::vector<std::size_t> loosened_;  ///< of cables_, in the order of loose_
  std::shared_ptr<LooseCables> loose_;  ///< null: none lies loose
  KnownEnds known_ends_;
  std::array<double, 2> relief_stiffness_;
  /// (segment, base end, tool end; loose cable x 2; sample) of their paths [1/m], shared with them
  std::shared_ptr<SegmentRows> curvature_;
  double first_share_ = 1, fed_ = 0;  ///< of its slack, see go_on_from(), and since then [s]
  std::vector<HoseNode> nodes_;
  std::vector<double> hose_twist_;     ///< (sample) mean along it [rad/m]
  std::vector<float> hose_curvature_;  ///< (clamp, 2, sample) at the base and the tool end [1/m]
  std::vector<double> hose_moment_, offsets_;
  std::vector<std::size_t> offset_samples_;
  std::vector<double> bending_sums_;  ///< (segment, loose cable)
};

}  // namespace dresslife::strain
