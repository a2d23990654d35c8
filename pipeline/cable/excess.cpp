#include "pipeline/cable/excess.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/constants.h"
#include "pipeline/base/halving.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/cable/plausible.h"
#include "pipeline/cable/room.h"
#include "pipeline/cable/stiffness.h"

namespace dresslife::pipeline {

/// Returns a length in mm, rounded up to two digits, for requirements.
static std::string millimetres_above(double metres) { return percent_above(10 * metres); }

double excess_at_force(const CableForce& cable, double force, double room) {
  return cable.strain_at(force) + (room > 0 ? force * room * room / (4 * cable.bending_stiffness()) : 0);
}

double force_of_excess(const CableForce& cable, double excess, double room) {
  if (excess <= 0) return 0;
  const double without_room = cable.force(excess);
  return halved(0, without_room, 60, [&](double force) { return excess_at_force(cable, force, room) < excess; }).high;
}

double room_of_excess(const CableForce& cable, double excess, double force) {
  return std::sqrt(4 * cable.bending_stiffness() * std::max(0.0, excess - cable.strain_at(force)) / force);
}

std::vector<LooseRoom> loose_rooms(const Dresspack& dresspack) {
  std::vector<CableSpot> spots;
  std::vector<const Component*> of;
  for (const Component& component : dresspack.components) {
    if (is_wire(component) || !lies_loose(dresspack, component)) continue;
    for (int number = 0; number < component.count; ++number) {
      const double angle = component.phase + 2 * std::numbers::pi * number / component.count;
      spots.push_back({{component.helix_radius * std::cos(angle), component.helix_radius * std::sin(angle)},
                       component.radius,
                       component.laying.play.has_value()});
      of.push_back(&component);
    }
  }
  const std::vector<CableRoom> rooms =
      rooms_of(spots, inner_radius(dresspack).value_or(infinity), dresspack.core_diameter / 2);
  std::vector<LooseRoom> loose;
  for (std::size_t k = 0; k < spots.size(); ++k) {
    const double room = of[k]->laying.play.value_or(winding_radius(spots[k], rooms[k]));
    const bool in_ring = rooms[k].ring != no_ring;
    if (loose.empty() || loose.back().component != of[k])
      loose.push_back({of[k], room, in_ring});
    else
      loose.back().room = std::min(loose.back().room, room), loose.back().in_ring &= in_ring;
  }
  return loose;
}

std::vector<Warning> slack_warnings(const Dresspack& dresspack) {
  std::vector<Warning> warnings;
  for (const LooseRoom& loose : loose_rooms(dresspack)) {
    const Component& component = *loose.component;
    const CableForce cable(dresspack, component);
    const double slack = component.laying.slack / 100, strength = cable.strength();
    if (strength <= 0 || std::isinf(loose.room)) continue;
    const double force = force_of_excess(cable, slack, loose.room);
    if (force <= believable_share * strength) continue;
    const double limit = believable_share * strength;
    warnings.push_back(warning_of(
        WarningKind::force, component.where.text(),
        fmt::format("'{}' is compressed with {:.0f} % of its breaking force ({} of {} N, limit {:.0f} %) in the "
                    "straight hose, whatever the routing",
                    component.name, 100 * force / strength, readable(force), readable(strength),
                    100 * believable_share),
        fmt::format("it has {:.2g} mm of room to wind in and {:.3g} % ({:.3g} mm in a metre) of excess length",
                    1e3 * loose.room, 100 * slack, 1e3 * slack),
        Remedy{{{"slack_percent", percent_below(excess_at_force(cable, limit, loose.room))}},
               fmt::format(" or less; or {} mm of room around it",
                           millimetres_above(room_of_excess(cable, slack, limit)))}));
  }
  return warnings;
}

double winding_slack(const MountedDresspack& mounted, const Component& component) {
  const Routing& routing = mounted.routing;
  if (!routing.base_clamp || !routing.tool_clamp || !routing.clamps.empty()) return 0;
  const std::vector<LooseRoom> rooms = loose_rooms(mounted.dresspack);
  const bool in_ring =
      std::ranges::any_of(rooms, [&](const LooseRoom& room) { return room.component == &component && room.in_ring; });
  const double turn = 2 * std::numbers::pi * component.helix_radius / routing.free_length;
  return in_ring && std::abs(std::tan(component.lay_angle)) < turn ? turn * turn / 2 : 0;
}

double slack_to_lay(double winding_slack) { return std::max(usual_slack, winding_slack); }

std::vector<Warning> tight_warnings(const std::string& key, const MountedDresspack& mounted) {
  std::vector<Warning> warnings;
  const std::vector<Component>& components = mounted.dresspack.components;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Component& component = components[k];
    const double slack = component.laying.slack / 100, needed = winding_slack(mounted, component);
    if (slack >= needed / 2 || CableForce(mounted.dresspack, component).strength() <= 0) continue;
    warnings.push_back(warning_of(
        WarningKind::force, "",
        fmt::format(
            "'{}' has {:.3g} % of slack (limit {} %: half of what it needs to wind once around the hose's axis)",
            component.name, 100 * slack, percent_above(needed / 2)),
        "it stays on one side of the hose, so that a bend of the hose pulls it",
        Remedy{{{fmt::format("{}.components.{}.slack_percent", key, entry_number(components, k)),
                 percent_above(slack_to_lay(needed))}},
               fmt::format(" (now {:.3g}); dresspacks are installed with 1 to 2 %", component.laying.slack)}));
  }
  return warnings;
}

std::vector<Warning> construction_warnings(const Dresspack& dresspack, bool may_slide) {
  std::vector<Warning> all = joined(plausibility_warnings(dresspack), overlap_warnings(dresspack));
  if (may_slide) all = joined(std::move(all), slack_warnings(dresspack));
  return joined(std::move(all), stiffness_warnings(dresspack));
}

namespace {

void place_parts(std::vector<Component>& components, const std::string& key) {
  for (std::size_t k = 0; k < components.size(); ++k) {
    components[k].where = {fmt::format("{}.components.{}", key, entry_number(components, k))};
    place_parts(components[k].components, components[k].where.file);
  }
}

}  // namespace

std::vector<Warning> construction_warnings_at(const std::string& key, Dresspack dresspack, bool may_slide) {
  dresspack.where = {key};
  place_parts(dresspack.components, key);
  std::vector<Warning> all = construction_warnings(dresspack, may_slide);
  for (Warning& warning : all) {
    if (warning.where.empty()) warning.where = key;
    for (KeyValue& of : warning.remedy) of.key = warning.where + "." + of.key;
  }
  return all;
}

namespace {

/// Returns a percentage with two digits.
std::string percent(double share, double (*rounded)(double)) {
  if (!(share > 0)) return "0";
  const double unit = std::pow(10.0, std::floor(std::log10(100 * share)) - 1);
  return fmt::format("{:.2g}", rounded(100 * share / unit) * unit);
}

}  // namespace

std::string percent_below(double share) {
  return percent(share, [](double value) { return std::floor(value); });
}
std::string percent_above(double share) {
  return percent(share, [](double value) { return std::ceil(value); });
}

}  // namespace dresslife::pipeline
