// A smooth curve of the right length between two clamps: where the search for the equilibrium begins.
#pragma once

#include "sim/rod/rod.h"

namespace dresslife::sim {

struct StartCurve {
  RodState state;  ///< segments along the curve, at rest, frames parallel-transported, then evenly twisted
  double roll_to_tool = 0;  ///< that twist: from the transported frame to the tool frame, in (-pi, pi] [rad]
};

/// A cubic between the clamps along their directions, with as much speed there as its length allows; length
/// still missing goes into a sag (with gravity, where it has a part across the chord). When even the straight
/// line is longer than the hose, the segments are spaced evenly along it.
/// most_speed: in lengths; more makes a rounder arch and less sag. halvings: of what the speed or the sag may
/// be, until it fits the length: 60 are exact, so many take most of the time.
StartCurve start_curve(const Rod& rod, const ClampFrames& clamps, double most_speed = 1, int halvings = 60);

}  // namespace dresslife::sim
