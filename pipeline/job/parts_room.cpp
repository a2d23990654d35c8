#include "pipeline/job/parts_room.h"

#include <fmt/format.h>

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

Corrugation usual_corrugation(const Dresspack& dresspack) {
  constexpr double pitch_share = 4.5 / 4, wall_share = 0.7 / 4;  // of the height, as of handling.yaml
  const double bore = dresspack.inner_diameter.value_or(usual_bore_share * dresspack.diameter);
  Corrugation usual;
  usual.height = (dresspack.diameter - bore) / 2;
  usual.pitch = pitch_share * usual.height, usual.wall = wall_share * usual.height;
  return usual;
}

std::string corrugation_line(const Corrugation& corrugation) {
  return fmt::format("hose_corrugation: {{pitch_mm: {:.3g}, height_mm: {:.3g}, wall_mm: {:.3g}}}",
                     1e3 * corrugation.pitch, 1e3 * corrugation.height, 1e3 * corrugation.wall);
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
