#include "strain/loose/hose_line.h"

#include <cassert>
#include <cmath>

namespace dresslife::strain {

HoseLine::HoseLine(double of_length, std::size_t elements)
    : length(of_length),
      spacing(of_length / static_cast<double>(elements)),
      turn(elements + 1, Eigen::Vector2d::UnitX()),
      curvature(elements + 1, Eigen::Vector2d::Zero()),
      rest(curvature),
      pull(curvature),
      elongation(elements + 1, 0.0) {}

void HoseLine::take(std::span<const HoseNode> hose, double rest_curvature) {
  assert(hose.size() == nodes());
  double angle = 0;
  for (std::size_t i = 0; i < hose.size(); ++i) {
    const HoseNode& node = hose[i];
    if (i > 0) angle += spacing * (node.twist + hose[i - 1].twist) / 2;
    turn[i] = {std::cos(angle), std::sin(angle)};
    curvature[i] = turned({node.curvature2, -node.curvature1}, turn[i]);
    rest[i] = rest_curvature * turn[i];
    pull[i] = turned({node.pull[0], node.pull[1]}, turn[i]);
    elongation[i] = node.elongation;
  }
}

}  // namespace dresslife::strain
