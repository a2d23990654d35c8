// Strain and shear together: a wire's surface is stretched along its axis by eps and sheared by gamma = r dtau.
//
// Equivalent strain (von Mises), (F17): eps_eq = sqrt(eps^2 + gamma^2 / 3), with the sign of eps. It is exact if both are
// proportional. The sign is wrong where shear dominates.
//
// Critical plane (Smith, Watson and Topper's parameter on a plane, Socie 1987), (F18): on the plane whose
// normal lies at angle theta to the axis, with nu the ratio of lateral contraction,
//     eps_n(t) = eps (cos^2 theta - nu sin^2 theta) + gamma sin theta cos theta
// is a strain history as any other: it is counted, and its stress and damage (9) are computed. The plane with the largest damage
// decides. Assumption in addition to those of damage.h: the stress across the plane follows only the strain normal to it. Cracks
// that are opened by shear instead of tension need another parameter (Fatemi and Socie 1988).
#pragma once

#include <span>
#include <vector>

#include "fatigue/damage.h"
#include "pipeline/job/material.h"

namespace dresslife::fatigue {

/// Returns eps_n of (F18), (sample).
std::vector<double> plane_strain(std::span<const double> strain, std::span<const double> shear, double poisson_ratio,
                                 double theta);

struct CriticalPlane {
  double theta = 0;   ///< angle of its normal to the axis, in [-pi/2, pi/2) [rad]
  double damage = 0;  ///< per repeat
};

/// Returns the worst of `planes` planes, equally spaced over half a turn from theta = -pi/2. For even `planes` the plane across
/// the axis is one of them. poisson_ratio: nu of the material.
CriticalPlane critical_plane(std::span<const double> strain, std::span<const double> shear, double poisson_ratio,
                             const DamageCounter& counter, DamageCounter::Workspace& workspace, int planes = 36);

}  // namespace dresslife::fatigue
