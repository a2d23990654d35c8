// The planner's life: when the first conductor of a dresspack has lost its share of wires at one place (F26).
//
// A conductor that has lost a share of its wires in one segment carries its current through the rest there;
// breaks anywhere along two metres leave it whole nearly everywhere. P_g, the probability that k of n wires
// are broken in segment g by the time t, is (F15) with the damages there. A wire's z is the same in all its
// segments, so the failures of the segments are positively dependent: all come sooner when the wires are
// weak. Then (Harris 1960; Esary, Proschan and Walkup 1967)
//     max_g P_g  <=  P(some segment)  <=  min[1 - product over g of (1 - P_g),  P(k of n broken anywhere)].
// The result is the right side, which is the safe one. Conductors are independent of each other once the
// common factor (F25) is given.
#pragma once

#include <span>
#include <vector>

#include "fatigue/scatter.h"

namespace dresslife::fatigue {

/// Wires of one conductor with their damage everywhere.
struct PlacesOfConductor {
  std::vector<double> damage;  ///< (segment, wire) per repeat; 0 where the wire has no site
};

struct FirstPlace {
  Percentiles lives;  ///< [repeats]
  /// Of each conductor that can fail, where a share of its median wires breaks soonest; the soonest first.
  struct Soonest {
    std::size_t conductor, segment;
  };
  std::vector<Soonest> soonest;
  std::size_t judged = 0;  ///< places that could matter
};

/// Life by which the first conductor has lost `failed_percent` of its wires in one segment. bundles
/// (conductor): their wires' worst places and, where broken wires leave their load to the rest, rates; then
/// by `draws` draws as shared_lives(), which need no bounds. What is left out, places and moments, adds up to
/// a probability of twice `neglected` at most before the first has failed for certain.
FirstPlace first_place_lives(std::span<const PlacesOfConductor> places,
                             std::span<const ConductorWires> bundles, std::size_t segments,
                             double failed_percent, Scatter scatter, int draws);
constexpr double neglected = 1e-4;

/// Repeats until each conductor has lost that share in one of its segments, (conductor), if every wire lives
/// its median and none takes over another's load; infinite without damage to so many.
std::vector<double> median_place_lives(std::span<const PlacesOfConductor> places,
                                       std::span<const ConductorWires> bundles, std::size_t segments,
                                       double failed_percent);

}  // namespace dresslife::fatigue
