// Detects parts of one layer that need more space than their circle has, and parts of two layers that overlap.
//
// Neighbours lie on helices of one radius R and lay angle alpha, rotated against each other by delta = 2 pi/K. The point of the
// neighbour that is nearest to a point is not in the same cross-section, but further along,
//     d^2 = min over phi of 2 R^2 (1 - cos(delta + phi)) + (R phi / tan(alpha))^2,
// where phi is the angle along the neighbour. The distance of straight parts is 2 R sin(delta/2).
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Returns the distance between the axes of neighbours in a layer of `count` > 1 parts [m].
double neighbour_distance(double helix_radius, double lay_angle, int count);

/// Returns the smallest distance between the axes of parts of two components of one parent [m]. Parts with unequal tan(alpha)/R
/// meet within a metre, so their distance is the difference of their radii.
double nearest_distance(const Component& one, const Component& other);

/// Returns whether the parts of a component overlap by more than overlap_warnings() allows.
bool overlaps(const Component& component);
/// Returns whether parts of two components of one parent overlap by more than overlap_warnings() allows.
bool overlap_each_other(const Component& one, const Component& other);

/// Returns a warning for each component, and for each pair of components of one parent, whose parts overlap by more than 2 % of
/// their diameter (the error of a caliper, and the tolerance of a fit into the parent): the parts, the overlap, and values that
/// fit. Also warns of parts outside of a bore that is an ESTIMATE (room_of_parts()), and of a bore that is filled by more than 70 %
/// (PMA, recommendation for filling grade). Errors: InputErrors for parts nearer than
/// half of their diameter; for two components only if they have equal tan(alpha)/R, like cables at one angle. Insulation is soft,
/// but such parts would share over a third of their cross-sections.
std::vector<Warning> overlap_warnings(const Dresspack& dresspack);

/// Throws only the errors of overlap_warnings(). Takes a hundredth of its time, because no values that fit are computed.
void refuse_gross_overlap(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
