// Pull of a straight cable while it is twisted: the stretch of nested helices (strain/theory.md, W5 and W6) for a parent without
// curvature, in which nothing depends on the angle:
//     V^2 = (R sigma)^2 + lambda^2,   sigma = tan(alpha)/R + twist,
//     stretch = cos(alpha) V,   twist of the part = sigma cos^2(alpha).
// A soft bed leaves a share of stretch - 1 (W31). Wires are elastic. They slide so that all of a layer have the same strain.
// Jacket and insulation carry no force.
#pragma once

#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Returns the elastic pull of all wires in these parts of a dresspack [N] at this elongation and twist [rad/m].
double pull_of_wires(const Dresspack& dresspack, const std::vector<Component>& parts, double elongation, double twist);

/// Returns the elongation at which the parts carry `pull` [N]. Precondition: there are wires.
double elongation_under(const Dresspack& dresspack, const std::vector<Component>& parts, double pull, double twist);

/// Shortening of a cable without pull per length, to second order in its twist. Layers of one hand cause the linear term, wires
/// off the axis the quadratic one.
struct TwistShortening {
  double linear = 0;                                                              ///< coefficient of the twist [m]
  double quadratic = 0;                                                           ///< coefficient of its square [m2]
  double at(double twist) const { return (linear + quadratic * twist) * twist; }  ///< twist in [rad/m]
};
/// Returns the shortening of a cable with parts; 0 if none of them is a wire of known material.
TwistShortening twist_shortening(const Dresspack& dresspack, const Component& cable);

/// Returns the shortening of a dresspack that is a cable (is_single_cable()); 0 for others, because a hose holds their length.
TwistShortening twist_shortening(const Dresspack& dresspack);

/// Returns E I of a dresspack [N m2]: the given value, otherwise the sum over its parts: cable_stiffness() of parts with parts, E
/// I of wires about their own axes, properties_of() of other parts.
double bending_stiffness(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
