// Axial strain of parts that slide from clamp to clamp and are no cables: (path length now)/(path length at rest) - 1 over all
// segments ((W10) in strain/theory.md). It is computed in blocks of samples that contain every segment, and read per segment
// later.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "strain/long_waves.h"
#include "strain/path_rates.h"
#include "strain/segment_motion.h"

namespace dresslife::strain {

class ClampMeans {
 public:
  /// lengths, arcs: rest length and centre of each segment [m]. samples: number in the whole history.
  ClampMeans(const Construction& construction, std::vector<LayerSlip> plan, std::vector<double> lengths,
             std::vector<double> arcs, std::size_t samples);

  /// A part that slides in another sliding part needs the strain of that part. So it is added one round later.
  int rounds() const { return rounds_; }
  /// Adds the next samples of one segment. In each round call it for each segment, then end_round(); after all rounds
  /// next_block(). motion: of these samples.
  void add(int round, std::size_t segment, const SegmentMotion& motion);
  void end_round(int round);
  void next_block() { next_ += in_block_; }
  void repeat() { next_ = 0; }  ///< the next block is the first one again

  const std::vector<LayerSlip>& plan() const { return plan_; }
  /// Limits the length over which friction gathers (shortened()). Returns the longest evening length of the plan.
  ShortenedPlan shorten(double bend_wave);
  /// Returns these means with `factor` times the friction. glued: nothing slips, not even where compression removes the pressure
  /// and any finite friction with it. Precondition: all samples were added.
  static constexpr double glued = std::numeric_limits<double>::infinity();
  ClampMeans rubbing(double factor) const;
  /// The layers slide over their pitch without friction, and have the strain of `lines` in addition (W45).
  void set_lines(const std::vector<int>& layers, std::shared_ptr<const LongWaves> lines);
  const std::shared_ptr<const LongWaves>& lines() const { return lines_; }  ///< null: none
  bool needed() const { return !groups_.empty(); }

  /// Returns the strain of a part (sample); null if it does not slide from clamp to clamp.
  const double* of_part(int part) const;
  /// Returns the strain (sample) of node `node` of the waves_per_layer nodes of wire layer `layer` in `part`.
  const double* of_node(int part, int layer, int node) const;
  /// Returns the strain (sample) at any angle around the layer, from its nodes. turn: counted from wire 1 [rad].
  std::vector<double> at_angle(int part, int layer, double turn) const;

  /// Gives each sliding step of `nesting` its strains from sample `first` on. motion: at these samples, for cables.
  void attach(BundleNesting& nesting, int part, const SegmentMotion& motion, std::size_t first = 0) const;

 private:
  struct Group {  ///< the sliding parts of one parent
    int parent, round;
    PathRates rates;
    std::vector<std::size_t> rows;  ///< (member) index into strain_
    std::vector<double> path{};     ///< (member, sample) sum over the segments of the present block [m]
    std::vector<double> rest{};     ///< (member) [m]
  };

  void list_group(int parent);
  std::size_t add_row();

  const Construction& construction_;
  std::vector<LayerSlip> plan_;
  std::vector<double> lengths_, arcs_;
  std::size_t stride_, next_ = 0, in_block_ = 0;
  int rounds_ = 1;
  std::vector<Group> groups_;
  std::map<int, std::size_t> part_row_;
  std::map<std::pair<int, int>, std::size_t> layer_row_;  ///< (part, layer) -> first of waves_per_layer rows
  std::vector<std::vector<double>> strain_;
  std::shared_ptr<const LongWaves> lines_;
};

}  // namespace dresslife::strain
