// The two hot loops, compiled once per instruction set: from the deformation of a segment to the strains of
// the wires of a bundle, and from waves of strain to turning points. Which set runs is chosen when the
// program starts; one machine always chooses the same.
//
// Everything here is plain data and pointers, so that no shared inline function can be compiled for the wrong
// machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/base/instruction_set.h"
#include "pipeline/cable/helix.h"
#include "strain/kernels/sizes.h"
#include "strain/kernels/turning_list.h"
#include "strain/sliding.h"
#include "strain/sliding_layer.h"

namespace dresslife::strain {

/// What scan() writes beyond a wire's last turning point, and then writes over.
constexpr std::size_t spare_points = 4;

// ---- strains of a bundle ----------------------------------------------------------------------------------

/// The deformation of one segment over time: pointers to (sample) values.
struct DeformationColumns {
  const double *curvature1, *curvature2, *twist, *elongation;
};

/// How one component slides, and what it needs for it.
struct SlidingNumbers {
  Sliding sliding = Sliding::glued;
  int helical_level = 0;                 ///< of along_ancestor
  double mean_rest_rate = 1;             ///< mean path rate at rest, over the phase or the ancestor's pitch
  double radial_share = 1;               ///< of its strain that the bed of its layer leaves (W31)
  const double* clamp_strain = nullptr;  ///< (sample) of clamp_to_clamp
  FrictionCap cap;                       ///< with friction
  /// What friction holds of a part's deviation, (power, sample) with `held_stride`; null: nothing.
  const double* held = nullptr;
  std::array<const double*, phases_per_pitch> turned_held{};  ///< of the turned parts
  std::size_t held_stride = 0;
};

/// One level of the nesting from the dresspack to the bundle's part.
struct NestingLevel {
  Placement place;
  ComponentState<double> rest;  ///< the part in the undeformed construction
  SlidingNumbers slide;
  /// The same with the part, or else its nearest helical ancestor, moved on by sixths of its pitch.
  std::array<Placement, phases_per_pitch> turned;
  std::array<ComponentState<double>, phases_per_pitch> turned_rest;
};

/// One place around a wire layer.
struct WireNode {
  Placement place;
  double rest_rate = 1;             ///< path rate at rest
  double inverse_rest_stretch = 1;  ///< 1 / stretch at rest
  WireState<double> rest;
  SlidingNumbers slide;
  double wire_radius = 0;   ///< of its fibres [m]; 0 for the hose's wall, which bends with the dresspack only
  double shear_radius = 0;  ///< at which torsion shears it [m]
  double strain_factor = 1;  ///< of a corrugated wall
};

struct Fibre {
  double phi_sine = 0, phi_cosine = 0;
  bool on_axis = false;
};

/// A bundle in one segment.
struct BundleNesting {
  std::vector<NestingLevel> steps;
  std::vector<WireNode> nodes;        ///< for waves: waves_per_layer nodes a layer, evenly spaced
  std::vector<SlidingLayer> sliding;  ///< of each layer; empty: all waves are those of the nodes
  std::vector<Fibre> fibres;
  int order = 0;                  ///< of the part's state: 1 when fibres feel bend1
  ComponentState<double> dresspack_at_rest;  ///< (W25) in the shape in which it was delivered
};

struct BundlePointers {
  const NestingLevel* steps;
  const WireNode* nodes;
  const Fibre* fibres;
  int step_count, node_count, fibre_count, order;
  /// States of the part in which the last part of the nesting lies, from part_states(); null: the nesting is
  /// followed from the dresspack.
  const double* parent = nullptr;
  const float* parent_rows = nullptr;  ///< the same, (PartRow, sample)
  std::size_t parent_stride = 0;
  double rest_curvature = 0;              ///< of the undeformed dresspack, about d2 [1/m]
  const SlidingLayer* sliding = nullptr;  ///< (layer), or null
  bool with_shear = true;                 ///< ingredient_waves() fills the waves of shear
};

/// What goes on inside a part needs of it, in single precision, one row of samples each: its state, that
/// against the construction at rest, and its slopes along itself.
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

/// Whether waves in a part need its parent in single precision only. nodes: in the part, which `last` leads
/// to. order: of the part's own series.
inline bool single_suffices(const NestingLevel& last, const WireNode* nodes, int node_count, int order) {
  bool suffice =
      order == 0 && !is_thesis(last.place.kinematics) && last.slide.sliding != Sliding::along_ancestor;
  for (int n = 0; n < node_count; ++n) suffice &= nodes[n].slide.sliding != Sliding::along_ancestor;
  return suffice;
}

/// Whether its own slopes follow in single precision, too: its strain does not change along it.
inline bool slopes_in_single(const NestingLevel& last) {
  return last.slide.held == nullptr && (last.slide.sliding != Sliding::glued || last.slide.radial_share == 1);
}

}  // namespace DRESSLIFE_MACHINE

