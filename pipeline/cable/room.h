// Room for the cables in a hose, limited by its wall, its core and the cables themselves.
//
// Cables whose ranges of distance from the hose's axis overlap form a ring. The cables of a ring keep their order: a ring can
// turn as a whole, and each cable in it can move along it by half of the gap to its nearest neighbour, so that two cables never
// overlap. Toward the axis, a cable reaches the core or the next inner ring; away from the axis, it reaches the wall or the next
// outer ring.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace dresslife::pipeline {

/// Position of a cable in the cross-section.
struct CableSpot {
  std::array<double, 2> place{};  ///< of its axis, relative to the hose's axis [m]
  double radius = 0;              ///< [m]
  bool own_play = false;          ///< its play is given, so it touches no other body
};

inline constexpr int no_ring = -1;

/// Limits of a cable's motion [m]. Infinite: no limit.
struct CableRoom {
  double farthest, nearest;  ///< distances of its axis from the hose's axis
  double gap;                ///< along its ring in either direction
  int ring = no_ring;        ///< number of the ring; cables of one ring turn together
};

/// Returns the rooms, (cable). Cables that overlap with each other, the wall or the core have no room. bore, core: radii [m].
std::vector<CableRoom> rooms_of(std::span<const CableSpot> cables, double bore, double core);

/// Returns the radius of the helix into which a cable can wind [m]: around the hose's axis with its whole ring, or alone.
double winding_radius(const CableSpot& cable, const CableRoom& room);

}  // namespace dresslife::pipeline
