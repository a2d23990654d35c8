#include "pipeline/report/cross_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr double picture = 640;     // side of the square around the hose [px]
constexpr double margin = 20;       // [px]
constexpr double line_height = 18;  // height of a line of the list below [px]

double millimetres(double metres) { return 1e3 * metres; }

std::string name_of(const Component& of) { return of.layer.empty() ? of.name : of.name + ", " + of.layer; }

double lay_length(const Component& of) { return 2 * pi * of.helix_radius / std::tan(of.lay_angle); }

std::string lay_words(const Component& of) {
  if (of.lay_angle == 0) return "straight";
  return fmt::format("{:.4g} deg {}, {:.4g} mm a turn", of.lay_angle * 180 / pi, word(of.hand),
                     millimetres(lay_length(of)));
}

std::string kind_words(const Component& part) {
  const PlainProperties plain = properties_of(*part.plain, part.radius);
  std::string words(word(part.plain->kind));
  if (plain.bore > 0)
    words += fmt::format(" for {}, bore {:.4g} mm", word(part.plain->medium), millimetres(2 * plain.bore));
  return words;
}

/// Returns the properties of a part without wires, as text.
std::string plain_words(const Component& part) {
  const PlainProperties plain = properties_of(*part.plain, part.radius);
  return kind_words(part) + fmt::format(", {:.3g} kg/m, E I {:.3g} N m2{}; no life here",
                                        part.laying.mass.value_or(plain.mass), plain.bending,
                                        part.plain->bending_stiffness ? "" : " (ESTIMATE)");
}

double section_of_wires(const Component& part) {
  if (part.plain) return 0;
  if (part.components.empty()) return pi * part.radius * part.radius;
  return sum_of(part.components, [](const Component& inner) { return inner.count * section_of_wires(inner); });
}

double wires_of(const Component& part) {
  if (is_wire(part)) return 1;
  return sum_of(part.components, [](const Component& inner) { return inner.count * wires_of(inner); });
}

int depth_of(const std::vector<Component>& components) {
  return largest_of(components, 0, [](const Component& component) { return 1 + depth_of(component.components); });
}

/// Stiffness of one part: E A, and E I about its own axis.
struct Stiffness {
  double axial = 0, bending = 0;
};

/// Returns the stiffness of `part`. level: level of its inner parts. solid_from: parts of this level and deeper do not slide.
Stiffness stiffness_of(const Dresspack& dresspack, const Component& part, int level, int solid_from) {
  if (part.plain) return {};
  if (part.components.empty()) {
    const Material* material = find_material(dresspack, part.material);
    const double youngs_modulus = material ? material->youngs_modulus : 0, area = section_of_wires(part);
    return {youngs_modulus * area, youngs_modulus * area * part.radius * part.radius / 4};
  }
  Stiffness sum;
  for (const Component& inner : part.components) {
    const Stiffness one = stiffness_of(dresspack, inner, level + 1, solid_from);
    const double along = one.axial * std::pow(std::cos(inner.lay_angle), 3);
    const double leverage = level >= solid_from ? inner.helix_radius * inner.helix_radius / 2 : 0;
    sum.axial += inner.count * along;
    sum.bending += inner.count * (one.bending + along * leverage);
  }
  return sum;
}

// ---- the picture ------------------------------------------------------------------------------------------

constexpr std::string_view section_style =
    "text{font:13px sans-serif;fill:#222}.wall{fill:none;stroke:#777}.room{fill:#f4f4f2}.core{fill:#ddd}"
    ".part{fill:#cfe0ee;stroke:#5a7d99}.plain{fill:#b9b4aa;stroke:#77726a}.air{fill:#fff}.water{fill:#9fc6e8}"
    ".estimate{stroke-dasharray:4 4}.wire{fill:#c0733d}.over{fill:#e23b3b}.scale{stroke:#222;stroke-width:"
    "2}"
    "@media(prefers-color-scheme:dark){text{fill:#ddd}.room{fill:#1c1c1e}.core{fill:#444}"
    ".part{fill:#2c4356;stroke:#7fa6c4}.plain{fill:#57534c;stroke:#a39d92}.air{fill:#1c1c1e}.water{fill:#2f5f86}.scale{stroke:#ddd}}";

class Drawing {
 public:
  Drawing(const Dresspack& dresspack, LayerLines layers)
      : dresspack_(dresspack),
        layers_(layers),
        room_(room_of_parts(dresspack)),
        scale_((picture - 2 * margin) / dresspack.diameter) {}

