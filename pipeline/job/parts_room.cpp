#include "pipeline/job/parts_room.h"

#include <algorithm>

namespace dresslife::pipeline {

namespace {

/// Whether its first level holds cables or hoses, which a hose holds, not a jacket. A lone part on the axis is the
/// cable itself.
bool holds_cables(const Dresspack& dresspack) {
  const std::vector<Component>& parts = dresspack.components;
  if (dresspack.cable_alone || (parts.size() == 1 && parts[0].count == 1 && parts[0].helix_radius == 0))
    return false;
  return std::any_of(parts.begin(), parts.end(), [](const Component& part) {
    return part.plain || std::any_of(part.components.begin(), part.components.end(), [](const Component& inner) {
             return !inner.components.empty();
           });
  });
}

}  // namespace

PartsRoom room_of_parts(const Dresspack& dresspack) {
  const double core = dresspack.core_diameter / 2;
  if (const auto inner = inner_radius(dresspack)) return {*inner, core};
  if (holds_cables(dresspack)) return {usual_bore_share * dresspack.diameter / 2, core, true};
  return {dresspack.diameter / 2, core};
}

namespace {

double beyond_caliper(const Component& component, double by) {
  return by > 2 * caliper_error * component.radius ? by : 0;
}

}  // namespace

double outside_bore(const PartsRoom& room, const Component& component) {
  return beyond_caliper(component, component.helix_radius + component.radius - room.bore);
}

double inside_core(const PartsRoom& room, const Component& component) {
  return beyond_caliper(component, component.helix_radius == 0 ? 0 : room.core - component.helix_radius + component.radius);
}

}  // namespace dresslife::pipeline
