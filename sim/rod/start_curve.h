// A smooth curve of the right length between two clamps: first guess of the search for the equilibrium.
#pragma once

#include "sim/rod/rod.h"

namespace dresslife::sim {

struct StartCurve {
  RodState state;  ///< segments along the curve, at rest; frames are transported without twist, then evenly twisted
  double roll_to_tool = 0;  ///< this twist: from the transported frame to the tool frame, in (-pi, pi] [rad]
};

/// Returns a cubic between the clamps along their directions. Its speed is as large as its length allows; the rest of the length
/// becomes a sag, in the direction of gravity across the chord if there is one. If even the straight line is longer than the
/// hose, the segments are spaced evenly along it.
/// most_speed: in lengths; a larger one gives a rounder arch and less sag. halvings: of the range of speed or sag, until the
/// length fits; 60 are exact, and cost most of the time.
StartCurve start_curve(const Rod& rod, const ClampFrames& clamps, double most_speed = 1, int halvings = 60);

}  // namespace dresslife::sim
