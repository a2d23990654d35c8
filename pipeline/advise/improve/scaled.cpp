#include "pipeline/advise/improve/scaled.h"

#include <fmt/format.h>

#include <initializer_list>

namespace dresslife::pipeline {
namespace {

void multiply(double factor, std::initializer_list<double*> values) {
  for (double* value : values) *value *= factor;
}
void multiply(double factor, std::initializer_list<std::optional<double>*> values) {
  for (std::optional<double>* value : values)
    if (*value) **value *= factor;
}

void scale(Component& component, double factor) {
  const double area = factor * factor, inertia = area * area;
  multiply(factor, {&component.radius, &component.helix_radius});
  multiply(factor, {&component.radial_line_load, &component.laying.play});
  multiply(area, {&component.tension});
  multiply(area, {&component.laying.base_grip, &component.laying.tool_grip, &component.laying.mass});
  multiply(inertia, {&component.polymer_bending_stiffness});
  multiply(inertia, {&component.measured_bending_stiffness});
  multiply(1 / factor, {&component.measured_at_curvature});
  if (component.plain) {
    multiply(factor, {&component.plain->bore});
    multiply(inertia, {&component.plain->bending_stiffness});
  }
  if (component.jacket) component.jacket->thickness *= factor;
  for (Component& part : component.components) scale(part, factor);
}

}  // namespace

Dresspack scaled(Dresspack dresspack, double factor) {
  const double area = factor * factor;
  multiply(factor, {&dresspack.diameter, &dresspack.core_diameter});
  multiply(factor, {&dresspack.least_bend_radius, &dresspack.inner_diameter});
  multiply(area, {&dresspack.mass_per_length, &dresspack.axial_stiffness});
  multiply(area, {&dresspack.most_tension});
  multiply(area * area, {&dresspack.bending_stiffness, &dresspack.torsional_stiffness});
  multiply(area * area, {&dresspack.core_bending_stiffness, &dresspack.core_torsional_stiffness});
  multiply(area, {&dresspack.core_axial_stiffness});
  multiply(1 / factor, {&dresspack.construction_curvature});
  multiply(1 / factor, {&dresspack.rest_curvature});
  multiply(1 / factor, {&dresspack.most_twist});
  for (BendingFriction& friction : dresspack.bending_friction)
    friction.stiffness *= area * area, friction.slides_at /= factor;
  if (Corrugation* wall = dresspack.hose_corrugation ? &*dresspack.hose_corrugation : nullptr)
    multiply(factor, {&wall->pitch, &wall->height, &wall->wall});
  if (dresspack.sleeve) dresspack.sleeve->thickness *= factor;
  for (Component& component : dresspack.components) scale(component, factor);
  drop_ratings(dresspack);
  dresspack.source = fmt::format("{} times the size of {}: {}", factor, dresspack.name, dresspack.source);
  dresspack.name = fmt::format("{}_{:.0f}_percent", dresspack.name, 100 * factor);
  return dresspack;
}

}  // namespace dresslife::pipeline
