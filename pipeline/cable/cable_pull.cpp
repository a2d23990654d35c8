#include "pipeline/cable/cable_pull.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/base/halving.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/job/parts_room.h"

namespace dresslife::pipeline {
namespace {

/// Stretch and twist rate of a parent, deformed or undeformed.
struct Straight {
  double stretch = 1, twist = 0;
};

Straight along(const Component& part, const Straight& parent) {
  const double lay = sign_of(part.hand) * part.lay_angle, cosine = std::cos(lay);
  if (part.helix_radius == 0) return parent;
  const double turning = std::tan(lay) + part.helix_radius * parent.twist;  // R sigma
  return {cosine * std::hypot(turning, parent.stretch), cosine * cosine * turning / part.helix_radius};
}

/// Returns the pull along the parent.
double pull_of(const std::vector<Component>& components, const Dresspack& dresspack, const Straight& now,
               const Straight& rest) {
  double sum = 0;
  for (const Component& part : components) {
    const Straight before = along(part, rest);
    Straight here = along(part, now);
    here.stretch = before.stretch + left_by_bed(dresspack, part) * (here.stretch - before.stretch);
    double own = 0;
    if (part.components.empty()) {
      const Material* material = find_material(dresspack, part.material);
      own = (material ? material->youngs_modulus : 0) * std::numbers::pi * part.radius * part.radius *
            (here.stretch / before.stretch - 1);
    } else {
      own = pull_of(part.components, dresspack, here, before);
    }
    sum += part.count * std::cos(part.lay_angle) * own;
  }
  return sum;
}

double bending_of(const std::vector<Component>& components, const Dresspack& dresspack) {
  double sum = 0;
  for (const Component& part : components) {
    const Material* material = find_material(dresspack, part.material);
    const double wire = (material ? material->youngs_modulus : 0) * std::numbers::pi / 4 * std::pow(part.radius, 4);
    const double own = part.plain                ? properties_of(*part.plain, part.radius).bending
                       : part.components.empty() ? wire
                                                 : cable_stiffness(dresspack, part);
    sum += part.count * own;
  }
  return sum;
}

}  // namespace

double pull_of_wires(const Dresspack& dresspack, const std::vector<Component>& parts, double elongation, double twist) {
  return pull_of(parts, dresspack, {1 + elongation, twist}, {});
}

double elongation_under(const Dresspack& dresspack, const std::vector<Component>& parts, double pull, double twist) {
  // The pull increases with the elongation.
  const auto pulls_less = [&](double elongation) { return pull_of_wires(dresspack, parts, elongation, twist) < pull; };
  return halved(-0.5, 0.5, 60, pulls_less).middle();
}

TwistShortening twist_shortening(const Dresspack& dresspack, const Component& cable) {
  constexpr double twist = 1;  // [rad/m], a large twist of hoses: the cubic term is 1e-5 of the result, rounding 1e-15
  if (!(pull_of_wires(dresspack, cable.components, 1e-3, 0) > 0)) return {};
  const double there = -elongation_under(dresspack, cable.components, 0, twist);
  const double back = -elongation_under(dresspack, cable.components, 0, -twist);
  return {(there - back) / (2 * twist), (there + back) / (2 * twist * twist)};
}

TwistShortening twist_shortening(const Dresspack& dresspack) {
  if (!is_single_cable(dresspack)) return {};
  Component whole;
  whole.components = dresspack.components;
  return twist_shortening(dresspack, whole);
}

double bending_stiffness(const Dresspack& dresspack) {
  return dresspack.bending_stiffness > 0 ? dresspack.bending_stiffness : bending_of(dresspack.components, dresspack);
}

}  // namespace dresslife::pipeline
