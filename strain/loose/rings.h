// Limits of cables that lie around the axis of a hose: its wall, its core, and each other.
//
// The distances are geometry (pipeline/cable/room.h). This reduced model is used on purpose; see (W35) in strain/theory.md.
#pragma once

#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

/// Parts of the hose that cables can touch.
struct HoseSection {
  double inner_radius = without_limit;  ///< of the wall [m]
  double core_radius = 0;               ///< of the parts in the middle that are no cables [m]
  double room = 1;                      ///< factor on the distances by which cables can leave their places
};

/// Sets `farthest`, `nearest`, `ring` and `gap` of cables at their places. If places overlap with each other, the wall or the
/// core, there is no room in this direction, and the cable can only leave in the other. A cable with a play of its own has only
/// this limit.
void fit_in_hose(std::vector<LooseCable>& cables, const HoseSection& section);

}  // namespace dresslife::strain
