// What the test rigs of pipeline/job/rig.h do to a cable, one cycle each, as a prescribed deformation.
//
// (D3) torsion: twist 0, +phi, 0, -phi, 0 along the whole length. Held at both ends L apart: no elongation e,
//      unless the twist presses the wires with more than Euler's load E I (2 pi/L)^2 of a clamped rod. Then the
//      cable lengthens until they press with that load, and bows in a plane: y = (a/2) (1 - cos 2 pi x/L) is
//      longer than L by (pi a/L)^2/4 = e, so the curvature is (4 pi/L) sqrt(e) cos(2 pi x/L). With a
//      weight the elongation e is that at which the wires carry it, sum of E A strain(e, twist) x lay cosines
//      = g m: a cable whose layers have one hand shortens and lengthens as it is twisted, and its wires are
//      strained less (pipeline/cable/cable_pull.h).
// (D4) rolling_flex: one bend, pi R of cable long, begins at x = 0 and moves along the cable to travel/2 and
//      back: 0, kappa, 0 for cable over which it passes whole.
// (D5) two_pulley: two bends of opposite sense, each angle x R long and one behind the other, move by travel
//      and back.
// (D6) tick_tock: the cable lies on a mandrel from the grip on for R times the angle by which it is swung, on
//      the one side, then on the other: 0, +kappa, 0, -kappa, 0.
// (D7) swivel: where a cable of bending stiffness E I under the pull T leaves a clip by the angle phi, the
//      elastica of infinite length has the curvature 2 sqrt(T / E I) sin(phi/2), E I kappa^2/2 =
//      T (1 - cos phi); not more than that of the clip's edge. 0, +kappa, 0, -kappa, 0.
//      axial: elongation mean, mean + amplitude, mean, mean - amplitude, mean.
// (D8) Edges of bends are cosine ramps of four segments, so that the strain stage's cubic (W2) does not
//      overshoot.
//
// Bends are about d2, so a wire on the axis is strained on its outward fibre (W12). R is the radius of the
// cable's axis. Gravity and stiffness have no influence but in (D3) and (D7): rig and weight force the bend
// on the cable.
#pragma once

#include "sim/run/prescribed.h"

namespace dresslife::sim {

/// Errors: InputError where the rig cannot be followed with so many segments, or lacks what it needs of the
/// cable.
PrescribedDeformation rig_deformation(const pipeline::Rig& rig, const pipeline::Setup& setup);

/// Of the cable that moves, rolling_flex: shares that are bent and straightened again in every single stroke,
/// and in every second one; the rest stays bent.
struct FlexShares {
  double each_stroke = 0, each_cycle = 0;
};
FlexShares flex_shares(double radius, double travel);

}  // namespace dresslife::sim