  std::string svg() {
    if (layers_ == LayerLines::drawn) list(dresspack_.components, 0);
    const double height = picture + line_height * (static_cast<double>(lines_.size()) + 1);
    std::string body = fmt::format("<g transform=\"translate({0:.4g} {0:.4g})\">\n{1}{2}</g>\n", picture / 2, hose(),
                                   inside(dresspack_.components));
    body += scale_bar();
    double y = picture + line_height;
    for (const std::string& line : lines_) {
      body +=
          fmt::format("<text x=\"{:.4g}\" y=\"{:.5g}\" xml:space=\"preserve\">{}</text>\n", margin, y, escaped(line));
      y += line_height;
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.5g} {1:.5g}\" width=\"{0:.5g}\" "
        "height=\"{1:.5g}\" "
        "role=\"img\">\n<title>Cross-section of "
        "{2}</title>\n<style>{3}</style>\n<defs>\n{4}</defs>\n{5}</svg>\n",
        picture, height, escaped(dresspack_.name), section_style, definitions_, body);
  }

 private:
  std::string circle(const char* what, double radius) const {
    return fmt::format("<circle class=\"{}\" r=\"{:.5g}\"/>\n", what, scale_ * radius);
  }

  std::string hose() const {
    const double outer = dresspack_.diameter / 2, inner = room_.bore;
    const double wall = std::max(scale_ * (outer - inner), 1.0);
    std::string text = circle("room", outer);
    text += fmt::format("<circle class=\"{}\" r=\"{:.5g}\" stroke-width=\"{:.4g}\"/>\n",
                        room_.estimated ? "wall estimate" : "wall", scale_ * outer - wall / 2, wall);
    if (dresspack_.core_diameter > 0) text += circle("core", dresspack_.core_diameter / 2);
    return text;
  }

  bool leaves_room(const Component& component, const std::vector<Component>& among) const {
    return &among == &dresspack_.components &&
           (outside_bore(room_, component) > 0 || inside_core(room_, component) > 0);
  }

  /// Returns the parts of all layers: the part of a layer is defined once and shown K times.
  std::string inside(const std::vector<Component>& components) {
    std::string text;
    for (const Component& component : components) {
      const std::string id = define(component, overlap(component, components) || leaves_room(component, components));
      for (int k = 0; k < component.count; ++k) {
        const double angle = component.phase + 2 * pi * k / component.count, R = scale_ * component.helix_radius;
        text += fmt::format("<use href=\"#{}\" x=\"{:.2f}\" y=\"{:.2f}\"/>\n", id, R * std::cos(angle),
                            -R * std::sin(angle));
      }
    }
    return text;
  }

  /// Returns whether the parts of a component overlap each other or the parts of another component of `among`.
  static bool overlap(const Component& component, const std::vector<Component>& among) {
    return overlaps(component) || std::ranges::any_of(among, [&](const Component& other) {
             return &other != &component && overlap_each_other(component, other);
           });
  }

  std::string define(const Component& component, bool over) {
    const char* const own = component.plain ? "plain" : is_wire(component) ? "wire" : "part";
    std::string shape = circle(over ? "over" : own, component.radius);
    if (component.plain && component.plain->kind == PlainKind::hose)
      shape += circle(component.plain->medium == Medium::water ? "water" : "air",
                      properties_of(*component.plain, component.radius).bore);
    shape += inside(component.components);
    const std::string id = fmt::format("p{}", parts_++);
    definitions_ += fmt::format("<g id=\"{}\">\n{}</g>\n", id, shape);
    return id;
  }

  void list(const std::vector<Component>& components, int level) {
    for (const Component& of : components) {
      std::string line =
          fmt::format("{:{}}{} x {}: {:.4g} mm", "", 4 * level, of.count, name_of(of), millimetres(2 * of.radius));
      if (of.helix_radius > 0)
        line += fmt::format(", {:.4g} mm off the axis, {}", millimetres(of.helix_radius), lay_words(of));
      if (of.plain) line += ", " + kind_words(of);
      if (leaves_room(of, components))
        line += outside_bore(room_, of) > 0
                    ? fmt::format(" ({:.3g} mm outside the bore{}: red)", millimetres(outside_bore(room_, of)),
                                  room_.estimated ? ", an ESTIMATE" : "")
                    : fmt::format(" ({:.3g} mm inside the core: red)", millimetres(inside_core(room_, of)));
      else if (overlap(of, components))
        line += " (overlap: red)";
      lines_.push_back(line);
      list(of.components, level + 1);
    }
  }

  std::string scale_bar() const {
    double length = std::pow(10, std::floor(std::log10(millimetres(dresspack_.diameter) / 4)));
    for (const double factor : {5.0, 2.0})
      if (factor * length <= millimetres(dresspack_.diameter) / 3) {
        length *= factor;
        break;
      }
    const double y = picture - margin / 2;
    return fmt::format(
        "<line class=\"scale\" x1=\"{0:.4g}\" y1=\"{1:.4g}\" x2=\"{2:.5g}\" y2=\"{1:.4g}\"/>\n"
        "<text x=\"{3:.5g}\" y=\"{4:.4g}\">{5:.4g} mm</text>\n",
        margin, y, margin + scale_ * length / 1e3, margin + scale_ * length / 1e3 + 6, y + 4, length);
  }

  const Dresspack& dresspack_;
  LayerLines layers_;
  PartsRoom room_;
  double scale_;  // [px/m]
  std::string definitions_;
  std::vector<std::string> lines_;
  int parts_ = 0;
};

