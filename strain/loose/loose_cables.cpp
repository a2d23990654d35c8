#include "strain/loose/loose_cables.h"

#include <algorithm>
#include <cassert>

namespace dresslife::strain {

LooseCables::LooseCables(const std::vector<LooseCable>& cables, const LooseSettings& settings)
    : settings_(settings), hose_(settings.length, settings.elements), states_(cables.size()) {
  assert(settings.elements >= 4 && settings.length > 0);
  for (const LooseCable& cable : cables) {
    lines_.emplace_back(cable, hose_, settings.rest_curvature);
    ring_of_.push_back(cable.ring);
    if (cable.ring == no_ring) continue;
    while (rings_.size() <= static_cast<std::size_t>(cable.ring))
      rings_.emplace_back(hose_, settings.rest_curvature);
    rings_[cable.ring].add(cable, hose_);
  }
}

void LooseCables::advance(std::span<const HoseNode> hose, double step) {
  hose_.take(hose, settings_.rest_curvature);
  const int most = started_ ? CableLine::most_iterations : CableLine::most_iterations_at_start;
  bool rest = true;
  for (Ring& ring : rings_)
    if (ring.cables() > 0) rest &= ring.advance(hose_, step, started_);
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto& frame = ring_of_[k] == no_ring ? hose_.turn : rings_[ring_of_[k]].frame();
    lines_[k].begin(hose_, frame, step, started_);
    const int took = lines_[k].relax(hose_, most);
    lines_[k].end(hose_, frame, started_ ? step : 0, states_[k]);
    iterations_ += static_cast<std::size_t>(took);
    rest &= took < most;
  }
  restless_ += !rest;
  started_ = true;
}

}  // namespace dresslife::strain
