#include "pipeline/resolve/data_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <regex>
#include <string_view>

#include "pipeline/cable/overlap.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/resolve/estimates.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double touching = 1e-9;      // of the diameter: six around one of their size
constexpr double steepest = pi / 3;    // lay angle that a component may have
constexpr int closed_ring = 5;         // six parts that touch leave room for a seventh in their middle
constexpr int filled_ring = 9;         // ten for two
constexpr double wire_lay_ratio = 16;  // lay length over the conductor's width: stranding has 10 to 20
constexpr double core_lay_ratio = 12;  // over the width of the cores: flexible cables have 8 to 16
constexpr int rounds = 60;             // of the search for the cores' diameter

double first_radius(int count, double diameter) {
  return count == 1 ? 0 : diameter / (2 * std::sin(pi / count));
}

int room_in(double radius, double diameter) {
  return static_cast<int>(std::floor(pi / std::asin(diameter / (2 * radius)) + touching));
}

/// Straight, around nothing, a filler, or one part of their own size in the `middle`.
std::vector<Ring> straight_rings(int count, double diameter, int middle, int first) {
  std::vector<Ring> rings;
  if (middle > 0) rings.push_back({1, 0, 0});
  rings.push_back({first, first_radius(first, diameter), 0});
  for (count -= middle + first; count > 0; count -= rings.back().count) {
    const double radius = rings.back().radius + diameter;
    rings.push_back({std::min(count, room_in(radius, diameter)), radius, 0});
  }
  return rings;
}

double fullness(const Ring& outer, double diameter) {
  return outer.radius == 0 ? 1 : static_cast<double>(outer.count) / room_in(outer.radius, diameter);
}

double lay_angle_at(double radius, double lay_length) { return std::atan(2 * pi * radius / lay_length); }

/// Widens a ring until its parts lie beside each other on their lay.
void lay(Ring& ring, double diameter, double lay_length, const Where& where) {
  ring.lay_angle = lay_angle_at(ring.radius, lay_length);
  const auto fits = [&](double radius) {
    return neighbour_distance(radius, lay_angle_at(radius, lay_length), ring.count) >=
           diameter * (1 - touching);
  };
  if (ring.count > 1 && !fits(ring.radius)) {
    double low = ring.radius, high = std::tan(steepest) * lay_length / (2 * pi);
    if (high <= low || !fits(high))
      throw InputError(where,
                       fmt::format("{} parts of {:.4g} mm do not lie beside each other on a lay of {:.4g} mm",
                                   ring.count, 1e3 * diameter, 1e3 * lay_length),
                       "give a longer lay");
    for (int halving = 0; halving < 50; ++halving) (fits((low + high) / 2) ? high : low) = (low + high) / 2;
    ring.radius = high;
    ring.lay_angle = lay_angle_at(high, lay_length);
  }
  if (ring.lay_angle > steepest)
    throw InputError(
        where,
        fmt::format("a lay of {:.4g} mm winds parts {:.4g} mm off the axis by {:.0f} deg (at most 60)",
                    1e3 * lay_length, 1e3 * ring.radius, ring.lay_angle * 180 / pi),
        "give a longer lay");
}

/// What a sheet stands for, from the wire outwards.
class Expansion {
 public:
  explicit Expansion(const DataSheet& sheet) : sheet_(sheet) {
    const double wire = pi / 4 * sheet.wire_diameter * sheet.wire_diameter;
    const double wires = std::round(sheet.cross_section / wire);
    if (wires < 1 || wires > most_wires)
      throw InputError(sheet.where,
                       fmt::format("{:.4g} mm2 of wires of {:.4g} mm are {:.4g} wires (1 .. {})",
                                   1e6 * sheet.cross_section, 1e3 * sheet.wire_diameter,
                                   sheet.cross_section / wire, most_wires),
                       "check cross_section_mm2, of one core, and wire_diameter_mm");
    pack_wires(static_cast<int>(wires));
    size_cores();
  }

  double radius() const { return sheet_.outer_diameter / 2; }

  std::vector<Component> components() const {
    const std::vector<Ring> rings = cabled(core_diameter_);
    const double part = group_diameter(core_diameter_);
    std::vector<Component> layers;
    for (std::size_t k = rings.size(); k-- > 0;) {  // the outermost is layer 1
      const Hand hand = (rings.size() - 1 - k) % 2 == 0 ? Hand::left : Hand::right;
      Component layer =
          part_of(grouped() ? group_name() : "core", rings, k, part, hand, line_load(part));
      layer.components = grouped() ? group(opposite(hand)) : wires(opposite(hand));
      layers.push_back(layer);
    }
    return layers;
  }

