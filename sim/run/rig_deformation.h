// One cycle of a cable in the test rigs of pipeline/job/rig.h, as a prescribed deformation.
//
// (D3) torsion: twist 0, +phi, 0, -phi, 0 along the whole length. Held at both ends at the distance L: no elongation e,
//      unless the twist compresses the wires with more than Euler's load E I (2 pi/L)^2 of a clamped rod. Then the
//      cable lengthens until the compression equals this load, and bows in a plane: y = (a/2) (1 - cos 2 pi x/L) is
//      longer than L by (pi a/L)^2/4 = e, so the curvature is (4 pi/L) sqrt(e) cos(2 pi x/L). With a
//      weight the elongation e is that at which the wires carry the weight, sum of E A strain(e, twist) x lay cosines
//      = g m: a cable with layers of one hand shortens and lengthens when it is twisted, and the strain of its wires is
//      smaller (pipeline/cable/cable_pull.h).
// (D4) rolling_flex: one bend over a cable length of pi R begins at x = 0 and moves along the cable to travel/2 and
//      back: 0, kappa, 0 for cable over which it passes completely.
// (D5) two_pulley: two bends of opposite direction, each of length angle x R and one behind the other, move by travel
//      and back.
// (D6) tick_tock: the cable lies on a mandrel from the grip over a length of R times the swing angle, on
//      one side, then on the other: 0, +kappa, 0, -kappa, 0.
// (D7) swivel: a cable of bending stiffness E I under the tension T leaves a clip at the angle phi. The
//      elastica of infinite length has the curvature 2 sqrt(T / E I) sin(phi/2), E I kappa^2/2 =
//      T (1 - cos phi), at most that of the clip's edge. 0, +kappa, 0, -kappa, 0.
//      axial: elongation mean, mean + amplitude, mean, mean - amplitude, mean.
// (D8) Edges of bends are cosine ramps over four segments, so that the strain stage's cubic (W2) does not
//      overshoot.
//
// Bends are about d2, so the strain of a wire on the axis is that of its outward fibre (W12). R is the radius of the
// cable's axis. Gravity and stiffness have an influence only in (D3) and (D7): otherwise rig and weight prescribe the bend
// of the cable.
#pragma once

#include "sim/run/prescribed.h"

namespace dresslife::sim {

/// Returns the deformation. Errors: InputError if the rig cannot be represented with so many segments, or if it needs a property
/// that the cable does not have.
PrescribedDeformation rig_deformation(const pipeline::Rig& rig, const pipeline::Setup& setup);

/// Shares of the moving cable of rolling_flex: bent and straightened in every stroke,
/// and in every second stroke; the remainder stays bent.
struct FlexShares {
  double each_stroke = 0, each_cycle = 0;
};
FlexShares flex_shares(double radius, double travel);

}  // namespace dresslife::sim
