#include "pipeline/cable/shares.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dresslife::helices {

double turning(double of_parent, double lay_angle, double helix_radius) {
  const double own = helix_radius > 0 ? std::tan(lay_angle) / helix_radius : 0;
  return (of_parent + own) * std::cos(lay_angle);
}

double evening_length(double turning, double longest) {
  return std::min(longest, 2 * std::numbers::pi / std::abs(turning));
}

double elastic_share(double jacket_stiffness, double axial_stiffness, double evening_length) {
  if (jacket_stiffness == 0) return 0;
  const double waves = 2 * std::numbers::pi / evening_length;  // [rad/m]
  return jacket_stiffness / (jacket_stiffness + axial_stiffness * waves * waves);
}

double radial_share(double axial_stiffness, double lay_angle, double helix_radius, double radial_stiffness) {
  if (helix_radius == 0) return 1;
  const double press = std::pow(std::sin(lay_angle), 2) / helix_radius;  // line load per tension [1/m]
  return 1 / (1 + axial_stiffness * press * press / radial_stiffness);
}

}  // namespace dresslife::helices
