#include "strain/slip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dresslife::strain {

std::vector<LayerSlip> plan_slip(const Construction& construction, const std::vector<pipeline::Slip>& slip,
                                 double free_length) {
  assert(!slip.empty());
  const auto& layers = construction.layers();
  std::vector<LayerSlip> plan(layers.size());
  std::vector<int> helical_level(layers.size(),
                                 0);          // of the layer itself or its nearest helical ancestor; 0: none
  std::vector<double> length(layers.size());  // ideal length between the clamps [m]
  for (std::size_t k = 0; k < layers.size(); ++k) {  // parents come first
    const Layer& layer = layers[k];
    const bool outermost = layer.parent == dresspack_itself;
    const double parent_length = outermost ? free_length : length[layer.parent];
    const int inherited = outermost ? 0 : helical_level[layer.parent];
    length[k] = parent_length / std::cos(layer.lay_angle);
    const bool helical = layer.pitch() < parent_length;
    helical_level[k] = helical ? layer.level : inherited;
    const auto level = std::min<std::size_t>(layer.level, slip.size());
    if (slip[level - 1] == pipeline::Slip::stick) continue;
    if (helical)
      plan[k] = {Sliding::over_pitch, 0};
    else if (inherited > 0)
      plan[k] = {Sliding::along_ancestor, inherited};
    else
      plan[k] = {Sliding::clamp_to_clamp, 0};
  }
  return plan;
}

}  // namespace dresslife::strain
