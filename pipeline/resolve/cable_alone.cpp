#include "pipeline/resolve/cable_alone.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/resolve/data_sheet.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

namespace {

std::string name_of(const Node& node) {
  const Node* name = node.find("name");
  return name ? name->text : std::string();
}

/// Returns whether a key of a component describes its place among others.
bool is_place(const std::string& key) {
  for (const char* word : {"count", "layer", "helix_radius_mm", "lay_angle_deg", "hand", "phase_deg", "position",
                           "slack_percent", "play_mm", "base_grip_N", "tool_grip_N"})
    if (key == word) return true;
  return false;
}

void copy(const Node& from, const char* key, Node& to) {
  if (const Node* value = from.find(key)) to[key] = *value;
}

/// Returns a dresspack of this cable. Its diameter is twice the cable's radius.
Node around(Node cable) {
  std::erase_if(cable.entries, [](const Entry& entry) { return is_place(entry.key); });
  cable["helix_radius_mm"] = scalar("0");
  const Node* radius = cable.find("radius_mm");
  if (!radius) throw InputError(cable.where, fmt::format("cable '{}' has no radius_mm", name_of(cable)), "give it");
  Node dresspack;
  dresspack.kind = Node::Kind::map;
  dresspack.where = cable.where;
  copy(cable, "name", dresspack);
  dresspack["cable_alone"] = scalar("true");
  char* end = nullptr;
  const double millimetres =
      std::strtod(radius->text.c_str(), &end);  // a text that is no number is refused as radius_mm
  dresspack["diameter_mm"] = scalar(*end == '\0' ? shortest_text(2 * millimetres) : radius->text);
  dresspack["diameter_mm"].where = radius->where;
  dresspack["components"] = list_of({std::move(cable)});
  return dresspack;
}

/// Returns the jacket and its content as one part.
Node cable_of(const Node& dresspack) {
  Node cable;
  cable.kind = Node::Kind::map;
  cable.where = dresspack.where;
  copy(dresspack, "name", cable);
  if (const Node* diameter = dresspack.find("diameter_mm")) {
    cable["radius_mm"] = scalar(shortest_text(std::strtod(diameter->text.c_str(), nullptr) / 2));
    cable["radius_mm"].where = diameter->where;
  }
  // A jacket without a hose has no friction with a hose.
  cable["friction_coefficient"] = scalar("0");
  cable["radial_line_load_N_per_m"] = scalar("0");
  copy(dresspack, "components", cable);
  copy(dresspack, "ratings", cable);
  return cable;
}

const Node* parts_of(const Node& part) {
  const Node* components = part.is_map() ? part.find("components") : nullptr;
  return components && components->is_list() ? components : nullptr;
}

std::vector<const Node*> parts_with_parts(const Node& dresspack) {
  std::vector<const Node*> parts;
  if (const Node* components = parts_of(dresspack))
    for (const Node& part : components->items)
      if (parts_of(part)) parts.push_back(&part);
  return parts;
}

/// Returns the cable on the axis of a dresspack without other parts; null: the dresspack's parts are those of the cable.
const Node* lone_cable(const Node& dresspack) {
  const Node* components = parts_of(dresspack);
  if (!components || components->items.size() != 1 || !parts_of(components->items.front())) return nullptr;
  const Node& only = components->items.front();
  const Node* off_axis = only.find("helix_radius_mm");
  return off_axis && std::strtod(off_axis->text.c_str(), nullptr) != 0 ? nullptr : &only;
}

void add_names(const Node& part, std::set<std::string>& names) {
  const std::string name = name_of(part);
  names.insert(name.empty() ? "cable" : name);  // as expand_data_sheets names a part
  if (const Node* const parts = parts_of(part))
    for (const Node& inner : parts->items) add_names(inner, names);
}

/// Returns the entries of dresspack.estimates for the data sheets of a part and of its parts, by their names in the dresspack's
/// file; empty: none.
std::string left_out_of(const Node& dresspack, const Node& part) {
  const Node* const estimates = dresspack.find("estimates");
  std::set<std::string> names;
  add_names(part, names);
  const auto is_of_part = [&](const std::string& entry) {
    return std::ranges::any_of(
        names, [&](const std::string& name) { return entry.starts_with(fmt::format("data_sheet of {}: ", name)); });
  };
  return joined(filtered(parts_between(estimates ? estimates->text : "", "; "), is_of_part), "; ");
}

Node expanded(Node dresspack) {
  expand_data_sheets(dresspack);
  return dresspack;
}

}  // namespace

bool is_hose(const Node& dresspack) {
  return dresspack.find("inner_diameter_mm") || dresspack.find("hose_corrugation") || dresspack.find("hose_material");
}

std::vector<std::string> cables_of(const Node& written) {
  const Node dresspack = expanded(written);
  if (!is_hose(dresspack)) return {name_of(dresspack)};
  return mapped(parts_with_parts(dresspack), [](const Node* part) { return name_of(*part); });
}

Node cable_alone(const Node& written, const std::string& part, const Where& asked) {
  const Node dresspack = expanded(written);
  const std::vector<std::string> names = cables_of(dresspack);
  const auto known = std::ranges::find(names, part);
  if ((part.empty() && names.size() != 1) || (!part.empty() && known == names.end()))
    throw InputError(asked,
                     part.empty() ? fmt::format("dresspack '{}' holds {} cables", name_of(dresspack), names.size())
                                  : fmt::format("dresspack '{}' holds no cable '{}'", name_of(dresspack), part),
                     names.empty() ? "name a dresspack whose parts hold wires"
                                   : fmt::format("give part, one of: {}", fmt::join(names, ", ")));
  const std::size_t which = part.empty() ? 0 : static_cast<std::size_t>(known - names.begin());
  const Node* lone = is_hose(dresspack) ? nullptr : lone_cable(dresspack);
  Node cable = is_hose(dresspack) ? *parts_with_parts(dresspack)[which] : lone ? *lone : cable_of(dresspack);
  const std::string left_out = left_out_of(dresspack, cable);
  if (lone && dresspack.find("name")) cable["name"] = *dresspack.find("name");
  if (lone) copy(dresspack, "ratings", cable);
  Node alone = around(std::move(cable));
  alone.where = asked;
  copy(dresspack, "source", alone);
  copy(dresspack, "materials", alone);
  if (!left_out.empty()) alone["estimates"] = scalar(left_out);
  if (is_hose(dresspack)) return alone;
  for (const char* key :
       {"mass_kg_per_m", "bending_stiffness_Nm2", "torsional_stiffness_Nm2", "axial_stiffness_N", "construction_state",
        "construction_curvature_1_per_m", "damping_time_ms", "loss_factor", "bending_friction", "damping_source",
        "friction_coefficient", "least_bend_radius_mm", "most_twist_deg_per_m", "most_tension_N"})
    copy(dresspack, key, alone);
  return alone;
}

Node cable_alone(const Node& cable) {
  Node holder;
  holder["components"] = list_of({cable});
  holder.where = cable.where;
  copy(cable, "estimated_lay_factor", holder);
  expand_data_sheets(holder);
  Node alone = around(holder.find("components")->items.front());
  for (const char* key :
       {"source", "least_bend_radius_mm", "most_twist_deg_per_m", "most_tension_N", "estimated_lay_factor"}) {
    copy(cable, key, alone);  // keys of the dresspack, that is, of the cable as a whole
    for (Node& component : alone["components"].items)
      std::erase_if(component.entries, [&](const Entry& entry) { return entry.key == key; });
  }
  copy(holder, "estimates", alone);
  return alone;
}

}  // namespace dresslife::pipeline
