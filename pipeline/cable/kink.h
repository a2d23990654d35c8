// Bend radius at which a smooth tube kinks.
//
// A bent tube becomes oval. r: mean radius of its wall, t: wall thickness, kappa: curvature. Its diameter in
// the plane of the bend is reduced by
//     z = kappa^2 r^4 (1 - nu^2) / t^2                                                                        (F35)
// (Brazier 1927). Its moment has a maximum at z = 2/9, at which the tube collapses into a kink, at the radius
//     R = r^2 sqrt(1 - nu^2) / (t sqrt(2/9)).
// Real tubes kink earlier: well before the maximum of the moment, the bend concentrates at the flattest point. Thirteen tubes of
// polyamide 12 (SMC, catalogue of series T and TIA, "bending value") kink at 1.38 R in the median, 1.13 to 1.76 R. The "minimum
// bending radius" of that catalogue, at which the diameter has changed by 5 %, agrees with (F35) within a factor of 1.4 without a
// fitted constant. So the kink radius is `early` R with a lognormal distribution. Its standard deviation is that for polymers
// without measured tubes: ESTIMATE.
//
// Tubes that yield before they are oval kink at larger radii: up to five times for walls thicker than a twelfth of the diameter,
// of PTFE. Then use the maker's radius, least_bend_radius_mm. Not included: pressure, which keeps a tube round (safe); vacuum;
// fabric or a spiral in the wall, which also keeps it round; heat, which softens the whole tube equally; creep in a bend.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// A smooth tube.
struct Tube {
  double outer = 0, bore = 0;  ///< diameters [m]
  /// Returns z of (F35) at this curvature of its axis [1/m].
  double ovality(double curvature) const;
  double brazier_radius() const;  ///< R of (F35) [m]
};

/// Kink radius of a tube's axis.
struct KinkRadius {
  double median = 0;        ///< [m]
  double log10_spread = 0;  ///< standard deviation of its log10; 0: the radius is from the maker
};
KinkRadius kink_radius(const Tube& tube);

/// Returns the kink radius of a part that is a hose: that of its maker, otherwise from its diameters.
KinkRadius kink_radius(const Component& hose);

}  // namespace dresslife::pipeline
