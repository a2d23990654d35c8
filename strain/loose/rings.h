// What stops cables that lie around the axis of a hose: its wall, its core, and each other.
//
// How far each can go is geometry (pipeline/cable/room.h).
//
// It is a reduced model on purpose: see README W35 for what contact between all discs gives instead.
#pragma once

#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

/// The parts of the hose that cables can touch.
struct HoseSection {
  double inner_radius = without_limit;  ///< of the wall [m]
  double core_radius = 0;               ///< of what fills the middle and is no cable [m]
  double room = 1;                      ///< share of how far cables could leave their places that they have
};

/// Fills in `farthest`, `nearest`, `ring` and `gap` of cables at their places. Where places overlap with one
/// another, the wall or the core, there is no room, and the cable can only leave the other way. A cable with
/// a play of its own keeps to that alone.
void fit_in_hose(std::vector<LooseCable>& cables, const HoseSection& section);

}  // namespace dresslife::strain
