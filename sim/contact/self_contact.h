// Contact of the hose with itself: nearest points of the axes of its segments.
//
// Two segments touch when their axes are nearer than a diameter. Neighbours are left out: pieces less than pi d/2 apart along the
// hose could touch only in a bend sharper than the hose's radius d/2, which its bending stiffness prevents.
#pragma once

#include <vector>

#include "sim/contact/contact.h"

namespace dresslife::sim {

/// Nearest points of the segments a0 a1 and b0 b1, as shares 0..1 of the way from a0 and b0. (Starting from the unconstrained
/// minimum, the squared distance is minimised over each share in turn, with limits: exact for two segments.)
struct NearestPoints {
  double a = 0, b = 0;
};
NearestPoints nearest_points(const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1);

/// Adds the contacts of the hose with itself, and of one hose with another, whose gap is below `reach` [m]. Costs O(n) for a
/// spread-out hose: at a distance D of two segments, the next (D - reach)/l segments along the span cannot be near. Returns a
/// lower bound of the distance between the surfaces of all pairs [m]; infinity without pairs. Until the segments have moved by
/// this distance there is no contact within `reach`.
double find_self_contacts(const Rod& rod, const RodState& state, double reach, std::vector<Contact>& contacts);

}  // namespace dresslife::sim
