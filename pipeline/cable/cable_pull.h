// How a straight cable carries a pull while it is twisted: the stretch of nested helices (strain/README.md,
// W5 and W6) for a parent without curvature, where nothing depends on the angle:
//     V^2 = (R sigma)^2 + lambda^2,   sigma = tan(alpha)/R + twist,
//     stretch = cos(alpha) V,   twist of the part = sigma cos^2(alpha).
// A soft bed leaves a share of stretch - 1 (W31). Wires are elastic and slide where they must, so that all are
// strained alike; jacket and insulation carry nothing.
#pragma once

#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Pull of all wires in these parts of a dresspack at this elongation and twist [rad/m], elastic [N].
double pull_of_wires(const Dresspack& dresspack, const std::vector<Component>& parts, double elongation,
                     double twist);

/// Elongation at which they carry `pull` [N]. Precondition: there are wires.
double elongation_under(const Dresspack& dresspack, const std::vector<Component>& parts, double pull,
                        double twist);

/// By how much a cable shortens as it is twisted while nothing pulls at it: layers of one hand do, and wires
/// off the axis in second order. To that order, per length.
struct TwistShortening {
  double linear = 0;                                                              ///< [m], per twist
  double quadratic = 0;                                                           ///< [m2], per its square
  double at(double twist) const { return (linear + quadratic * twist) * twist; }  ///< [rad/m]
};
/// Of a cable that holds parts; nothing where none of them is a wire of known material.
TwistShortening twist_shortening(const Dresspack& dresspack, const Component& cable);

/// E I of all wires when each bends by itself, and of the polymer that the cables name; the dresspack's own
/// or that measured of its only cable where there is one [N m2].
double bending_stiffness(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
