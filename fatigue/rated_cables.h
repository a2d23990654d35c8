// Life of a hose, or of a cable whose wires are not described, from the numbers of cycles that its maker states for test rigs.
//
// A cycle of bending (or twist) with the range r does damage in proportion to r^m. For a place over which the whole bend passes,
// the maker's N cycles contain N times this sum over one cycle of the rig:
//     damage per repeat = [sum over the motion's cycles of r^m] / [N x sum over the rig's cycle of r^m]       (F31)
// Ranges are rainflow ranges of the hose's curvature and of its twist. For curvature the worst of `directions` directions around
// the cable is used. Damages of bending and of twist add up (Miner). Of several ratings of one kind the longest life counts,
// because each is a lower bound. The rig's cycle in curvature 1/R or twist t:
//     rolling_flex  0, 1/R, 0 once, or in both strokes if the bend passes the cable in each;
//     two_pulley    -1/R, 1/R, with straight cable between them in both strokes if the carriage moves far enough;
//     tick_tock     0, 1/R, 0, -1/R;      torsion  t, -t.
// m is uncertain (plain_part.h): its influence grows with the distance from the rated range.
//
// A rating is a lower bound, so this is a lower bound of the life: the maker promises no more. Not contained: the
// cable's own path in the hose (curvature and twist are those of the hose), pull, abrasion of its jacket.
#pragma once

#include <span>
#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::fatigue {

/// Deformation of one segment of the hose in a repeat.
struct SegmentMotion {
  std::vector<double> curvature1, curvature2;  ///< (sample) about d1 and d2 [1/m]
  std::vector<double> twist;                   ///< (sample) [rad/m]
};

/// The place at which the rating of a cable is used up first.
struct RatedLife {
  double repeats = 0;                  ///< infinite: no damage
  double log10_spread = 0;             ///< standard deviation of log10 of repeats, from the damage exponent
  std::size_t segment = 0;             ///< index among the given segments
  std::size_t sample = 0;              ///< sample of the larger extreme of its most damaging cycle
  bool bends = false, twists = false;  ///< the cable has ratings of this kind
  double twist_share = 0;              ///< share of the damage from twist
  /// Largest range of a cycle over that of the test with the largest one, in bending and in twist; 0: not rated.
  double bend_times = 0, twist_times = 0;
};

/// Returns the result of (F31). Precondition: a hose or a cable without described wires, with at least one rating, valid by
/// check_dresspack().
RatedLife rated_life(const pipeline::Component& cable, std::span<const SegmentMotion> segments);

}  // namespace dresslife::fatigue