 private:
  static constexpr int most_wires = 5000;  // 400 mm2 of class 6

  static Hand opposite(Hand hand) { return hand == Hand::left ? Hand::right : Hand::left; }
  /// Of a jacket's pressure on this width [N/m]; absent: the sheet gives no pressure (estimates.h).
  std::optional<double> line_load(double width) const {
    return sheet_.jacket_pressure ? std::optional(*sheet_.jacket_pressure * width) : std::nullopt;
  }
  bool grouped() const { return sheet_.cores_per_group > 1; }
  std::string group_name() const { return sheet_.cores_per_group == 2 ? "pair" : "group"; }

  Component part_of(const std::string& name, const std::vector<Ring>& rings, std::size_t k, double diameter,
                    Hand hand, std::optional<double> line_load) const {
    Component part;
    part.name = name;
    if (rings.size() > 1) part.layer = fmt::format("layer {}", rings.size() - k);
    part.count = rings[k].count;
    part.radius = diameter / 2;
    part.helix_radius = rings[k].radius;
    part.lay_angle = rings[k].lay_angle;
    part.hand = hand;
    part.friction = sheet_.friction;
    part.radial_line_load = line_load;
    return part;
  }

  std::vector<Component> wires(Hand hand) const {
    std::vector<Component> layers;
    for (std::size_t k = wire_rings_.size(); k-- > 0;) {
      layers.push_back(part_of("wire", wire_rings_, k, sheet_.wire_diameter, hand,
                               line_load(estimated_wire_share * core_diameter_)));
      layers.back().material = sheet_.material;
    }
    return layers;
  }

  std::vector<Component> group(Hand hand) const {
    const std::vector<Ring> rings = twisted(core_diameter_);
    std::vector<Component> layers;
    for (std::size_t k = rings.size(); k-- > 0;) {
      layers.push_back(
          part_of("core", rings, k, core_diameter_, hand, line_load(core_diameter_)));
      layers.back().components = wires(opposite(hand));
    }
    return layers;
  }

  void pack_wires(int count) {
    const double straight = width_of(
        packed(count, sheet_.wire_diameter, infinite, Fillers::none, sheet_.where), sheet_.wire_diameter);
    wire_rings_ =
        packed(count, sheet_.wire_diameter, sheet_.wire_lay_length.value_or(wire_lay_ratio * straight),
               Fillers::none, sheet_.where);
    conductor_ = width_of(wire_rings_, sheet_.wire_diameter);
  }

  std::vector<Ring> laid(int count, double diameter, const std::optional<double>& lay_length) const {
    if (count == 1) return packed(1, diameter, infinite, Fillers::none, sheet_.where);
    const double straight =
        width_of(packed(count, diameter, infinite, Fillers::allowed, sheet_.where), diameter);
    return packed(count, diameter, lay_length.value_or(core_lay_ratio * straight), Fillers::allowed,
                  sheet_.where);
  }
  std::vector<Ring> twisted(double core) const {
    return laid(sheet_.cores_per_group, core, sheet_.group_lay_length);
  }
  double group_diameter(double core) const { return width_of(twisted(core), core); }
  std::vector<Ring> cabled(double core) const {
    return laid(sheet_.cores, group_diameter(core), sheet_.lay_length);
  }
  double cabled_width(double core) const { return width_of(cabled(core), group_diameter(core)); }

  void size_cores() {
    const double inside = sheet_.outer_diameter - 2 * sheet_.jacket_thickness.value_or(0);
    core_diameter_ = sheet_.core_diameter.value_or(0);
    if (!sheet_.core_diameter) {
      if (!sheet_.jacket_thickness)
        throw InputError(sheet_.where, "data_sheet has neither core_diameter_mm nor jacket_thickness_mm",
                         "give one of the two: it says how thick the insulation is");
      core_diameter_ = widest_core(inside);
    }
    if (conductor_ > core_diameter_ * (1 + touching))
      throw InputError(
          sheet_.where,
          fmt::format("{} wires of {:.4g} mm are a conductor {:.4g} mm wide (the core has {:.4g} mm)",
                      wire_count(), 1e3 * sheet_.wire_diameter, 1e3 * conductor_, 1e3 * core_diameter_),
          "check cross_section_mm2, of one core, the jacket's thickness and the diameters");
    if (const double width = cabled_width(core_diameter_); width > inside * (1 + slack_of_a_caliper))
      throw InputError(sheet_.where,
                       fmt::format("the cores make a bundle {:.4g} mm wide (the cable leaves {:.4g} mm)",
                                   1e3 * width, 1e3 * inside),
                       "check cores, core_diameter_mm, outer_diameter_mm and jacket_thickness_mm");
  }

