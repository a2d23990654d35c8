// The least bend radius of a dresspack whose maker gives none.
#pragma once

#include <algorithm>
#include <string>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Usual rule for moving cables and hoses: Parker prefers ten diameters for its flex cables and allows 5; ABB's manual of its
/// DressPack (3HAC055424) requires ten diameters of a cable or hose.
inline constexpr double least_bend_diameters = 10;

/// Smallest bend radii that makers state for moved hoses and for moved cables, in diameters.
inline constexpr double tightest_hose = 3, tightest_cable = 4.5;

/// Returns the least bend radius at the dresspack's axis [m]. A corrugated hose bends by its folds, so the rule applies to the
/// parts in it, also those of its core: a part on the inner side of the bend is nearer to the centre by its helix radius and must
/// still satisfy the rule. What no core component describes counts as one part on the axis with the free area of the core. The
/// limit of the folds is unknown without least_bend_radius_mm, and at least tightest_hose. Any other dresspack must satisfy the rule with its own diameter.
double least_bend_radius(const Dresspack& dresspack);

/// Returns why this is the least bend radius if its maker gives none: "ten diameters of the hose (58 mm) count, because ...".
std::string bend_rule(const Dresspack& dresspack);

/// Returns the smallest bend radius that a maker may allow in motion [m].
inline double tightest_bend_radius(const Dresspack& dresspack) {
  if (dresspack.cable_alone) return tightest_cable * dresspack.diameter;
  double least = tightest_hose * dresspack.diameter;
  for (const Component& part : dresspack.components)
    least = std::max(least, (part.plain ? tightest_hose : tightest_cable) * 2 * part.radius + part.helix_radius);
  return least;
}

}  // namespace dresslife::pipeline