/// Rows of a part's state: stretch, bend1, bend2, twist, each with its powers 0 .. order.
constexpr std::size_t part_state_rows(int order) { return 4 * (static_cast<std::size_t>(order) + 1); }

// ---- turning points ---------------------------------------------------------------------------------------

/// Sixteen wires between two blocks of samples. Spare lanes repeat the first wire and write nothing.
struct LaneState {
  alignas(64) float shape[waves_per_layer - 1][lanes];  ///< sin, cos, sin 2, cos 2 of each wire's angle
  alignas(64) float edge[lanes];                        ///< of the hysteresis (turning.h)
  alignas(64) float top_edge[lanes];  ///< the same, started from a peak, while wires are undecided
  alignas(64) float extreme[lanes];   ///< furthest strain since the last turn
  alignas(64) float top[lanes];       ///< highest strain of a wire that has not moved by the gate yet
  alignas(64) float last[lanes];
  alignas(64) std::int32_t extreme_at[lanes];
  alignas(64) std::int32_t top_at[lanes];
  alignas(64) std::int32_t rises[lanes];  ///< -1: `extreme` is a peak in the making, 0: a valley
  unsigned decided = 0;                   ///< wires that have moved by the gate
  int used = 0;                           ///< wires
  float below_gate = 0;     ///< largest number below the gate: a turn is kept when strain moves away by more
  std::int32_t sample = 0;  ///< of the next strain
};

/// What ranks the wires of a bound, of the strains at turning points.
struct StrainMeasures {
  float lowest, highest;
  /// Something like the damage of Smith, Watson and Topper: sum of (range times tensile peak)^3 between
  /// neighbours, a power between those of short (1.4) and long (4.5) lives of the thesis' copper.
  float cycle_sum;
  /// The same where the mean stress has relaxed or the metal yields: sum of range^3, between the powers of
  /// short (1.7) and long (8.9) lives.
  float range_sum;
};

/// The same of sixteen wires that are ranked without keeping their turning points.
struct LaneRanks {
  alignas(64) float direction[lanes];  ///< +1 rising, -1 falling
  alignas(64) float turn[lanes];       ///< the last turning point
  alignas(64) float extreme[lanes];    ///< furthest strain since then, times the direction
  alignas(64) float low[lanes];
  alignas(64) float high[lanes];
  alignas(64) float cycle_sum_to_turn[lanes];  ///< up to the last turning point
  alignas(64) float range_sum_to_turn[lanes];
  alignas(64) float cycle_sum[lanes];  ///< up to the last sample
  alignas(64) float range_sum[lanes];
};

/// Up to sixteen wires and what they go through next: waves, or strain[t * lanes + lane].
struct LaneRun {
  LaneState* state;
  /// Wave w of a block at waves[w * block_samples + t]: strain_j = w0 + w1 sin(theta_j) + w2 cos(theta_j) +
  /// w3 sin(2 theta_j) + w4 cos(2 theta_j). (W13)
  const float* waves;
  const float* strain;
  LaneRanks* ranks;    ///< for rank()
  TurningPoint** end;  ///< (wire) where its next turning point goes; moves on. Room: count + spare_points.
  /// Its wires lie at the opposite angles of those of the run before, lane by lane, in the same waves; not
  /// more of them than there.
  bool mirrors = false;
};

// ---- the set for this machine -----------------------------------------------------------------------------

/// What a wire's strain is made of before friction, one after the other: the mean along its path, the glued
/// strain's deviation from it, the shear strain gamma/sqrt(3) of its torsion at its surface, and the bending
/// strain of each fibre. The last two hold what the undeformed wire has too, as glued, and count per length
/// of the undeformed axis; the strain of a fibre counts per length of its own (W12).
enum Ingredient { mean_strain, deviation, shear, first_bending };
constexpr int ingredients(int fibres) { return first_bending + fibres; }

/// Sixteen wires whose strain is put together wire by wire (W17, W18), between two blocks of samples.
struct MixedLanes {
  alignas(64) float shape[waves_per_layer - 1][lanes];
  alignas(64) float slip[lanes];        ///< how far each wire has slid against its parent [strain]
  alignas(64) float least_slip[lanes];  ///< between these it is at the end of the motion, wherever it was at
  alignas(64) float most_slip[lanes];   ///< the first of the samples that settle() has seen
  std::vector<std::array<float, lanes>> rest;         ///< of shear and of the fibres' bending, (1 + fibres)
  std::vector<std::array<float, lanes>> fibre_scale;  ///< FibreShape::scale, (fibres)
  float cap = 0, cap_per_mean = 0;                    ///< cap infinite: glued, 0: free
  float elastic = 0;               ///< share of the deviation that is held whatever the cap (W30)
  float inverse_radial_share = 1;  ///< (W31)
  bool scales = true;              ///< curvature and torsion per path length stay (W11)
  bool with_shear = false, on_axis = false;
};

