#include "pipeline/resolve/estimates.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "pipeline/job/dresspack.h"
#include "pipeline/resolve/cable_alone.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

std::optional<double> number_at(const Node& node, const char* key) {
  const Node* const value = node.find(key);
  if (!value || !value->is_scalar()) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(value->text.c_str(), &end);
  return !value->text.empty() && *end == '\0' && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::string text_at(const Node& node, const char* key) {
  const Node* const value = node.find(key);
  return value && value->is_scalar() ? value->text : "";
}

Node& add(Node& to, const char* key, const std::string& text) {
  Node& value = to[key];
  value = scalar(text);
  value.where = to.where;
  to.entries.back().where = to.where;
  return value;
}

/// List of the estimates: keys in the order of their addition, their values, and the parts that have them.
class List {
 public:
  void note(const std::string& key, const std::string& value, const std::string& part) {
    Key& of = found(keys_, key);
    std::vector<std::string>& parts = found(of.values, value).parts;
    if (!part.empty() && std::ranges::find(parts, part) == parts.end()) parts.push_back(part);
  }

  /// "friction_coefficient 0.3 (conductor, wire); radial_line_load_N_per_m 94 (conductor), 18.8 (wire)"
  std::string text() const {
    std::vector<std::string> keys;
    for (const Key& key : keys_) {
      std::vector<std::string> values;
      for (const Value& value : key.values)
        values.push_back(value.parts.empty() ? value.name
                                             : fmt::format("{} ({})", value.name, fmt::join(value.parts, ", ")));
      keys.push_back(fmt::format("{} {}", key.name, fmt::join(values, ", ")));
    }
    return fmt::format("{}", fmt::join(keys, "; "));
  }

 private:
  struct Value {
    std::string name;
    std::vector<std::string> parts{};
  };
  struct Key {
    std::string name;
    std::vector<Value> values{};
  };
  template <class Named>
  static Named& found(std::vector<Named>& all, const std::string& name) {
    for (Named& one : all)
      if (one.name == name) return one;
    return all.emplace_back(Named{name});
  }
  std::vector<Key> keys_;
};

std::string rounded(double value) { return fmt::format("{:.4g}", value); }

/// Surroundings of a component.
enum class Inside {
  hose,    ///< parts are beside each other without pressure
  jacket,  ///< the jacket of a cable, or of a core without pressure from outside
  core     ///< a core under the pressure of a jacket
};

class Estimates {
 public:
  explicit Estimates(Node& dresspack) : dresspack_(dresspack) {}

  void add_all(bool on_robot) {
    Node* const components = dresspack_.find("components");
    if (!components || !components->is_list() || components->items.empty()) return;
    const bool hose = is_hose(dresspack_);
    for (Node& component : components->items) {
      if (!component.is_map()) continue;
      if (hose) add_slack(component);
      add_friction(component, hose ? Inside::hose : Inside::jacket, estimated_jacket_pressure);
    }
    if (on_robot || !dresspack_.find("cable_alone")) add_to_hose(components->items);
    if (const std::string text = list_.text(); !text.empty()) {
      const Node* const before = dresspack_.find("estimates");
      add(dresspack_, "estimates", before ? before->text + "; " + text : text);
    }
  }

 private:
  void estimate(Node& component, const char* key, double value) {
    if (component.find(key)) return;
    list_.note(key, add(component, key, rounded(value)).text, text_at(component, "name"));
  }

  /// pressure: on this component [Pa].
  void add_friction(Node& component, Inside inside, double pressure) {
    if (component.find("without_wires")) return;
    const bool wire = !component.find("components");
    estimate(component, "friction_coefficient", estimated_friction);
    const double width = 2e-3 * number_at(component, "radius_mm").value_or(0);  // [m]
    const bool on_axis = inside == Inside::jacket && !wire && number_at(component, "helix_radius_mm") == 0.0;
    const bool pressed = inside != Inside::hose && !on_axis;
    estimate(component, "radial_line_load_N_per_m", pressed ? pressure * width : 0);
    Node* const parts = component.find("components");  // an addition moves the entries
    if (!parts || !parts->is_list()) return;
    const double load = number_at(component, "radial_line_load_N_per_m").value_or(0);
    const double inner = pressed && width > 0 ? load / width : pressure;
    for (Node& part : parts->items)
      if (part.is_map()) add_friction(part, pressed ? Inside::core : Inside::jacket, inner);
  }

  /// Adds the slack of a loose part (lies_loose()).
  void add_slack(Node& component) {
    const bool room = dresspack_.find("inner_diameter_mm") || dresspack_.find("hose_corrugation");
    const std::string position = text_at(component, "position");
    const bool holds = component.find("components") || component.find("without_wires");
    const bool gentle =
        number_at(component, "lay_angle_deg").value_or(0) <= steepest_loose_lay * 180 * std::numbers::inv_pi;
    if (position == "loose" || (position != "held" && room && gentle && holds))
      estimate(component, "slack_percent", estimated_slack);
  }

  /// Sets the diameter of a dresspack that consists of one cable on its axis: it is that of the cable.
  void add_width(const std::vector<Node>& components) {
    if (dresspack_.find("diameter_mm") || is_hose(dresspack_) || components.size() != 1) return;
    const auto radius = number_at(components.front(), "radius_mm");
    if (!radius || !(*radius > 0) || number_at(components.front(), "helix_radius_mm") != 0.0) return;
    const Where where = components.front().find("radius_mm")->where;  // an addition moves the entries
    add(dresspack_, "diameter_mm", shortest_text(2 * *radius)).where = where;
  }

  /// Returns whether any part limits the dresspack's length; cables with slack do not.
  bool is_held(const std::vector<Node>& components) const {
    return dresspack_.find("hose_material") || dresspack_.find("core_axial_stiffness_N") || !is_hose(dresspack_) ||
           std::ranges::any_of(components, [](const Node& component) {
             return number_at(component, "slack_percent").value_or(0) == 0;
           });
  }

  void add_to_hose(const std::vector<Node>& components) {
    const bool held = is_held(components);
    add_width(components);  // an addition moves the components
    if (!held) estimate(dresspack_, "axial_stiffness_N", estimated_axial_stiffness);
    for (const char* key : {"mass_kg_per_m", "bending_stiffness_Nm2", "torsional_stiffness_Nm2", "axial_stiffness_N"})
      if (!dresspack_.find(key)) add(dresspack_, key, "from_construction");
    estimate(dresspack_, "friction_coefficient", estimated_friction);
    if (dresspack_.find("damping_time_ms") || dresspack_.find("damping_source")) return;
    list_.note("damping_time_ms", add(dresspack_, "damping_time_ms", rounded(estimated_damping_time)).text, "");
    estimate(dresspack_, "loss_factor", is_hose(dresspack_) ? estimated_hose_loss : estimated_cable_loss);
    add(dresspack_, "damping_source", "ESTIMATE, the default of dresslife; a decay test of a hanging length decides");
  }

  Node& dresspack_;
  List list_;
};

}  // namespace

void add_estimates(Node& dresspack, bool on_robot) { Estimates(dresspack).add_all(on_robot); }

}  // namespace dresslife::pipeline
