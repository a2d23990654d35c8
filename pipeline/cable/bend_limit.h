// The smallest bend radius that a dresspack is made for, where its maker names none.
#pragma once

#include <algorithm>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// The usual rule for moved cables and hoses: Parker prefers ten diameters of its flex cables and allows 5; ABB's manual of
/// its DressPack (3HAC055424) asks for ten diameters of a cable or hose.
inline constexpr double least_bend_diameters = 10;

/// [m] at the dresspack's axis. A corrugated hose is no cable: it bends by its folds, and the rule holds for the parts in
/// it. Each part on the inner side of the bend, nearer to its centre by its helix radius, keeps the rule; so does what fills
/// the middle, counted as one part. Everything else keeps it by its own diameter. The folds' own limit is not known here:
/// least_bend_radius_mm is for it.
inline double least_bend_radius(const Dresspack& dresspack) {
  if (dresspack.least_bend_radius) return *dresspack.least_bend_radius;
  if (!dresspack.hose_corrugation || dresspack.components.empty()) return least_bend_diameters * dresspack.diameter;
  double least = least_bend_diameters * dresspack.core_diameter;
  for (const Component& part : dresspack.components)
    least = std::max(least, least_bend_diameters * 2 * part.radius + part.helix_radius);
  return least;
}

}  // namespace dresslife::pipeline
