#include "strain/loose/rings.h"

#include <algorithm>
#include <cmath>

#include "pipeline/cable/room.h"

namespace dresslife::strain {

void fit_in_hose(std::vector<LooseCable>& cables, const HoseSection& section) {
  std::vector<pipeline::CableSpot> spots;
  for (const LooseCable& cable : cables) spots.push_back({cable.place, cable.radius, cable.play < without_limit});
  const std::vector<pipeline::CableRoom> rooms = pipeline::rooms_of(spots, section.inner_radius, section.core_radius);
  for (std::size_t k = 0; k < cables.size(); ++k) {
    LooseCable& cable = cables[k];
    if (spots[k].own_play) {
      cable.play *= section.room;
      continue;
    }
    const pipeline::CableRoom& room = rooms[k];
    const double at = std::hypot(cable.place[0], cable.place[1]);
    cable.ring = room.ring;
    cable.gap = room.gap;
    cable.farthest = room.farthest;
    cable.nearest = room.nearest;
    if (section.room == 1) continue;  // leaves the values bitwise equal
    cable.gap *= section.room;
    cable.farthest = at + section.room * (room.farthest - at);
    cable.nearest = std::max(0.0, at - section.room * (at - room.nearest));
  }
}

}  // namespace dresslife::strain
