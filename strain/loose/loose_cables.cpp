#include "strain/loose/loose_cables.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dresslife::strain {
namespace {

constexpr int feeding_rounds = 100;  // in which 1 % of slack in 2 m grows by 0.2 mm each
constexpr int most_rounds = 200;     // after that, until all lie still: 8 s at 25 Hz
constexpr double settled = 1e-7;   // change of strain in a round: 0.1 N of a cable of 1 MN

}  // namespace

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
  if (!started_) settle(step);
  restless_ += !relax(step);
}

/// From their places to rest at the first sample. What is too long for its place can lie in many ways; the one
/// that is found is where it comes to lie when its excess length is fed in bit by bit.
void LooseCables::settle(double step) {
  double before = without_limit;
  for (int round = 0; round < feeding_rounds + most_rounds; ++round) {
    const double share = std::min(1.0, static_cast<double>(round) / feeding_rounds);
    for (Ring& ring : rings_) ring.feed_in(share);
    for (CableLine& line : lines_) line.feed_in(share);
    relax(step);
    started_ = false;  // nothing goes on moving from one round to the next
    double sum = 0;
    for (const CableState& state : states_) sum += std::abs(state.strain);
    if (round > feeding_rounds && std::abs(sum - before) < settled * static_cast<double>(lines_.size())) break;
    before = sum;
  }
}

bool LooseCables::relax(double step) {
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
  started_ = true;
  return rest;
}

double LooseCables::mesh_error() const {
  double largest = 0;
  for (const CableLine& line : lines_)
    if (line.bent() > 0) largest = std::max(largest, std::sqrt(line.missed() / line.bent()));
  return largest;
}

}  // namespace dresslife::strain
