#include "pipeline/cable/cable_force.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/cyclic_curve.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/cable/stiffness.h"

namespace dresslife::pipeline {
CableForce::CableForce(const Dresspack& dresspack, const Component& cable) {
  const double area = pi * cable.radius * cable.radius;
  mass_ = mass_of_part(dresspack, cable);
  if (cable.plain) {
    const PlainProperties plain = properties_of(*cable.plain, cable.radius);
    bending_ = plain.bending;
    wires_.push_back({area, 1, plain.axial / area, 0, 1});  // elastic
    return;
  }
  bending_ = cable_stiffness(dresspack, cable);
  for (const Component& inner : cable.components) add(dresspack, inner, 1, 1, 1);
  if (!all_strengths_known_) strength_ = 0;
}

void CableForce::add(const Dresspack& dresspack, const Component& part, double count, double cosines, double share) {
  count *= part.count;
  cosines *= std::cos(part.lay_angle);
  share *= left_by_bed(dresspack, part) * std::pow(std::cos(part.lay_angle), 2);
  for (const Component& inner : part.components) add(dresspack, inner, count, cosines, share);
  if (!part.components.empty()) return;
  const double area = count * pi * part.radius * part.radius;
  const Material* material = find_material(dresspack, part.material);
  all_strengths_known_ &= material && material->tensile_strength;
  if (!material) return;
  strength_ += area * cosines * material->tensile_strength.value_or(0);
  Wires wires{area * cosines, share, material->youngs_modulus, 0, 1};
  if (material->fatigue_strength > 0) {  // otherwise a polymer with a life table: elastic
    wires.hardening = hardening_exponent(*material);
    wires.cyclic_strength = cyclic_strength(*material);
  }
  const auto same = std::ranges::find_if(wires_, [&](const Wires& other) {
    return other.share == wires.share && other.modulus == wires.modulus &&
           other.cyclic_strength == wires.cyclic_strength && other.hardening == wires.hardening;
  });
  if (same == wires_.end())
    wires_.push_back(wires);
  else
    same->area += wires.area;
}

/// Solves with Newton's method for the stress. The start is the elastic stress, above the root of a convex increasing function,
/// so every step decreases to the root.
double CableForce::Wires::stress(double strain) const {
  const double size = std::abs(strain);
  double sigma = modulus * size;
  if (cyclic_strength == 0) return std::copysign(sigma, strain);  // a polymer: elastic
  sigma = std::min(sigma, cyclic_strength * std::pow(size, hardening));
  for (int k = 0; k < 60; ++k) {
    const double plastic = std::pow(sigma / cyclic_strength, 1 / hardening);
    const double residue = sigma / modulus + plastic - size;
    const double slope = 1 / modulus + (sigma > 0 ? plastic / (hardening * sigma) : 0);
    const double down = residue / slope;
    sigma -= down;
    if (std::abs(down) <= 1e-13 * sigma) break;
  }
  return std::copysign(sigma, strain);
}

double CableForce::force(double strain) const {
  return sum_of(wires_, [&](const Wires& wires) { return wires.area * wires.stress(wires.share * strain); });
}

double CableForce::strain_at(double wanted) const {
  if (wanted == 0 || wires_.empty()) return 0;
  double low = 0, high = 1e-3;
  while (force(high) < std::abs(wanted) && high < 1e3) high *= 2;
  while (high - low >
         1e-15 + 1e-13 * high) {  // by bisection, because the slope of a sum of powers can mislead Newton's method
    const double middle = (low + high) / 2;
    (force(middle) < std::abs(wanted) ? low : high) = middle;
  }
  return std::copysign((low + high) / 2, wanted);
}

}  // namespace dresslife::pipeline
