#include "pipeline/cable/room.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/order.h"

namespace dresslife::pipeline {
namespace {

double away(const CableSpot& cable) { return std::hypot(cable.place[0], cable.place[1]); }

/// Range of distances from the axis in which a ring lies [m].
struct CableRing {
  double inside, outside;
};

/// Assigns cables to rings, innermost first.
std::vector<CableRing> rings_of(std::span<const CableSpot> cables, std::vector<CableRoom>& rooms) {
  std::vector<CableRing> rings;
  for (const std::size_t k :
       smallest_first(cables.size(), [&](std::size_t of) { return away(cables[of]) - cables[of].radius; })) {
    if (cables[k].own_play) continue;
    const double inside = away(cables[k]) - cables[k].radius, outside = away(cables[k]) + cables[k].radius;
    if (rings.empty() || inside >= rings.back().outside) rings.push_back({inside, outside});
    rings.back().outside = std::max(rings.back().outside, outside);
    rooms[k].ring = static_cast<int>(rings.size()) - 1;
  }
  return rings;
}

}  // namespace

std::vector<CableRoom> rooms_of(std::span<const CableSpot> cables, double bore, double core) {
  std::vector<CableRoom> rooms(cables.size(), {infinity, 0, infinity, no_ring});
  const std::vector<CableRing> rings = rings_of(cables, rooms);
  for (std::size_t k = 0; k < cables.size(); ++k) {
    CableRoom& room = rooms[k];
    if (room.ring == no_ring) continue;
    const auto number = static_cast<std::size_t>(room.ring);
    const double wall = number + 1 < rings.size() ? rings[number + 1].inside : bore;
    const double inside = number > 0 ? std::max(rings[number - 1].outside, core) : core;
    room.farthest = std::max(wall - cables[k].radius, away(cables[k]));
    room.nearest = inside > 0 ? std::min(inside + cables[k].radius, away(cables[k])) : 0;
    for (std::size_t other = 0; other < cables.size(); ++other)
      if (other != k && rooms[other].ring == room.ring) {
        const double apart =
            std::hypot(cables[k].place[0] - cables[other].place[0], cables[k].place[1] - cables[other].place[1]);
        room.gap = std::min(room.gap, std::max(0.0, (apart - cables[k].radius - cables[other].radius) / 2));
      }
  }
  for (CableRoom& room : rooms)  // a single cable of a ring touches no other cable
    if (room.gap == infinity) room.ring = no_ring;
  return rooms;
}

double winding_radius(const CableSpot& cable, const CableRoom& room) {
  return room.ring == no_ring ? room.farthest : away(cable);
}

}  // namespace dresslife::pipeline
