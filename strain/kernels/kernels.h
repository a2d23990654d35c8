// The two hot loops, compiled once per instruction set: from the deformation of a segment to the strains of the wires of a
// bundle, and from waves of strain to turning points. The set is chosen when the program starts; a machine always chooses the
// same one.
//
// This header contains only plain data and pointers, so that no shared inline function is compiled for the wrong machine.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/base/instruction_set.h"
#include "pipeline/cable/helix.h"
#include "strain/kernels/sizes.h"
#include "strain/sliding.h"
#include "strain/sliding_layer.h"

namespace dresslife::strain {

// List of the turning points of one history.

struct TurningPoint {
  float strain;
  std::uint32_t sample;
};

/// A growing array of turning points. A kernel writes into it without asking for room for each point.
class TurningList {
 public:
  std::span<const TurningPoint> points() const { return {points_.get(), size_}; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  /// Returns the address of the next point, with room for `more` points. Call set_end() after writing.
  TurningPoint* room(std::size_t more) {
    if (size_ + more > capacity_) grow(size_ + more);
    return points_.get() + size_;
  }
  void set_end(const TurningPoint* end) { size_ = static_cast<std::size_t>(end - points_.get()); }

  void add(float strain, std::uint32_t sample) {
    *room(1) = {strain, sample};
    ++size_;
  }

 private:
  void grow(std::size_t least) {
    capacity_ = std::max(least, 2 * capacity_);
    std::unique_ptr<TurningPoint[]> wider(new TurningPoint[capacity_]);
    std::copy_n(points_.get(), size_, wider.get());
    points_ = std::move(wider);
  }

  std::unique_ptr<TurningPoint[]> points_;
  std::size_t size_ = 0, capacity_ = 0;
};

/// Number of points that scan() may write beyond a wire's last turning point and later overwrites.
constexpr std::size_t spare_points = 4;

// ---- strains of a bundle ----------------------------------------------------------------------------------

/// The deformation of one segment over time: pointers to (sample) values.
struct DeformationColumns {
  const double *curvature1, *curvature2, *twist, *elongation;
};

/// How one component slides, and the data for it.
struct SlidingNumbers {
  Sliding sliding = Sliding::glued;
  int helical_level = 0;                 ///< of along_ancestor
  double mean_rest_rate = 1;             ///< mean path rate at rest, over the phase or the ancestor's pitch
  double radial_share = 1;               ///< share of its strain that remains with the bed of its layer (W31)
  const double* clamp_strain = nullptr;  ///< (sample) strain, for clamp_to_clamp
  FrictionCap cap;                       ///< with friction
  /// Part of the deviation that friction holds, (power, sample) with `held_stride`; null: none.
  const double* held = nullptr;
  std::array<const double*, phases_per_pitch> turned_held{};  ///< `held` of the turned parts
  std::size_t held_stride = 0;
};

/// One level of the nesting from the dresspack to the bundle's part.
struct NestingLevel {
  Placement place;
  ComponentState<double> rest;  ///< the part in the undeformed construction
  SlidingNumbers slide;
  /// Place and rest state of the part, moved by sixths of the pitch: its own, or else that of its nearest helical ancestor.
  std::array<Placement, phases_per_pitch> turned;
  std::array<ComponentState<double>, phases_per_pitch> turned_rest;
};

/// One position around a wire layer.
struct WireNode {
  Placement place;
  double rest_rate = 1;             ///< path rate at rest
  double inverse_rest_stretch = 1;  ///< 1 / stretch at rest
  WireState<double> rest;
  SlidingNumbers slide;
  double wire_radius = 0;    ///< radius of its fibres [m]; 0 for the hose's wall, which bends with the dresspack only
  double shear_radius = 0;   ///< radius at which torsion causes shear [m]
  double strain_factor = 1;  ///< of a corrugated wall
};

struct Fibre {
  double phi_sine = 0, phi_cosine = 0;
  bool on_axis = false;
};

/// A bundle in one segment.
struct BundleNesting {
  std::vector<NestingLevel> steps;
  std::vector<WireNode> nodes;        ///< for waves: waves_per_layer nodes per layer, evenly spaced
  std::vector<SlidingLayer> sliding;  ///< (layer); empty: all waves come from nodes
  std::vector<Fibre> fibres;
  int order = 0;                             ///< order of the part's state: 1 if fibres depend on bend1
  ComponentState<double> dresspack_at_rest;  ///< (W25) in the shape as delivered
};

struct BundlePointers {
  const NestingLevel* steps;
  const WireNode* nodes;
  const Fibre* fibres;
  int step_count, node_count, fibre_count, order;
  /// States of the parent of the nesting's last part, from part_states(); null: the nesting is followed from the dresspack.
  const double* parent = nullptr;
  const float* parent_rows = nullptr;  ///< the parent in single precision, (PartRow, sample)
  std::size_t parent_stride = 0;
  double rest_curvature = 0;              ///< of the undeformed dresspack, about d2 [1/m]
  const SlidingLayer* sliding = nullptr;  ///< (layer), or null
  bool with_shear = true;                 ///< ingredient_waves() writes the waves of shear
};

/// Rows of a part in single precision that its contents need, (sample) each: its state, its change against the construction at
/// rest, and its slopes along the part.
enum PartRow {
  part_stretch,
  part_bend1,
  part_bend2,
  part_twist,
  stretch_change,
  bend1_change,
  bend2_change,
  twist_change,
  stretch_slope,
  bend1_slope,
  bend2_slope,
  twist_slope,
  part_rows
};

inline namespace DRESSLIFE_MACHINE {

/// Returns whether waves in a part need its parent in single precision only. last: the step to the part. nodes: in the part.
/// order: of the part's own series.
inline bool single_suffices(const NestingLevel& last, const WireNode* nodes, int node_count, int order) {
  bool suffice = order == 0 && !is_thesis(last.place.kinematics) && last.slide.sliding != Sliding::along_ancestor;
  for (int n = 0; n < node_count; ++n) suffice &= nodes[n].slide.sliding != Sliding::along_ancestor;
  return suffice;
}

/// Returns whether the slopes of the part can also be computed in single precision: its strain does not change along it.
inline bool slopes_in_single(const NestingLevel& last) {
  return last.slide.held == nullptr && (last.slide.sliding != Sliding::glued || last.slide.radial_share == 1);
}

}  // namespace DRESSLIFE_MACHINE

/// Rows of a part's state: stretch, bend1, bend2, twist, each with its powers 0 .. order.
constexpr std::size_t part_state_rows(int order) { return 4 * (static_cast<std::size_t>(order) + 1); }

// ---- turning points ---------------------------------------------------------------------------------------

/// State of sixteen wires between two blocks of samples. Spare lanes repeat the first wire; their results are not written.
struct LaneState {
  alignas(64) float shape[waves_per_layer - 1][lanes];  ///< sin, cos, sin 2, cos 2 of each wire's angle
  alignas(64) float edge[lanes];                        ///< edge of the hysteresis (turning.h)
  alignas(64) float top_edge[lanes];                    ///< edge started on a peak, used while wires are undecided
  alignas(64) float extreme[lanes];                     ///< furthest strain since the last turn
  alignas(64) float top[lanes];                         ///< highest strain of a wire that has not yet moved by the gate
  alignas(64) float last[lanes];
  alignas(64) std::int32_t extreme_at[lanes];
  alignas(64) std::int32_t top_at[lanes];
  alignas(64) std::int32_t rises[lanes];  ///< -1: `extreme` may become a peak, 0: a valley
  unsigned decided = 0;                   ///< bits: wires that have moved by the gate
  int used = 0;                           ///< number of wires
  float below_gate = 0;     ///< largest number below the gate: a turn is kept if strain moves away by more
  std::int32_t sample = 0;  ///< number of the next sample
};

/// Measures by which the wires of a bound are ranked, from the strains at turning points.
struct StrainMeasures {
  float lowest, highest;
  /// Approximates the damage of Smith, Watson and Topper: sum of (range times tensile peak)^3 between neighbours. The power lies
  /// between those of short (1.4) and long (4.5) lives of the thesis' copper.
  float cycle_sum;
  /// Approximates the damage with relaxed mean stress or a yielding metal: sum of range^3. The power lies between those of
  /// short (1.7) and long (8.9) lives.
  float range_sum;
};

/// State of sixteen wires that are ranked without keeping their turning points.
struct LaneRanks {
  alignas(64) float direction[lanes];  ///< +1 rising, -1 falling
  alignas(64) float turn[lanes];       ///< the last turning point
  alignas(64) float extreme[lanes];    ///< furthest strain since the last turning point, times the direction
  alignas(64) float low[lanes];
  alignas(64) float high[lanes];
  alignas(64) float cycle_sum_to_turn[lanes];  ///< up to the last turning point
  alignas(64) float range_sum_to_turn[lanes];
  alignas(64) float cycle_sum[lanes];  ///< up to the last sample
  alignas(64) float range_sum[lanes];
};

/// Up to sixteen wires and their next samples: waves, or strain[t * lanes + lane].
struct LaneRun {
  LaneState* state;
  /// Wave w of a block at waves[w * block_samples + t]: strain_j = w0 + w1 sin(theta_j) + w2 cos(theta_j) +
  /// w3 sin(2 theta_j) + w4 cos(2 theta_j). (W13)
  const float* waves;
  const float* strain;
  LaneRanks* ranks;    ///< for rank()
  TurningPoint** end;  ///< (wire) address of its next turning point; is advanced. Room: count + spare_points.
  /// Its wires are at the opposite angles of the wires of the previous run, lane by lane, with the same waves. It has at most as
  /// many wires as the previous run.
  bool mirrors = false;
};

// ---- the set for this machine -----------------------------------------------------------------------------

/// Components of a wire's strain before friction, in this order: the mean along its path, the deviation of the glued strain
/// from the mean, the shear strain gamma/sqrt(3) at its surface from torsion, and the bending strain of each fibre. The last
/// two include those of the undeformed wire, are computed as glued, and count per length of the undeformed axis. The strain of
/// a fibre counts per length of the fibre (W12).
enum Ingredient { mean_strain, deviation, shear, first_bending };
constexpr int ingredients(int fibres) { return first_bending + fibres; }

/// State of sixteen wires whose strain is composed wire by wire (W17, W18), between two blocks of samples.
struct MixedLanes {
  alignas(64) float shape[waves_per_layer - 1][lanes];
  alignas(64) float slip[lanes];        ///< slip of each wire against its parent [strain]
  alignas(64) float least_slip[lanes];  ///< bounds of the slip at the end of the motion, for any slip at the first of
  alignas(64) float most_slip[lanes];   ///< the samples that settle() has processed
  std::vector<std::array<float, lanes>> rest;         ///< of shear and of the fibres' bending, (1 + fibres)
  std::vector<std::array<float, lanes>> fibre_scale;  ///< FibreShape::scale, (fibres)
  float cap = 0, cap_per_mean = 0;                    ///< cap infinite: glued, 0: free
  float elastic = 0;               ///< share of the deviation that is held independently of the cap (W30)
  float inverse_radial_share = 1;  ///< (W31)
  bool scales = true;              ///< curvature and torsion per path length are constant (W11)
  bool with_shear = false, on_axis = false;
  int used = lanes;  ///< number of wires; mix() leaves out packs without wires
};

/// Wires for settle(), and the waves of their layer.
struct MixedRun {
  MixedLanes* state;
  const float* waves;
};

struct Kernels {
  const char* machine;
  int wires_at_once;  ///< wires in one register
  /// Computes strains of every node and fibre at samples [first, first + count), to out[(node * fibres + fibre) *
  /// stride + t].
  void (*node_strains)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                       double* out, std::size_t stride);
  /// Computes strains of nodes with one fibre in single precision, to out[node * stride + t].
  void (*node_strains_in_single)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                                 float* out, std::size_t stride);
  /// Computes the waves of every wire layer and fibre, to out[((layer * fibres + fibre) * waves_per_layer + wave) *
  /// stride + t].
  void (*layer_waves)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                      float* out, std::size_t stride);
  /// Computes mean strain (row 0) and deviation of the last part of a nesting, glued to its parent, as a series in its length
  /// (rows 1 ..), to out[row * stride + t]. turn >= 0: for the part moved by that many sixths of the pitch of the ancestor at
  /// `turned_level`; turned_level 0: of its own pitch.
  void (*deviations)(const BundlePointers&, int turn, int turned_level, const DeformationColumns&, std::size_t first,
                     std::size_t count, double* out, std::size_t stride);
  /// Computes states of the last part of a nesting, to out[row * stride + t], see part_state_rows(), and to
  /// rows[PartRow * stride + t] (null: not written). Order 0: without slopes.
  void (*part_states)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                      double* out, float* rows, std::size_t stride);
  /// Computes the rows of PartRow of the only part of a nesting, completely in single precision. Precondition: exact kinematics,
  /// no strain held by friction.
  void (*part_rows_of_dresspack)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                                 float* rows, std::size_t stride);
  /// Computes the ingredients of every node, to out[(node * ingredients + ingredient) * stride + t].
  void (*node_ingredients)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                           double* out, std::size_t stride);
  /// Computes waves of the ingredients of every layer, to out[((layer * ingredients + ingredient) * waves_per_layer +
  /// wave) * stride + t].
  void (*ingredient_waves)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                           float* out, std::size_t stride);
  /// Computes waves of mean strain and deviation only, to out[(layer * 2 + ingredient) * waves_per_layer * stride +
  /// wave * stride + t].
  void (*deviation_waves)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                          float* out, std::size_t stride);
  /// Composes the strains of sixteen wires, fibre by fibre, to out[(fibre * count + t) * lanes + lane]. waves: of the ingredients
  /// of one layer. images: wires at the opposite angles, whose strains go to images_out; null: none.
  void (*mix)(MixedLanes&, MixedLanes* images, const float* waves, std::size_t stride, std::size_t count, int fibres,
              float* out, float* images_out);
  /// Narrows least_slip .. most_slip by these samples. Call with blocks from the end of the motion backward. waves: mean strain
  /// and deviation of the wires' layer.
  void (*settle)(const MixedRun*, std::size_t runs, std::size_t stride, std::size_t count);
  /// Adds path rates of the nodes, for means along the dresspack: sum[node * stride + t] += weight * rate.
  void (*add_path_rates)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                         double weight, double* sum, std::size_t stride);
  /// Scans the next `count` samples of several runs, from their waves.
  void (*scan)(const LaneRun*, std::size_t runs, std::size_t count);
  /// Scans the next `count` samples of several runs, from their strains.
  void (*scan_strains)(const LaneRun*, std::size_t runs, std::size_t count);
  /// Rank the wires of several runs by the next `count` samples, from their waves or strains.
  void (*rank)(const LaneRun*, std::size_t runs, std::size_t count);
  void (*rank_strains)(const LaneRun*, std::size_t runs, std::size_t count);
  /// Returns the measures of one history. Precondition: count > 0.
  StrainMeasures (*measures)(const float* strain, std::size_t count);
};
// Each function pads count to a multiple of `padding`. Columns and outputs must have room for it.

/// Returns the widest set that this machine can run, or the set named by the environment variable DRESSLIFE_KERNELS.
const Kernels& kernels();
/// Precondition: this machine can run the set.
const Kernels& kernels_for(pipeline::InstructionSet instructions);

inline BundlePointers pointers(const BundleNesting& nesting) {
  return {nesting.steps.data(),
          nesting.nodes.data(),
          nesting.fibres.data(),
          static_cast<int>(nesting.steps.size()),
          static_cast<int>(nesting.nodes.size()),
          static_cast<int>(nesting.fibres.size()),
          nesting.order,
          nullptr,
          nullptr,
          0,
          nesting.dresspack_at_rest.bend2.at[0],
          nesting.sliding.empty() ? nullptr : nesting.sliding.data()};
}

}  // namespace dresslife::strain
