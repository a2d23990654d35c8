// Life of a cable whose wires are not described, from the cycles that its maker states in test rigs.
//
// A cycle of a bend (or twist) of range r does damage in proportion to r^m. The same sum over one cycle of the rig, for a
// place over which the whole bend passes, is what the maker's N cycles consist of:
//     damage per repeat = [sum over the motion's cycles of r^m] / [N x sum over the rig's cycle of r^m]       (F31)
// Ranges are rainflow ranges of the hose's curvature, in that of `directions` directions around the cable which has the largest
// sum, and of its twist. Damages of bending and of twist add up (Miner). Ratings of one kind: the longest life counts, since
// each is a lower bound. The rig's cycle in curvature 1/R or twist t:
//     rolling_flex  0, 1/R, 0 once, or in both strokes if the bend passes the cable in each;
//     two_pulley    -1/R, 1/R, with straight cable in between in both strokes if the carriage goes so far;
//     tick_tock     0, 1/R, 0, -1/R;      torsion  t, -t.
// m is known to a deviation (plain_part.h): its influence grows with the distance from the rated range.
//
// A rating is a promise, so this is a lower bound of a life: by then its maker has promised nothing more. Not contained: the
// cable's own path in the hose (curvature and twist are the hose's), pull, abrasion of its jacket.
#pragma once

#include <span>
#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::fatigue {

/// What one segment of the hose does in a repeat.
struct SegmentMotion {
  std::vector<double> curvature1, curvature2;  ///< (sample) about d1 and d2 [1/m]
  std::vector<double> twist;                   ///< (sample) [rad/m]
};

/// Where the promise for a cable ends first.
struct RatedLife {
  double repeats = 0;                  ///< infinite: no damage
  double log10_spread = 0;             ///< standard deviation of log10 of repeats, by the damage exponent
  std::size_t segment = 0;             ///< of those given
  std::size_t sample = 0;              ///< at which its most damaging cycle is bent or twisted most
  bool bends = false, twists = false;  ///< the cable has ratings of this kind
  double twist_share = 0;              ///< of the damage
};

/// (F31). Precondition: a cable without described wires with at least one rating, as check_dresspack() accepts it.
RatedLife rated_life(const pipeline::Component& cable, std::span<const SegmentMotion> segments);

}  // namespace dresslife::fatigue
