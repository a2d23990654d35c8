// Hoses for tests: the nodes of one sample.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "pipeline/base/constants.h"
#include "strain/loose/loose_cables.h"

namespace dresslife::strain::test {

/// Returns elements + 1 nodes. make: node at a share of the length from the base clamp.
inline std::vector<HoseNode> hose(std::size_t elements, const std::function<HoseNode(double)>& make) {
  std::vector<HoseNode> nodes;
  for (std::size_t i = 0; i <= elements; ++i)
    nodes.push_back(make(static_cast<double>(i) / static_cast<double>(elements)));
  return nodes;
}

/// Returns the signal cable of the thesis' dresspack at this place in the hose's cross-section [m].
inline LooseCable signal_cable(double place1, double place2 = 0) {
  LooseCable cable;
  cable.place = {place1, place2};
  cable.radius = 5.3e-3;
  cable.axial_stiffness = 1e6;
  cable.bending_stiffness = 0.2;
  cable.mass_per_length = 0.19;
  return cable;
}

/// Returns a node of a hose on a robot's arm, an arch that leans over and twists. z: share of the length; turn: of the cycle.
inline HoseNode arm(double z, double turn) {
  const double w = 2 * pi * turn;
  return {(1.5 + 0.5 * std::sin(w)) * std::sin(pi * z),
          0.8 * std::cos(w) * std::cos(2 * pi * z),
          1.2 * std::sin(w),
          1e-4 * std::cos(w),
          {9.81 * std::sin(pi * z), -9.81 * std::cos(pi * z)}};
}

}  // namespace dresslife::strain::test
