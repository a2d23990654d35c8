// Parts of one layer that would need more room than their circle has, and parts of two layers that would lie
// in each other.
//
// Neighbours lie on helices of one radius R and lay angle alpha, turned against each other by delta = 2 pi/K.
// Seen from a point of one, the other is nearest not in the cross-section but a little along,
//     d^2 = min over phi of 2 R^2 (1 - cos(delta + phi)) + (R phi / tan(alpha))^2,
// phi the angle by which it goes on; straight parts are 2 R sin(delta/2) apart.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Between the axes of neighbours in a layer of `count` > 1 parts [m].
double neighbour_distance(double helix_radius, double lay_angle, int count);

/// Smallest distance between the axes of parts of two components of one parent [m]. With equal tan(alpha)/R it is
/// that in the cross-section. Otherwise it is the difference of their radii, because they meet within a metre.
double nearest_distance(const Component& one, const Component& other);

/// Whether the parts of a component overlap by more than overlap_warnings() allows.
bool overlaps(const Component& component);
/// The same for the parts of two components of one parent.
bool overlap_each_other(const Component& one, const Component& other);

/// A warning for each component, and for each pair of components of one parent, whose parts overlap by more than 2 % of
/// their diameter (the error of a caliper, and the tolerance of a fit into the parent): which parts, by how much, and
/// what would fit. Also for parts outside a bore that is an ESTIMATE (room_of_parts()). Errors: InputError for parts
/// nearer than half of their diameter; for two components only if they have the same tan(alpha)/R, as cables at one
/// angle. Insulation is soft, but such parts would share over a third of their sections.
std::vector<Warning> overlap_warnings(const Dresspack& dresspack);

/// The errors alone, in a hundredth of the time: what would fit is not computed.
void refuse_gross_overlap(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
