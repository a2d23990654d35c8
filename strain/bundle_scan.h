// All wires of one bundle in one segment, run over the motion in blocks of samples that stay in cache: waves
// of strain (W13), or strains put together wire by wire (W18), and their turning points (W14).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "strain/clamp_means.h"
#include "strain/reversals.h"

namespace dresslife::strain {

/// The part of the job that the scan of a bundle needs.
struct ScanSettings {
  int fibre_count = 1;
  float gate = 0;
  bool with_shear = false;  ///< W19
  bool on_axis = false;     ///< fibres are the wires' axes
};

/// Shear (fibre null) or bending of the undeformed wire, as the ingredients hold them.
double rest_ingredient(const WireNode& node, const Fibre* fibre);
FibreShape shape_of(const Fibre& fibre, const WireNode& node);

/// Reused from bundle to bundle by one thread.
class BundleScan {
 public:
  BundleScan(const Construction& construction, const ScanSettings& settings)
      : construction_(construction), settings_(settings) {}

  /// nesting: with the nodes of the bundle's layers. mixed: strains are put together wire by wire.
  void run(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
           bool mixed, const DeformationColumns& columns, std::size_t samples);
  /// After run(): calls found(wire, fibre, points) for every site, wire by wire; wires count through the
  /// bundle.
  void for_each_site(const std::function<void(std::size_t, int, std::span<const TurningPoint>)>& found) const;

  /// The same without turning points.
  void rank(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
            bool mixed, const DeformationColumns& columns, std::size_t samples);
  /// After rank().
  void for_each_rank(const std::function<void(std::size_t, int, const StrainMeasures&)>& found) const;

 private:
  /// Up to sixteen wires of one layer.
  struct Group {
    std::size_t layer;  ///< in the bundle
    bool mirrors;       ///< wires at the opposite angles of those of the group before
    std::vector<double> angles;
    MixedLanes mixed;
    std::vector<LaneScan> scans;  ///< (fibre)
    std::size_t first_list;       ///< of (fibre, wire) lists
  };
  /// Where a wire of the bundle is scanned.
  struct Place {
    std::size_t group, lane;
  };

  void list_groups(const std::vector<int>& layers);
  void start(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
             bool mixed);
  MixedLanes mixed_lanes(const WireNode* nodes, const Fibre* fibres, const LayerSlip& slip,
                         const std::vector<double>& angles) const;
  std::span<TurningList> lists_of(const Group& group, int fibre);
  enum class Wanted { turns, ranks };
  void run_all(const Bundle& bundle, const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
               bool mixed, const DeformationColumns& columns, std::size_t samples, Wanted wanted);
  void run_blocks(const BundlePointers& nesting, bool mixed, Wanted wanted, const DeformationColumns& columns,
                  std::size_t samples);
  /// Sliders to where one repeat of the motion leaves them.
  void settle(const std::vector<LayerSlip>& plan, const BundlePointers& nesting,
              const DeformationColumns& columns, std::size_t samples);
  /// The next `count` samples of all groups, from the waves of the block.
  void scan_waves(std::size_t count, Wanted wanted);
  void scan_mixed(std::size_t count, Wanted wanted);
  LaneRun& add_run(Group& group, int fibre, std::size_t count, Wanted wanted);

  const Construction& construction_;
  ScanSettings settings_;
  std::vector<int> layers_;  ///< for whose wires the groups are
  std::vector<Group> groups_;
  std::vector<Place> place_;  ///< (wire)
  std::vector<TurningList> lists_;
  std::vector<float> waves_, strains_;
  std::vector<LaneRun> runs_;
};

}  // namespace dresslife::strain
