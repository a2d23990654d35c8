// At which bend radius a smooth tube kinks.
//
// A bent tube becomes oval. r: mean radius of its wall, t: wall, kappa: curvature. Its diameter in the bend's plane shrinks by
//     z = kappa^2 r^4 (1 - nu^2) / t^2                                                                        (F35)
// (Brazier 1927). Its moment has a maximum at z = 2/9, where the tube collapses into a kink, at the radius
//     R = r^2 sqrt(1 - nu^2) / (t sqrt(2/9)).
// Real tubes kink earlier: long before their moment is at its maximum, the flattest place gathers the bend. Thirteen tubes of
// polyamide 12 (SMC, catalogue of series T and TIA, "bending value") kink at 1.38 R in the median, 1.13 to 1.76 R. The same catalogue's
// "minimum bending radius", at which the diameter has changed by 5 %, is (F35)'s within a factor of 1.4, without any constant fitted.
// So the radius is `early` R, lognormal. The deviation is that of polymers whose tubes were not measured: ESTIMATE.
//
// Tubes that yield before they are oval kink at larger radii: walls thicker than a twelfth of the diameter, of PTFE, up to five
// times. least_bend_radius_mm of the maker is then right. Not contained: pressure, which keeps a tube round (safe); vacuum;
// fabric or a spiral in the wall, which keeps it round too; heat, which softens all of it alike; creep in a bend.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// A smooth tube.
struct Tube {
  double outer = 0, bore = 0;  ///< diameters [m]
  /// z of (F35) at this curvature of its axis [1/m].
  double ovality(double curvature) const;
  double brazier_radius() const;  ///< R of (F35) [m]
};

/// Where a tube kinks, as a radius of its axis.
struct KinkRadius {
  double median = 0;        ///< [m]
  double log10_spread = 0;  ///< standard deviation of its log10; 0: a maker's
};
KinkRadius kink_radius(const Tube& tube);

/// Of a part that is a hose: its maker's, else by its diameters.
KinkRadius kink_radius(const Component& hose);

}  // namespace dresslife::pipeline
