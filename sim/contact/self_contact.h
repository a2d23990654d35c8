// Where the hose touches itself: nearest points of its segments' axes.
//
// Two segments touch when their axes are nearer than a diameter. Neighbours are left out: pieces less than
// pi d/2 apart along the hose can meet only if it bends more sharply than its own radius d/2, which is what
// its bending stiffness is there to prevent.
#pragma once

#include <vector>

#include "sim/contact/contact.h"

namespace dresslife::sim {

/// Nearest points of the segments a0 a1 and b0 b1, as shares 0..1 of the way from a0 and b0. (Both squared
/// distances minimised in turn from the unconstrained minimum, clamped: exact for two segments.)
struct NearestPoints {
  double a = 0, b = 0;
};
NearestPoints nearest_points(const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1);

/// Adds the contacts of the hose with itself, and of one hose with another, that are nearer than `reach` [m]
/// to touching. Costs O(n) for a hose that is spread out: from a distance D of two segments the next (D -
/// reach)/l along the span cannot be near. Returns a distance that no pair's surfaces are nearer to than [m]; infinite
/// without a pair: until they have moved so far there is no contact within `reach`.
double find_self_contacts(const Rod& rod, const RodState& state, double reach,
                          std::vector<Contact>& contacts);

}  // namespace dresslife::sim
