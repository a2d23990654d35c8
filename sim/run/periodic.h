// Whether a repeated motion has become periodic: the dresspack begins two successive repeats in the same
// state.
//
// (R8) A hose that rests by friction, or sways, may begin the second repeat elsewhere than the first. The
// program is repeated, without a break, until two successive repeats begin alike; the last of them is what is
// evaluated. The distance of two states is the largest value over the segments of
//     |x - x'| + (d/2) |log(q^-1 q')| + tau |v - v'|,
// how far a point of the hose's surface has moved, and how far a sway of period 2 pi tau will move it.
// tau = 0.1 s: slower sways differ less in speed than in place. A retraction unit counts with the difference
// of its travel in the same way.
#pragma once

#include "sim/rod/rod.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {

/// Largest distance (R8) over the segments and retraction units [m]. Precondition: both states are of this
/// rod.
double state_distance(const Rod& rod, const RodState& a, const RodState& b);

/// Whether the path ends where it begins, so that it can be repeated: joints within 1e-6 rad, or, where there
/// are none, clamps within 1e-6 m and rad.
bool returns(const ClampPath& path);

}  // namespace dresslife::sim
