#include "strain/loose/rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dresslife::strain {
namespace {

double away(const LooseCable& cable) { return std::hypot(cable.place[0], cable.place[1]); }

/// Distances from the axis between which a ring lies [m].
struct Ring {
  double inside, outside;
};

}  // namespace

void fit_in_hose(std::vector<LooseCable>& cables, const HoseSection& section) {
  std::vector<std::size_t> order(cables.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return away(cables[a]) - cables[a].radius < away(cables[b]) - cables[b].radius;
  });
  std::vector<Ring> rings;
  for (const std::size_t k : order) {
    LooseCable& cable = cables[k];
    if (cable.play < without_limit) continue;
    const double inside = away(cable) - cable.radius, outside = away(cable) + cable.radius;
    if (rings.empty() || inside >= rings.back().outside) rings.push_back({inside, outside});
    rings.back().outside = std::max(rings.back().outside, outside);
    cable.ring = static_cast<int>(rings.size()) - 1;
  }
  for (LooseCable& cable : cables) {
    if (cable.ring == no_ring) continue;
    const auto number = static_cast<std::size_t>(cable.ring);
    const double wall = number + 1 < rings.size() ? rings[number + 1].inside : section.inner_radius;
    const double core =
        number > 0 ? std::max(rings[number - 1].outside, section.core_radius) : section.core_radius;
    cable.farthest = std::max(wall - cable.radius, away(cable));
    cable.nearest = core > 0 ? std::min(core + cable.radius, away(cable)) : 0;
    cable.gap = without_limit;
    for (const LooseCable& other : cables)
      if (&other != &cable && other.ring == cable.ring) {
        const double apart = std::hypot(cable.place[0] - other.place[0], cable.place[1] - other.place[1]);
        cable.gap = std::min(cable.gap, std::max(0.0, (apart - cable.radius - other.radius) / 2));
      }
  }
  for (LooseCable& cable : cables)  // alone in its ring it meets nobody
    if (cable.gap == without_limit) cable.ring = no_ring;
  if (section.room == 1) return;
  for (LooseCable& cable : cables) {
    const double at = away(cable);
    cable.play *= section.room;
    cable.gap *= section.room;
    cable.farthest = at + section.room * (cable.farthest - at);
    cable.nearest = std::max(0.0, at - section.room * (at - cable.nearest));
  }
}

}  // namespace dresslife::strain