  /// The bundle's width grows with that of a core, almost in proportion.
  double widest_core(double inside) const {
    if (!(inside > 0))
      throw InputError(sheet_.where,
                       fmt::format("the jacket of {:.4g} mm leaves no room in {:.4g} mm",
                                   1e3 * *sheet_.jacket_thickness, 1e3 * sheet_.outer_diameter),
                       "check jacket_thickness_mm");
    double core = inside / (sheet_.cores * sheet_.cores_per_group);
    for (int round = 0; round < rounds; ++round) core *= inside / cabled_width(core);
    return core;
  }

  int wire_count() const {
    int count = 0;
    for (const Ring& ring : wire_rings_) count += ring.count;
    return count;
  }

  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double slack_of_a_caliper = 0.02;  // as in a fit of a part into its parent

  DataSheet sheet_;
  std::vector<Ring> wire_rings_;
  double conductor_ = 0, core_diameter_ = 0;  // [m]
};

struct Layers {
  std::vector<Component> components;
};
void describe(Fields& f, Layers& layers) { f.list("components", layers.components, Need::required, ""); }

void expand(Node& component) {
  const Node* written = component.find("data_sheet");
  if (!written) return;
  for (const char* key : {"components", "material", "radius_mm"})
    if (const Node* other = component.find(key))
      throw InputError(other->where, fmt::format("both data_sheet and {} are given", key),
                       "keep one of the two");
  DataSheet sheet;
  sheet.where = written->where;
  read_fields(written->is_scalar() ? sheet_from_line(*written) : *written, sheet);
  const Expansion expansion(sheet);
  Node made = echo_fields(Layers{expansion.components()});
  made["radius_mm"] = scalar(text_in_unit(expansion.radius(), unit_of_key("radius_mm")));
  place_at(made, sheet.where);
  std::erase_if(component.entries, [](const Entry& entry) { return entry.key == "data_sheet"; });
  component.entries.insert(component.entries.end(), made.entries.begin(), made.entries.end());
}

/// In lower case, without space around it.
std::string plain(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return std::tolower(letter); });
  const std::size_t begin = text.find_first_not_of(" \t\n"), end = text.find_last_not_of(" \t\n");
  return begin == std::string::npos ? "" : text.substr(begin, end + 1 - begin);
}

constexpr const char* example_line =
    "7 x 0.5 mm2, class 6, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm, jacket PUR 1.1 mm";

/// The keys that one phrase of a sheet's line stands for.
std::vector<std::pair<const char*, std::string>> keys_of_phrase(const std::string& phrase,
                                                                const Where& where) {
  static const std::regex section(R"((\d+) *[x*] *(?:(\d+) *[x*] *)?([\d.]+) *mm(?:2|\^2|²))"),
      word_class("class *[1-6]"), length(R"(([a-z][a-z -]*?) *([\d.]+) *mm(?: *[a-z]+)?)");
  static const std::vector<std::pair<std::regex, const char*>> lengths{
      {std::regex("(single )?wires?( diameter)?"), "wire_diameter_mm"},
      {std::regex("(outer |outside )?diameter|od"), "outer_diameter_mm"},
      {std::regex("(jacket|sheath)( [a-z-]+)*"), "jacket_thickness_mm"},
      {std::regex("cores?( diameter)?"), "core_diameter_mm"},
      {std::regex("lay( length)?"), "lay_length_mm"},
      {std::regex("(pair|group) lay( length)?"), "group_lay_length_mm"},
      {std::regex("wire lay( length)?"), "wire_lay_length_mm"}};
  std::smatch found;
  if (std::regex_match(phrase, word_class)) return {};
  if (std::regex_match(phrase, found, section)) {
    std::vector<std::pair<const char*, std::string>> keys{{"cores", found[1]},
                                                          {"cross_section_mm2", found[3]}};
    if (found[2].matched) keys.emplace_back("cores_per_group", found[2]);
    return keys;
  }
  if (std::regex_match(phrase, found, length))
    for (const auto& [words, key] : lengths)
      if (std::regex_match(found[1].str(), words)) return {{key, found[2]}};
  throw InputError(
      where, fmt::format("'{}' of a data sheet is not understood", phrase),
      fmt::format("write phrases as in '{}', lengths in mm, or the keys of a data sheet", example_line));
}

}  // namespace

