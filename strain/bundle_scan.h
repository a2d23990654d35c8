// Strains of all wires of one bundle in one segment, in blocks of samples that stay in cache, and their turning points (W14).
// Strains are evaluated from the waves of a layer (W13) or composed wire by wire (W18).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "strain/clamp_means.h"
#include "strain/long_waves.h"
#include "strain/reversals.h"

namespace dresslife::strain {

/// Settings of the job for the scan of a bundle.
struct ScanSettings {
  int fibre_count = 1;
  float gate = 0;
  bool with_shear = false;  ///< W19
  bool on_axis = false;     ///< evaluates the axes of the wires
};

/// Returns bending of the undeformed wire at the fibre, or for fibre == null its shear, in the form of the ingredients.
double rest_ingredient(const WireNode& node, const Fibre* fibre);
FibreShape shape_of(const Fibre& fibre, const WireNode& node);

/// One thread uses this object for one bundle after the other.
class BundleScan {
 public:
  BundleScan(const Construction& construction, const ScanSettings& settings)
      : construction_(construction), settings_(settings) {}

  /// Scans a bundle. nesting: contains the nodes of the bundle's layers. mixed: strains are composed wire by wire.
  void run(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting, bool mixed,
           const DeformationColumns& columns, std::size_t samples, const std::vector<LineWave>& lines);
  /// Calls found(wire, fibre, points) for every site, wire by wire. Wires are numbered through the bundle. Precondition: run().
  void for_each_site(const std::function<void(std::size_t, int, std::span<const TurningPoint>)>& found) const;

  /// Scans a bundle for its strain measures without listing turning points.
  void rank(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting, bool mixed,
            const DeformationColumns& columns, std::size_t samples, const std::vector<LineWave>& lines);
  /// Calls found(wire, fibre, measures) for every site. Precondition: rank().
  void for_each_rank(const std::function<void(std::size_t, int, const StrainMeasures&)>& found) const;

 private:
  /// Up to sixteen wires of one layer.
  struct Group {
    std::size_t layer;  ///< index in the bundle
    bool mirrors;       ///< its wires are at the opposite angles of the wires of the previous group
    std::vector<double> angles;
    MixedLanes mixed;
    std::vector<LaneScan> scans;  ///< (fibre)
    std::size_t first_list;       ///< index of its first list; its lists are (fibre, wire)
  };
  /// Group and lane in which a wire of the bundle is scanned.
  struct Place {
    std::size_t group, lane;
  };

  void list_groups(const std::vector<int>& layers);
  void start(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting, bool mixed);
  MixedLanes mixed_lanes(const WireNode* nodes, const Fibre* fibres, const LayerSlip& slip,
                         const std::vector<double>& angles) const;
  std::span<TurningList> lists_of(const Group& group, int fibre);
  enum class Wanted { turns, ranks };
  void run_all(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting, bool mixed,
               const DeformationColumns& columns, std::size_t samples, Wanted wanted);
  void run_blocks(const BundlePointers& nesting, bool mixed, Wanted wanted, const DeformationColumns& columns,
                  std::size_t samples);
  /// Puts the sliders into the state in which one repeat of the motion leaves them.
  void settle(const std::vector<LayerSlip>& plan, const BundlePointers& nesting, const DeformationColumns& columns,
              std::size_t samples);
  /// Adds the strain of wires in long waves to `count` samples of the block, which begins at sample `first`.
  void add_lines(bool mixed, std::size_t first, std::size_t count);
  /// Scans the next `count` samples of all groups, from the waves of the block.
  void scan_waves(std::size_t count, Wanted wanted);
  void scan_mixed(std::size_t count, Wanted wanted);
  /// here: the wires of one layer, and their images if it has any. waves: of the ingredients of the layer.
  void scan_mixed_groups(std::span<Group> here, const float* waves, std::size_t count, Wanted wanted);
  LaneRun& add_run(Group& group, int fibre, std::size_t count, Wanted wanted);

  const Construction& construction_;
  ScanSettings settings_;
  std::vector<int> layers_;  ///< wire layers of the groups
  std::vector<Group> groups_;
  std::vector<Place> place_;  ///< (wire)
  std::vector<TurningList> lists_;
  std::vector<float> waves_, strains_;
  std::vector<LaneRun> runs_;
  const std::vector<LineWave>* lines_ = nullptr;  ///< (layer) of the present bundle; empty: none
};

}  // namespace dresslife::strain
