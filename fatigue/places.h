// The planner's life: when the first conductor of a dresspack has lost its share of wires in one segment (F26).
//
// If a conductor has lost a share of its wires in one segment, the remaining wires there carry its current. Breaks distributed
// over two metres leave it whole nearly everywhere. P_g is the probability that k of n wires are broken in segment g by the time
// t: (F15) with the damages there. A wire's z is the same in all its segments, so the failures of the segments are positively
// dependent: all come earlier if the wires are weak. Then (Harris 1960; Esary, Proschan and Walkup 1967)
//     max_g P_g  <=  P(some segment)  <=  min[1 - product over g of (1 - P_g),  P(k of n broken anywhere)].
// The result is the right side, which is safe. For a given common factor (F25) conductors are independent of each other.
#pragma once

#include <span>
#include <vector>

#include "fatigue/scatter.h"

namespace dresslife::fatigue {

/// Damage of the wires of one conductor in all segments.
struct PlacesOfConductor {
  std::vector<double> damage;  ///< (segment, wire) per repeat; 0 where the wire has no site
};

struct FirstPlace {
  Percentiles lives;  ///< [repeats]
  /// For each conductor that can fail, the segment where a share of its median wires breaks first. Ordered by life, shortest
  /// first.
  struct Soonest {
    std::size_t conductor, segment;
  };
  std::vector<Soonest> soonest;
  std::size_t judged = 0;  ///< number of evaluated places
};

/// Returns the life by which the first conductor has lost `failed_percent` of its wires in one segment. bundles (conductor): the
/// damage of its wires at their worst places, and with load sharing the rates. Then `draws` samples are used as in
/// shared_lives(), without bounds. The places and times that are left out have together a probability of failure of at most
/// 2 * `neglected`.
FirstPlace first_place_lives(std::span<const PlacesOfConductor> places, std::span<const ConductorWires> bundles,
                             std::size_t segments, double failed_percent, Scatter scatter, int draws);
constexpr double neglected = 1e-4;

/// Returns the repeats until each conductor has lost this share in one of its segments, (conductor), if every wire has its median
/// life and load is not shared; infinity if too few wires are damaged.
std::vector<double> median_place_lives(std::span<const PlacesOfConductor> places,
                                       std::span<const ConductorWires> bundles, std::size_t segments,
                                       double failed_percent);

}  // namespace dresslife::fatigue
