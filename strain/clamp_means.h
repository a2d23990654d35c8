// The axial strain of what slides from clamp to clamp and is no cable: (path length now)/(path length at
// rest) - 1 over all segments (README W10). Built sample by sample in blocks that hold every segment, read
// per segment afterwards.
#pragma once

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "strain/path_rates.h"
#include "strain/segment_motion.h"

namespace dresslife::strain {

class ClampMeans {
 public:
  /// lengths, arcs: rest length and centre of each segment [m]. samples: of the whole history.
  ClampMeans(const Construction& construction, std::vector<LayerSlip> plan, std::vector<double> lengths,
             std::vector<double> arcs, std::size_t samples);

  /// The next samples: of one segment after the other, then next_block(). motion: of these samples.
  void add(std::size_t segment, const SegmentMotion& motion);
  void next_block();

  const std::vector<LayerSlip>& plan() const { return plan_; }
  /// Friction gathers over no more than this length (shortened()); returns the longest length of the plan.
  ShortenedPlan shorten(double bend_wave);
  /// The same with so many times the friction. glued: nothing slips, not even where compression takes the pressure
  /// away, on which any finite friction acts. Precondition: all samples have been added.
  static constexpr double glued = std::numeric_limits<double>::infinity();
  ClampMeans rubbing(double factor) const;
  bool needed() const { return !groups_.empty(); }

  /// (sample) strain of a part; null when it does not slide from clamp to clamp.
  const double* of_part(int part) const;
  /// (sample) strain of node `node` of the waves_per_layer nodes around wire layer `layer` in `part`.
  const double* of_node(int part, int layer, int node) const;
  /// (sample) strain at any angle around the layer, from its nodes; `turn` counts from wire 1.
  std::vector<double> at_angle(int part, int layer, double turn) const;

  /// Gives each sliding step of `nesting` its strains, from sample `first` on; motion: there, for cables.
  void attach(BundleNesting& nesting, int part, const SegmentMotion& motion, std::size_t first = 0) const;

 private:
  struct Group {  ///< what slides in one parent
    int parent;
    PathRates rates;
    std::vector<std::size_t> rows;  ///< of strain_, one per member
    std::vector<double> path{};     ///< (member, sample) of the block so far [m]
    std::vector<double> rest{};     ///< (member) [m]
  };

  void list_group(int parent);
  std::size_t add_row();

  const Construction& construction_;
  std::vector<LayerSlip> plan_;
  std::vector<double> lengths_, arcs_;
  std::size_t stride_, next_ = 0, in_block_ = 0;
  std::vector<Group> groups_;  ///< parents before children
  std::map<int, std::size_t> part_row_;
  std::map<std::pair<int, int>, std::size_t> layer_row_;  ///< (part, layer) -> first of waves_per_layer rows
  std::vector<std::vector<double>> strain_;
};

}  // namespace dresslife::strain
