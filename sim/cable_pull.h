// How a straight cable carries a pull while it is twisted: the stretch of nested helices (strain/README.md, W5 and W6)
// for a parent without curvature, where nothing depends on the angle:
//   V^2 = (R sigma)^2 + lambda^2, sigma = tan(alpha)/R + twist, stretch cos(alpha) V, twist of the part sigma cos^2(alpha).
// Wires are elastic and slide where they must to be strained alike; jacket and insulation carry nothing.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::sim {

/// Pull of all wires of a dresspack at this elongation and twist [rad/m], elastic [N].
double pull_of_wires(const pipeline::Dresspack& dresspack, double elongation, double twist);

/// Elongation at which they carry `pull` [N]. Precondition: it has wires.
double elongation_under(const pipeline::Dresspack& dresspack, double pull, double twist);

/// E I of all wires when each bends by itself, and of the polymer that the cables name; the dresspack's own or that
/// measured of its only cable where there is one [N m2].
double bending_stiffness(const pipeline::Dresspack& dresspack);

}  // namespace dresslife::sim
