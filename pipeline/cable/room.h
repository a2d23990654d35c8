// The room that a hose leaves to the cables in it: its wall, what fills its middle, and the cables themselves.
//
// Cables whose distances from the hose's axis overlap form a ring. Its neighbours keep their order: a ring can turn as
// a whole, and each cable in it can move along it by half of the gap to its nearest neighbour, so that no two
// ever overlap. Toward the axis a cable reaches the core or the next ring inside; away from the axis it reaches the
// wall or the next ring outside.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace dresslife::pipeline {

/// A cable as it lies in the cross-section.
struct CableSpot {
  std::array<double, 2> place{};  ///< of its axis, from the hose's [m]
  double radius = 0;              ///< [m]
  bool own_play = false;          ///< its play is given: it meets nothing else
};

inline constexpr int no_ring = -1;

/// How far a cable can go [m]. Infinite: nothing stops it.
struct CableRoom {
  double farthest, nearest;  ///< distances of its axis from the hose's
  double gap;                ///< along its ring either way
  int ring = no_ring;        ///< of cables that turn as one
};

/// (cable) Where places overlap with one another, the wall or the core, there is no room. bore, core: radii [m].
std::vector<CableRoom> rooms_of(std::span<const CableSpot> cables, double bore, double core);

/// Of the helix into which a cable can wind: around the hose's axis, with its whole ring or alone [m].
double winding_radius(const CableSpot& cable, const CableRoom& room);

}  // namespace dresslife::pipeline
