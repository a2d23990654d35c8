// Selects the wires of a layer that are scanned side by side (W28).
//
// The strain around a layer is w0 + w2 cos(theta) + w4 cos(2 theta), even in the wire's angle, plus w1 sin(theta)
// + w3 sin(2 theta), odd in it (W13). Wires j and K - j are at opposite angles, so the same products give both strains.
#pragma once

#include <vector>

namespace dresslife::strain {

struct LaneGroup {
  std::vector<int> wires;  ///< from 0, at most `lanes`
  bool mirrors = false;    ///< its wires are the images of the wires of the previous group, one by one
};

/// Returns groups that contain each of the K = `count` > 0 wires of a layer once, for registers of `at_once` wires. Wires and
/// their images are grouped together if this does not take more registers than single wires.
std::vector<LaneGroup> lane_groups(int count, int at_once);

}  // namespace dresslife::strain
