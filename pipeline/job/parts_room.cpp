#include "pipeline/job/parts_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dresslife::pipeline {

namespace {

/// Returns whether the first level contains cables or hoses; such parts are in a hose, not in a jacket. A single part on the axis
/// is the cable itself.
bool holds_cables(const Dresspack& dresspack) {
  const std::vector<Component>& parts = dresspack.components;
  if (dresspack.cable_alone || (parts.size() == 1 && parts[0].count == 1 && parts[0].helix_radius == 0)) return false;
  return std::ranges::any_of(parts, [](const Component& part) {
    return part.plain ||
           std::ranges::any_of(part.components, [](const Component& inner) { return !inner.components.empty(); });
  });
}

}  // namespace

PartsRoom room_of_parts(const Dresspack& dresspack) {
  const double core = dresspack.core_diameter / 2;
  if (const auto inner = inner_radius(dresspack)) return {*inner, core};
  if (holds_cables(dresspack)) return {usual_bore_share * dresspack.diameter / 2, core, true};
  return {dresspack.diameter / 2, core};
}

bool is_single_cable(const Dresspack& dresspack) {
  const bool is_hose = inner_radius(dresspack) || dresspack.hose_corrugation || !dresspack.hose_material.empty();
  return !dresspack.components.empty() && !is_hose && !holds_cables(dresspack);
}

Corrugation usual_corrugation(const Dresspack& dresspack) {
  constexpr double pitch_share = 4.5 / 4, wall_share = 0.7 / 4;  // relative to the height, from handling.yaml
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

std::string wider_hose(double bore, double height, bool has_inner_diameter) {
  const auto up = [](double size) { return std::ceil(100 * size - 1e-6) / 100; };
  const std::string inner = fmt::format("inner_diameter_mm: {:.4g}", up(bore)),
                    outer = fmt::format("diameter_mm: {:.4g} or more", up(bore + 2 * height));
  if (!(height > 0)) return inner + " or more";
  return has_inner_diameter ? inner + " and " + outer : outer;
}

std::string wider_hose(double bore, const Dresspack& dresspack) {
  return wider_hose(bore, dresspack.hose_corrugation ? 1e3 * dresspack.hose_corrugation->height : 0,
                    dresspack.inner_diameter.has_value());
}

double inside_core(const PartsRoom& room, const Component& component) {
  return beyond_caliper(component,
                        component.helix_radius == 0 ? 0 : room.core - component.helix_radius + component.radius);
}

namespace {

constexpr double touching = 1e-3;  // share of the bore; place: auto arranges parts without contact

std::string wider_bore(const Dresspack& dresspack, double radius) {
  return wider_hose(std::ceil(2e4 * radius - 1e-6) / 10, dresspack);
}

std::string thickness(const Component& part) { return fmt::format("'{}' ({:.4g} mm)", part.name, 2e3 * part.radius); }

/// Returns "radius_mm: 4 of 'air hose' if 8 is its outer diameter; or " for a hose whose bore is too narrow for its width, but
/// not for half of it; else an empty text.
std::string half_of(const Component& part) {
  const double bore = part.plain ? part.plain->bore.value_or(0) : 0;  // diameter
  return bore > 0 && bore < narrowest_bore * 2 * part.radius && bore < widest_bore * part.radius
             ? fmt::format("give radius_mm: {:.4g} of '{}' if {:.4g} is its outer diameter; or ", 5e2 * part.radius,
                           part.name, 1e3 * part.radius)
             : "";
}

/// Returns the conflict if `other` does not fit beside `middle`, which lies in the middle of the bore or must lie there.
std::optional<Crowd> crowd_around(const Dresspack& dresspack, double bore, const Component& middle,
                                  const Component& other) {
  const double gap = bore - middle.radius;
  if (2 * other.radius <= gap + 2 * caliper_error * other.radius) return std::nullopt;
  const double thickest = std::max(middle.radius, other.radius);
  const bool beside = 2 * thickest <= bore;  // both fit beside the axis, on opposite sides
  const std::string what = fmt::format(
      "{} and {} do not fit into the bore of {:.4g} mm{}: around '{}' in the middle are {:.3g} mm", thickness(middle),
      thickness(other), 2e3 * bore,
      beside ? " as they lie" : fmt::format("; a part wider than {:.4g} mm lies in the middle here", 1e3 * bore),
      middle.name, 1e3 * gap);
  const std::string together = "place: auto for both instead of helix_radius_mm and phase_deg";
  return Crowd{
      middle.where, what,
      half_of(middle) + half_of(other) +
          (beside ? "write " + together
                  : fmt::format("take a hose with {} and {}, or beside '{}' only parts of {:.3g} mm and less",
                                wider_bore(dresspack,
                                           (1 + touching) * std::min(middle.radius + 2 * other.radius, 2 * thickest)),
                                together, middle.name, 1e3 * gap))};
}

}  // namespace

std::optional<Crowd> crowd_in(const Dresspack& dresspack) {
  const PartsRoom room = room_of_parts(dresspack);
  if (!inner_radius(dresspack) || room.estimated || !(room.bore > 0) || room.core >= room.bore) return std::nullopt;
  for (const Component& part : dresspack.components)
    if (part.radius > room.bore)
      return Crowd{part.where,
                   fmt::format("'{}' is {:.4g} mm thick (the hose is {:.4g} mm wide inside)", part.name,
                               2e3 * part.radius, 2e3 * room.bore),
                   half_of(part) + fmt::format("check the diameters of both, or take a hose with {}",
                                               wider_bore(dresspack, part.radius))};
  const auto too_thick = [](const Component& part, double gap) { return 2 * part.radius * (1 - caliper_error) > gap; };
  if (room.core > 0) {
    for (const Component& part : dresspack.components)
      if (const double gap = room.bore - room.core; part.helix_radius > 0 && too_thick(part, gap))
        return Crowd{
            part.where,
            fmt::format(
                "'{}' is {:.4g} mm thick (between the core of {:.4g} mm and the bore of {:.4g} mm are {:.3g} mm)",
                part.name, 2e3 * part.radius, 2e3 * room.core, 2e3 * room.bore, 1e3 * gap),
            fmt::format("take a hose with {}, or core_diameter_mm: {:.4g} or less",
                        wider_bore(dresspack, room.core + 2 * part.radius),
                        2e3 * std::max(0.0, room.bore - 2 * part.radius))};
    return std::nullopt;
  }
  for (const Component& middle : dresspack.components) {
    if (middle.helix_radius > 0 && !too_thick(middle, room.bore)) continue;
    for (const Component& other : dresspack.components)
      if (&other != &middle || other.count > 1)
        if (auto crowd = crowd_around(dresspack, room.bore, middle, other)) return crowd;
  }
  return std::nullopt;
}

}  // namespace dresslife::pipeline