Node sheet_from_line(const Node& line) {
  Node sheet;
  sheet.kind = Node::Kind::map;
  std::string_view rest = line.text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::string phrase = plain(std::string(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    for (const auto& [key, value] : keys_of_phrase(phrase, line.where)) {
      if (sheet.find(key))
        throw InputError(line.where, fmt::format("'{}' tells {} a second time", phrase, key),
                         "keep one of the two");
      sheet[key] = scalar(value);
    }
  }
  place_at(sheet, line.where);
  return sheet;
}

void describe(Fields& f, DataSheet& sheet) {
  f.place(sheet.where);
  f.integer("cores", sheet.cores, Need::required, between(1, 200),
            "in the cable, or groups of them: the 7 of 7 x 0.5 mm2");
  f.integer("cores_per_group", sheet.cores_per_group, Need::optional, between(1, 8),
            "twisted together first: 2 of a cable of pairs, the second number of 4 x 2 x 0.25 mm2");
  f.number("cross_section_mm2", sheet.cross_section, Need::required, above(0),
           "nominal, of the metal of one core");
  f.number("wire_diameter_mm", sheet.wire_diameter, Need::required, above(0),
           "of the core's single wires; class 6 up to 4 mm2: at most 0.16");
  f.number("outer_diameter_mm", sheet.outer_diameter, Need::required, above(0), "of the cable");
  f.maybe_number(
      "jacket_thickness_mm", sheet.jacket_thickness, at_least(0),
      "with tapes and screens; what it leaves is filled by the cores if core_diameter_mm is not given");
  f.maybe_number("core_diameter_mm", sheet.core_diameter, above(0), "of a core over its insulation");
  f.maybe_number("lay_length_mm", sheet.lay_length, above(0),
                 "of the cores, or groups; without it 12 times their width");
  f.maybe_number("group_lay_length_mm", sheet.group_lay_length, above(0),
                 "of the cores in a group; without it 12 times the group's width");
  f.maybe_number("wire_lay_length_mm", sheet.wire_lay_length, above(0),
                 "of the wires in a core; without it 16 times the conductor's width");
  f.text("material", sheet.material, Need::optional, "of the wires, a name of config/materials");
  f.maybe_number("friction_coefficient", sheet.friction, between(0, 1e6),
                 "Coulomb, of cores and wires; without it 0.3, an ESTIMATE");
  f.maybe_number("jacket_pressure_MPa", sheet.jacket_pressure, at_least(0),
                 "on the cores, a fifth of a core's line load on each of its wires; without it 0.04, an ESTIMATE; "
                 "measured_bending_stiffness_Nm2 beside data_sheet sets their level");
}

std::vector<Ring> packed(int count, double diameter, double lay_length, Fillers fillers, const Where& where) {
  std::vector<Ring> best;
  const auto consider = [&](int middle, int first) {
    std::vector<Ring> rings = straight_rings(count, diameter, middle, first);
    const double gain = best.empty() ? 1 : width_of(best, diameter) - width_of(rings, diameter);
    const bool equal = std::abs(gain) <= touching * diameter;
    if (equal ? fullness(rings.back(), diameter) > fullness(best.back(), diameter) : gain > 0)
      best = std::move(rings);
  };
  const int widest = fillers == Fillers::allowed ? count : closed_ring;
  for (int first = 1; first <= std::min(count, widest); ++first) consider(0, first);
  for (int first = closed_ring + 1; first <= std::min(count - 1, filled_ring); ++first) consider(1, first);
  if (std::isinf(lay_length)) return best;
  double inner = 0;
  for (std::size_t k = 0; k < best.size(); ++k) {
    if (k > 0) best[k].radius = std::max(best[k].radius, inner + diameter);
    if (best[k].radius > 0) lay(best[k], diameter, lay_length, where);
    inner = best[k].radius;
  }
  return best;
}

double width_of(const std::vector<Ring>& rings, double diameter) {
  return 2 * rings.back().radius + diameter;
}

void expand_data_sheets(Node& dresspack) {
  Problems problems;
  expand_data_sheets(dresspack, "", problems);
  problems.finish(dresspack.where.file);
}

void expand_data_sheets(Node& dresspack, const std::string& path, Problems& problems) {
  Node* components = dresspack.is_map() ? dresspack.find("components") : nullptr;
  if (!components || !components->is_list()) return;
  for (std::size_t i = 0; i < components->items.size(); ++i) {
    Node& component = components->items[i];
    if (!component.is_map()) continue;
    const std::string item = fmt::format("{}{}components[{}]", path, path.empty() ? "" : ".", i + 1);
    if (problems.attempt(item, component.where, [&] { expand(component); }))
      expand_data_sheets(component, item, problems);
  }
}

}  // namespace dresslife::pipeline
