// Which wires of a layer are scanned side by side (W28).
//
// Strain around a layer is w0 + w2 cos(theta) + w4 cos(2 theta), even in the wire's angle, plus w1 sin(theta)
// + w3 sin(2 theta), odd in it (W13). Wires j and K - j stand at opposite angles, so both come out of the
// same products.
#pragma once

#include <vector>

namespace dresslife::strain {

struct LaneGroup {
  std::vector<int> wires;  ///< from 0, at most `lanes`
  bool mirrors = false;    ///< wire by wire the images of the group before
};

/// The K = `count` > 0 wires of a layer, each once, for registers of `at_once` wires. Wires and their images
/// are kept together where that takes no more registers than wires one by one.
std::vector<LaneGroup> lane_groups(int count, int at_once);

}  // namespace dresslife::strain