/// Returns "layer 2/wire 17": the layer's name if it has one, then the name and number of the part.
std::string own_name(const Component& component, int number) {
  return fmt::format("{}{}{} {}", component.layer, component.layer.empty() ? "" : "/", component.name, number);
}

void list_wires(const std::vector<Component>& components, const std::string& before, std::vector<std::string>& paths) {
  for (const Component& component : components)
    for (int k = 0; k < component.count; ++k) {
      const std::string path = before + own_name(component, k + 1);
      if (is_wire(component)) paths.push_back(path);
      list_wires(component.components, path + "/", paths);
    }
}

void list_layer(const Component& of, int level, std::string& text) {
  text += fmt::format("{:{}}{:4} {:<{}} {:>7.4g} mm", "", 2 * level, of.count, name_of(of), 24 - 2 * level,
                      millimetres(2 * of.radius));
  if (of.helix_radius > 0) text += fmt::format("  at {:>6.4g} mm, {}", millimetres(of.helix_radius), lay_words(of));
  if (!of.material.empty()) text += "  " + of.material;
  if (of.plain) text += "  " + plain_words(of);
  text += '\n';
  for (const Component& inner : of.components) list_layer(inner, level + 1, text);
}

Component whole(const Dresspack& dresspack) {
  Component all;
  all.components = dresspack.components;
  return all;
}

/// Returns the bending stiffness of all wires [N m2], (levels + 1). Entry 0: each wire bends about its own axis. Next entries:
/// the parts that contain wires are solid, then the parts that contain these parts, and so on. Last entry: no part slides.
///     E A(part) = sum over its layers of K E A(inner) cos^3(alpha),
///     E I(part) = sum over its layers of K (E I(inner) + E A(inner) cos^3(alpha) R^2 / 2),
/// with the last term for solid parts only. Wires of unknown material have stiffness 0. Precondition: there are parts.
std::vector<double> bending_stiffnesses(const Dresspack& dresspack, const Component& all) {
  std::vector<double> stiffness;
  for (int solid_from = depth_of(dresspack.components); solid_from >= 0; --solid_from)
    stiffness.push_back(stiffness_of(dresspack, all, 0, solid_from).bending);
  return stiffness;
}

}  // namespace

std::string cross_section_picture(const Dresspack& dresspack, LayerLines layers) {
  return Drawing(dresspack, layers).svg();
}

std::vector<std::string> wire_paths(const Dresspack& dresspack) {
  std::vector<std::string> paths;
  list_wires(dresspack.components, "", paths);
  return paths;
}

std::string construction_text(const Dresspack& dresspack) {
  std::string text = fmt::format("{}: {:.4g} mm", dresspack.name, millimetres(dresspack.diameter));
  if (dresspack.mass_per_length > 0)  // a cable alone may have no properties
    text += fmt::format(", {:.4g} kg/m, E I {:.4g} N m2, G J {:.4g} N m2, E A {:.4g} N\n", dresspack.mass_per_length,
                        dresspack.bending_stiffness, dresspack.torsional_stiffness, dresspack.axial_stiffness);
  else
    text += fmt::format(", {:.4g} kg/m by its construction\n", mass_of_construction(dresspack));
  for (const Component& component : dresspack.components) list_layer(component, 1, text);
  const Component all = whole(dresspack);
  if (dresspack.components.empty()) return text + "no parts: its motion can be simulated, no wire has a life\n";
  const std::vector<double> bending = bending_stiffnesses(dresspack, all);
  text += fmt::format("{:.0f} wires of {:.4g} mm2, E A {:.4g} N\n", wires_of(all), 1e6 * section_of_wires(all),
                      stiffness_of(dresspack, all, 0, 0).axial);
  text += fmt::format("E I of the wires [N m2]: {:.3g} when all slide", bending.front());
  for (std::size_t k = 1; k + 1 < bending.size(); ++k)
    text += fmt::format(", {:.3g} when parts of level {} are solid", bending[k], bending.size() - 1 - k);
  text += fmt::format(", {:.3g} when nothing slides\n", bending.back());
  return text + stiffness_text(dresspack);
}

}  // namespace dresslife::pipeline
