#include "pipeline/cable/kink.h"

#include <cmath>

#include "pipeline/cable/plain_properties.h"

namespace dresslife::pipeline {
namespace {

constexpr double poisson = 0.45;      // between polyamide 12 (0.4) and polyurethane (0.48)
constexpr double early = 1.38;        // kink radius / R: median of thirteen tubes
constexpr double early_spread = 0.1;  // of log10. The thirteen tubes have 0.05. ESTIMATE for other polymers: twice that
constexpr double collapse = 2.0 / 9;  // z at the maximum of the moment

}  // namespace

double Tube::ovality(double curvature) const {
  const double wall = (outer - bore) / 2, middle = (outer + bore) / 4, bend = curvature * middle * middle / wall;
  return bend * bend * (1 - poisson * poisson);
}

double Tube::brazier_radius() const { return std::sqrt(ovality(1) / collapse); }

KinkRadius kink_radius(const Tube& tube) { return {early * tube.brazier_radius(), early_spread}; }

KinkRadius kink_radius(const Component& hose) {
  if (hose.plain->least_bend_radius) return {*hose.plain->least_bend_radius, 0};
  return kink_radius(Tube{2 * hose.radius, 2 * properties_of(*hose.plain, hose.radius).bore});
}

}  // namespace dresslife::pipeline