/// Such wires and the waves that they go through.
struct MixedRun {
  MixedLanes* state;
  const float* waves;
};

struct Kernels {
  const char* machine;
  int wires_at_once;  ///< in one register
  /// Strains of every node and fibre at samples [first, first + count), to out[(node * fibres + fibre) *
  /// stride + t].
  void (*node_strains)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                       double* out, std::size_t stride);
  /// The same in single precision, of nodes with one fibre, to out[node * stride + t].
  void (*node_strains_in_single)(const BundlePointers&, const DeformationColumns&, std::size_t first,
                                 std::size_t count, float* out, std::size_t stride);
  /// The waves of every wire layer and fibre, to out[((layer * fibres + fibre) * waves_per_layer + wave) *
  /// stride + t].
  void (*layer_waves)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                      float* out, std::size_t stride);
  /// Mean strain (row 0) and deviation of the last part of a nesting as a series in its length (rows 1 ..),
  /// glued to its parent, to out[row * stride + t]. turn >= 0: of the part moved on by that many sixths of
  /// the pitch of the ancestor at `turned_level`, its own where that is 0.
  void (*deviations)(const BundlePointers&, int turn, int turned_level, const DeformationColumns&,
                     std::size_t first, std::size_t count, double* out, std::size_t stride);
  /// States of the last part of a nesting, to out[row * stride + t], see part_state_rows(), and to
  /// rows[PartRow * stride + t] (null: not), without slopes where the order is 0.
  void (*part_states)(const BundlePointers&, const DeformationColumns&, std::size_t first, std::size_t count,
                      double* out, float* rows, std::size_t stride);
  /// The same rows of the only part of a nesting, in single precision all the way: exact kinematics, nothing
  /// held by friction.
  void (*part_rows_of_dresspack)(const BundlePointers&, const DeformationColumns&, std::size_t first,
                                 std::size_t count, float* rows, std::size_t stride);
  /// Ingredients of every node, to out[(node * ingredients + ingredient) * stride + t].
  void (*node_ingredients)(const BundlePointers&, const DeformationColumns&, std::size_t first,
                           std::size_t count, double* out, std::size_t stride);
  /// Waves of the ingredients of every layer, to out[((layer * ingredients + ingredient) * waves_per_layer +
  /// wave) * stride + t].
  void (*ingredient_waves)(const BundlePointers&, const DeformationColumns&, std::size_t first,
                           std::size_t count, float* out, std::size_t stride);
  /// Those of mean strain and deviation alone, to out[(layer * 2 + ingredient) * waves_per_layer * stride +
  /// wave * stride + t].
  void (*deviation_waves)(const BundlePointers&, const DeformationColumns&, std::size_t first,
                          std::size_t count, float* out, std::size_t stride);
  /// Puts the strains of sixteen wires together, fibre by fibre, to out[(fibre * count + t) * lanes + lane].
  /// waves: of one layer's ingredients. images: wires at the opposite angles, whose strains go to images_out; null: none.
  void (*mix)(MixedLanes&, MixedLanes* images, const float* waves, std::size_t stride, std::size_t count,
              int fibres, float* out, float* images_out);
  /// From the last samples of the motion to the first: narrows least_slip .. most_slip by these samples. waves: of
  /// their layer's mean strain and deviation.
  void (*settle)(const MixedRun*, std::size_t runs, std::size_t stride, std::size_t count);
  /// Path rates of the nodes, for means along the dresspack: sum[node * stride + t] += weight * rate.
  void (*add_path_rates)(const BundlePointers&, const DeformationColumns&, std::size_t first,
                         std::size_t count, double weight, double* sum, std::size_t stride);
  /// The next `count` samples of several runs, from their waves.
  void (*scan)(const LaneRun*, std::size_t runs, std::size_t count);
  /// The same from their strains.
  void (*scan_strains)(const LaneRun*, std::size_t runs, std::size_t count);
  /// The same runs, ranked.
  void (*rank)(const LaneRun*, std::size_t runs, std::size_t count);
  void (*rank_strains)(const LaneRun*, std::size_t runs, std::size_t count);
  /// Precondition: count > 0.
  StrainMeasures (*measures)(const float* strain, std::size_t count);
};
// count is padded by the callee to a multiple of `padding`: columns and outputs have room for it.

/// The widest this machine can run, or the one that the environment variable DRESSLIFE_KERNELS names.
const Kernels& kernels();
/// Precondition: this machine can run them.
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
