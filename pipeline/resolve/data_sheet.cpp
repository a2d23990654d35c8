#include "pipeline/resolve/data_sheet.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <regex>
#include <string_view>

#include "pipeline/base/constants.h"
#include "pipeline/base/halving.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/resolve/cable_rules.h"
#include "pipeline/resolve/estimates.h"
#include "pipeline/resolve/placement.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

constexpr double touching = 1e-9;      // relative to the diameter: six parts around one of equal diameter touch
constexpr double steepest = pi / 3;    // largest lay angle of a component
constexpr int closed_ring = 5;         // six parts that touch have space for a seventh in the middle
constexpr int filled_ring = 9;         // ten parts have space for two
constexpr double wire_lay_ratio = 16;  // lay length / width of the conductor: stranding has 10 to 20
constexpr double core_lay_ratio = 12;  // lay length / width of the cores: flexible cables have 8 to 16
constexpr int fewest_wires =
    7;  // of a flexible conductor; IEC 60228 has solid ones (class 1) and 7 thick wires (class 2) for fixed laying
constexpr double section_tolerance = 0.25;  // a standard's nominal section is rounded: 0.22 for 7 x 0.2 mm
// Core / conductor: control cables have 1.5 to 3, those for 1 kV up to 4; data sheets round by up to 5 %.
constexpr double thickest_insulation = 4.2;
constexpr double thinnest_insulation = 50e-6;  // [m]: signal cables have 0.15 mm and more
constexpr int rounds = 60;                     // of the bisection for the cores' diameter

double first_radius(int count, double diameter) { return count == 1 ? 0 : diameter / (2 * std::sin(pi / count)); }

int room_in(double radius, double diameter) {
  return static_cast<int>(std::floor(pi / std::asin(diameter / (2 * radius)) + touching));
}

/// Returns straight rings around nothing, around a filler, or around one part of equal size in the `middle`.
std::vector<CoreRing> straight_rings(int count, double diameter, int middle, int first) {
  std::vector<CoreRing> rings;
  if (middle > 0) rings.push_back({1, 0, 0});
  rings.push_back({first, first_radius(first, diameter), 0});
  for (count -= middle + first; count > 0; count -= rings.back().count) {
    const double radius = rings.back().radius + diameter;
    rings.push_back({std::min(count, room_in(radius, diameter)), radius, 0});
  }
  return rings;
}

double fullness(const CoreRing& outer, double diameter) {
  return outer.radius == 0 ? 1 : static_cast<double>(outer.count) / room_in(outer.radius, diameter);
}

double lay_angle_at(double radius, double lay_length) { return std::atan(2 * pi * radius / lay_length); }

/// Returns "give a longer lay, or 68.2 mm if 12 is the lay angle in degrees".
std::string longer_lay(double radius, double lay_length) {
  constexpr double least = 5, most = 45;  // [deg] of cores in cables
  const double number = 1e3 * lay_length;
  return number >= least && number <= most
             ? fmt::format("give a longer lay, or {:.3g} mm if {:.4g} is the lay angle in degrees",
                           1e3 * 2 * pi * radius / std::tan(number * pi / 180), number)
             : "give a longer lay";
}

/// Widens a ring until its parts fit beside each other with their lay.
void widen(CoreRing& ring, double diameter, double lay_length, const Where& where) {
  ring.lay_angle = lay_angle_at(ring.radius, lay_length);
  const auto fits = [&](double radius) {
    return neighbour_distance(radius, lay_angle_at(radius, lay_length), ring.count) >= diameter * (1 - touching);
  };
  if (ring.count > 1 && !fits(ring.radius)) {
    const double largest = std::tan(steepest) * lay_length / (2 * pi);
    if (largest <= ring.radius || !fits(largest))
      throw InputError(where,
                       fmt::format("{} parts of {:.4g} mm do not lie beside each other on a lay of {:.4g} mm",
                                   ring.count, 1e3 * diameter, 1e3 * lay_length),
                       longer_lay(ring.radius, lay_length));
    ring.radius = halved(ring.radius, largest, 50, [&](double radius) { return !fits(radius); }).high;
    ring.lay_angle = lay_angle_at(ring.radius, lay_length);
  }
  if (ring.lay_angle > steepest)
    throw InputError(where,
                     fmt::format("a lay of {:.4g} mm winds parts {:.4g} mm off the axis by {:.0f} deg (at most 60)",
                                 1e3 * lay_length, 1e3 * ring.radius, ring.lay_angle * 180 / pi),
                     longer_lay(ring.radius, lay_length));
}

/// Builds the layers of a sheet, from the wire outwards.
class Expansion {
 public:
  Expansion(const DataSheet& given, double lay_factor)
      : sheet_(with_class(given)),
        wire_(wire_of(sheet_)),
        has_class_(given.conductor_class > 0),
        lay_factor_(lay_factor) {
    const DataSheet& sheet = sheet_;
    const double section = pi / 4 * wire_ * wire_;
    const double wires = std::round(sheet.cross_section / section);
    if (wires < 1 || wires > most_wires)
      throw InputError(sheet.where,
                       fmt::format("{:.4g} mm2 of wires of {:.4g} mm are {:.4g} wires (1 .. {})",
                                   1e6 * sheet.cross_section, 1e3 * wire_, sheet.cross_section / section, most_wires),
                       "check cross_section_mm2, of one core, and wire_diameter_mm");
    if (std::abs(wires * section / sheet.cross_section - 1) > section_tolerance)
      throw InputError(
          sheet.where,
          fmt::format("{:.4g} mm2 are {:.3g} wires of {:.4g} mm (a whole number within {:g} %)",
                      1e6 * sheet.cross_section, sheet.cross_section / section, 1e3 * wire_, 100 * section_tolerance),
          "check cross_section_mm2, of one core, and wire_diameter_mm");
    if (wires < fewest_wires)
      throw InputError(sheet.where,
                       fmt::format("{:.4g} mm2 are {:g} wire{} of {:.4g} mm (flexible conductors have {} and more)",
                                   1e6 * sheet.cross_section, wires, wires == 1 ? "" : "s", 1e3 * wire_, fewest_wires),
                       fmt::format("give the wire's diameter, not the conductor's{}",
                                   thickest_wire(fine_class, sheet.cross_section) == 0
                                       ? ""
                                       : fmt::format("; class 6 has wire_diameter_mm: {:.3g}",
                                                     1e3 * usual_wire(fine_class, sheet.cross_section))));
    pack_wires(static_cast<int>(wires));
    size_cores();
  }

  double radius() const { return outer_ / 2; }
  /// Returns the jacket whose wear is known; std::nullopt if the sheet has no material for it.
  std::optional<Sleeve> jacket() const {
    if (sheet_.jacket_material.empty() || jacket_ <= 0) return {};
    return Sleeve{jacket_, sheet_.jacket_material, {}};
  }

  /// Returns the lengths that come from rules: "wire 0.15 mm, jacket 1.21 mm"; empty: none.
  std::string estimates() const { return ruled(false); }

  /// Returns all missing keys that a life depends on, with their values: "conductor_class 6, wire_diameter_mm 0.15".
  std::string estimated_keys() const { return ruled(true); }

  std::vector<Component> components() const {
    const std::vector<CoreRing> rings = cabled(core_diameter_);
    const double part = group_diameter(core_diameter_);
    std::vector<Component> layers;
    for (std::size_t k = rings.size(); k-- > 0;) {  // the outermost ring is layer 1
      const Hand hand = (rings.size() - 1 - k) % 2 == 0 ? Hand::left : Hand::right;
      Component layer = part_of(grouped() ? group_name() : "core", rings, k, part, hand, line_load(part));
      layer.components = grouped() ? group(opposite(hand)) : wires(opposite(hand));
      layers.push_back(layer);
    }
    return layers;
  }

 private:
  /// A length that the sheet may lack and that then comes from a rule.
  struct Ruled {
    const char* words;  ///< its name in estimates(); empty: not listed there
    const char* key;
    bool given;
    double value;
  };
  /// Returns the effect of the coarser class. If the strain of a wire is proportional to its diameter, lives go with about its fifth
  /// power. In tests in which wires slide, the ratio is smaller (config/defaults.md).
  std::string of_thicker_wires() const {
    constexpr double exponent = 5;
    if (thickest_wire(flexible_class, sheet_.cross_section) == 0) return "";
    const double wire = usual_wire(flexible_class, sheet_.cross_section), times = std::pow(wire / wire_, exponent);
    return times < 2
               ? ""
               : fmt::format(" (class {} has wires of {:.3g} mm: lives in bending 2 to about {:.0f} times shorter)",
                             flexible_class, 1e3 * wire, times);
  }
  std::string ruled(bool as_keys) const {
    std::vector<std::string> parts;
    if (!has_class_ && sheet_.conductor_class > 0)
      parts.push_back(as_keys ? fmt::format("conductor_class {}{}", sheet_.conductor_class, of_thicker_wires())
                              : fmt::format("conductor class {}", sheet_.conductor_class));
    for (const Ruled& of : std::vector<Ruled>{
             {"wire", "wire_diameter_mm", sheet_.wire_diameter.has_value(), wire_},
             {"core", "core_diameter_mm", sheet_.core_diameter || sheet_.jacket_thickness, core_diameter_},
             {"jacket", "jacket_thickness_mm",
              sheet_.jacket_thickness || (sheet_.core_diameter && sheet_.outer_diameter), jacket_},
             {"outer diameter", "outer_diameter_mm", sheet_.outer_diameter.has_value(), outer_},
             {"", "lay_length_mm", sheet_.lay_length || sheet_.cores == 1,
              usual_lay(sheet_.cores, group_diameter(core_diameter_))},
             {"", "group_lay_length_mm", sheet_.group_lay_length || !grouped(),
              usual_lay(sheet_.cores_per_group, core_diameter_)},
             {"", "wire_lay_length_mm", sheet_.wire_lay_length || wire_count() == 1, wire_lay_}})
      if (!of.given && (as_keys || *of.words))
        parts.push_back(as_keys ? fmt::format("{} {:.3g}", of.key, 1e3 * of.value)
                                : fmt::format("{} {:.3g} mm", of.words, 1e3 * of.value));
    return fmt::format("{}", fmt::join(parts, ", "));
  }
  static constexpr int most_wires = 5000;  // 400 mm2 of class 6

  /// Sets the finest class, which is usual for moving cables, if the sheet has neither class nor wire.
  static DataSheet with_class(DataSheet sheet) {
    if (!sheet.conductor_class && !sheet.wire_diameter) sheet.conductor_class = fine_class;
    return sheet;
  }
  /// Returns the diameter of a wire: given, otherwise from the class. Errors: InputError for a class without this section, or a
  /// wire that is too thick for its class.
  static double wire_of(const DataSheet& sheet) {
    if (!sheet.conductor_class) return *sheet.wire_diameter;
    if (sheet.conductor_class < flexible_class)
      throw InputError(sheet.where,
                       fmt::format("conductor_class is {} (classes 1 to 4 of IEC 60228 are for cables that lie still)",
                                   sheet.conductor_class),
                       "give 5 or 6, or wire_diameter_mm without the class");
    const double most = thickest_wire(sheet.conductor_class, sheet.cross_section);
    if (most == 0)
      throw InputError(sheet.where,
                       fmt::format("cross_section_mm2 is {:.4g} (IEC 60228 has no conductor of class {} so large)",
                                   1e6 * sheet.cross_section, sheet.conductor_class),
                       "check cross_section_mm2, of one core, or give wire_diameter_mm without the class");
    if (sheet.wire_diameter && *sheet.wire_diameter > most)
      throw InputError(
          sheet.where,
          fmt::format("wire_diameter_mm is {:.4g} (class {} has wires of {:.4g} mm at most at {:.4g} mm2)",
                      1e3 * *sheet.wire_diameter, sheet.conductor_class, 1e3 * most, 1e6 * sheet.cross_section),
          "check both, or leave out the class");
    return sheet.wire_diameter.value_or(usual_wire(sheet.conductor_class, sheet.cross_section));
  }

  static Hand opposite(Hand hand) { return hand == Hand::left ? Hand::right : Hand::left; }
  /// Returns the line load of a jacket's pressure on this width [N/m]; std::nullopt: the sheet has no pressure (estimates.h).
  std::optional<double> line_load(double width) const {
    return sheet_.jacket_pressure ? std::optional(*sheet_.jacket_pressure * width) : std::nullopt;
  }
  bool grouped() const { return sheet_.cores_per_group > 1; }
  std::string group_name() const { return sheet_.cores_per_group == 2 ? "pair" : "group"; }

  Component part_of(const std::string& name, const std::vector<CoreRing>& rings, std::size_t k, double diameter,
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
      layers.push_back(part_of("wire", wire_rings_, k, wire_, hand, line_load(wire_)));
      layers.back().material = sheet_.material;
    }
    return layers;
  }

  std::vector<Component> group(Hand hand) const {
    const std::vector<CoreRing> rings = twisted(core_diameter_);
    std::vector<Component> layers;
    for (std::size_t k = rings.size(); k-- > 0;) {
      layers.push_back(part_of("core", rings, k, core_diameter_, hand, line_load(core_diameter_)));
      layers.back().components = wires(opposite(hand));
    }
    return layers;
  }

  void pack_wires(int count) {
    const double straight = width_of(packed(count, wire_, infinite, Fillers::none, sheet_.where), wire_);
    wire_lay_ = sheet_.wire_lay_length.value_or(lay_factor_ * wire_lay_ratio * straight);
    wire_rings_ = packed(count, wire_, wire_lay_, Fillers::none, sheet_.where);
    conductor_ = width_of(wire_rings_, wire_);
  }

  std::vector<CoreRing> rings_of(int count, double diameter, const std::optional<double>& lay_length) const {
    if (count == 1) return packed(1, diameter, infinite, Fillers::none, sheet_.where);
    return packed(count, diameter, lay_length.value_or(usual_lay(count, diameter)), Fillers::allowed, sheet_.where);
  }
  double usual_lay(int count, double diameter) const {
    return lay_factor_ * core_lay_ratio *
           width_of(packed(count, diameter, infinite, Fillers::allowed, sheet_.where), diameter);
  }
  std::vector<CoreRing> twisted(double core) const {
    return rings_of(sheet_.cores_per_group, core, sheet_.group_lay_length);
  }
  double group_diameter(double core) const { return width_of(twisted(core), core); }
  std::vector<CoreRing> cabled(double core) const {
    return rings_of(sheet_.cores, group_diameter(core), sheet_.lay_length);
  }
  double cabled_width(double core) const { return width_of(cabled(core), group_diameter(core)); }

  void size_cores() {
    const bool by_rule = sheet_.conductor_class > 0;
    if (!sheet_.outer_diameter && !by_rule)
      throw InputError(sheet_.where, "data_sheet has no outer_diameter_mm",
                       "give it, or conductor_class (IEC 60228), by which it is estimated");
    if (!sheet_.core_diameter && !sheet_.jacket_thickness && !by_rule)
      throw InputError(
          sheet_.where, "data_sheet has neither core_diameter_mm nor jacket_thickness_mm",
          "give one of the two: it says how thick the insulation is; or conductor_class (IEC 60228), by which "
          "the jacket is estimated");
    if (!sheet_.outer_diameter) {  // computed from the inside outwards
      core_diameter_ = sheet_.core_diameter.value_or(conductor_ + 2 * usual_insulation(sheet_.cross_section));
      const double bundle = cabled_width(core_diameter_);
      jacket_ = sheet_.jacket_thickness.value_or(usual_jacket(bundle));
      outer_ = bundle + 2 * jacket_;
      return check_conductor();
    }
    outer_ = *sheet_.outer_diameter;
    const double inside = sheet_.jacket_thickness || sheet_.core_diameter
                              ? outer_ - 2 * sheet_.jacket_thickness.value_or(0)
                              : bundle_in(outer_);
    jacket_ = sheet_.jacket_thickness.value_or(0);
    core_diameter_ = sheet_.core_diameter ? *sheet_.core_diameter : widest_core(inside);
    check_conductor();
    const double width = cabled_width(core_diameter_);
    if (!sheet_.jacket_thickness) jacket_ = std::max(0.0, (outer_ - width) / 2);
    if (width > inside * (1 + slack_of_a_caliper))
      throw InputError(
          sheet_.where,
          fmt::format("the cores make a bundle {:.4g} mm wide (the cable leaves {:.4g} mm)", 1e3 * width, 1e3 * inside),
          "check cores, core_diameter_mm, outer_diameter_mm and jacket_thickness_mm");
  }

  void check_conductor() const {
    if (conductor_ > core_diameter_ * (1 + touching))
      throw InputError(sheet_.where,
                       fmt::format("{} wires of {:.4g} mm are a conductor {:.4g} mm wide (the core has {:.4g} mm)",
                                   wire_count(), 1e3 * wire_, 1e3 * conductor_, 1e3 * core_diameter_),
                       contradiction() +
                           (fitting_gauge().empty() ? fitting_section() + fitting_diameter() : fitting_gauge()) +
                           "check cross_section_mm2, of one core, the jacket's thickness and the diameters");
    if (core_diameter_ < conductor_ + 2 * thinnest_insulation)
      throw InputError(
          sheet_.where,
          fmt::format(
              "a core is {:.4g} mm wide, which leaves {:.3g} mm of insulation around its conductor of {:.3g} mm (limit {:g} mm)",
              1e3 * core_diameter_, 5e2 * (core_diameter_ - conductor_), 1e3 * conductor_, 1e3 * thinnest_insulation),
          fitting_diameter() + "check the diameters, jacket_thickness_mm and cross_section_mm2, of one core");
    if (!sheet_.core_diameter && core_diameter_ > thickest_insulation * conductor_)
      throw InputError(
          sheet_.where,
          fmt::format(
              "by the outer diameter and the jacket a core is {:.3g} mm wide, {:.2g} times its conductor of {:.3g} mm (limit {:g} "
              "times)",
              1e3 * core_diameter_, core_diameter_ / conductor_, 1e3 * conductor_, thickest_insulation),
          fmt::format(
              "{}check outer_diameter_mm: {:.4g} and cross_section_mm2, of one core, or give core_diameter_mm if the rest is filler",
              fitting_diameter(), 1e3 * outer_));
  }

  /// Returns "4 cores of 10 mm2 need a cable 16 mm wide by EN 50525, and outer_diameter_mm is 11.5: correct one of the three numbers; ";
  /// empty if the diameters of the sheet do not follow from the outer diameter.
  std::string contradiction() const {
    if (!sheet_.outer_diameter || sheet_.core_diameter) return "";
    double bundle = 0;
    try {
      bundle = cabled_width(conductor_ + 2 * usual_insulation(sheet_.cross_section));
    } catch (const InputError&) {  // such cores do not fit with the given lay
      return "";
    }
    return fmt::format(
        "{} cores of {:.4g} mm2 need a cable about {:.3g} mm wide by EN 50525, and outer_diameter_mm is {:.4g}: correct one "
        "of the three numbers; ",
        sheet_.cores * sheet_.cores_per_group, 1e6 * sheet_.cross_section,
        1e3 * (bundle + 2 * sheet_.jacket_thickness.value_or(usual_jacket(bundle))), 1e3 * outer_);
  }

  /// Returns "give outer_diameter_mm: 8.2 if the decimal point was lost; " for 82 or 0.82, and for 0.0082 in metres: the diameter
  /// times the power of ten that fits the cores; otherwise an empty text.
  std::string fitting_diameter() const {
    if (!sheet_.outer_diameter || sheet_.core_diameter) return "";
    struct Slip {
      double factor;
      const char* cause;
    };
    for (const Slip& slip : {Slip{0.1, "a decimal point was lost"}, Slip{10, "that was centimetres"},
                             Slip{1e3, "that was metres"}, Slip{0.01, "two zeros are too many"}}) {
      const double outer = slip.factor * outer_, inside = outer - 2 * sheet_.jacket_thickness.value_or(0);
      if (inside > 0 && holds_cores(inside))
        return fmt::format("give outer_diameter_mm: {:.4g} if {}; ", 1e3 * outer, slip.cause);
    }
    return "";
  }

  /// Returns whether cores that fill this width have a usual insulation.
  bool holds_cores(double inside) const {
    try {
      const double core = core_in(inside);
      return core > conductor_ && core <= thickest_insulation * conductor_;
    } catch (const InputError&) {  // the cores do not fit with their lay
      return false;
    }
  }

  /// Returns "give cross_section_mm2: 0.519 if 20 is an AWG; " if the section of that gauge fits the core; otherwise an empty
  /// text.
  std::string fitting_gauge() const {
    const double number = 1e6 * sheet_.cross_section;               // [mm2]
    constexpr double coarsest = 4, finest = 36;                     // gauges of cables
    constexpr std::array metric{4.0, 6.0, 10.0, 16.0, 25.0, 35.0};  // [mm2] of IEC 60228, which are no gauges
    if (number != std::floor(number) || number < coarsest || number > finest ||
        std::ranges::find(metric, number) != metric.end())
      return "";
    const double share = square_mm_of_awg(number) / number, conductor = conductor_ * std::sqrt(share);
    return conductor < core_diameter_ && core_diameter_ <= thickest_insulation * conductor
               ? fmt::format("give cross_section_mm2: {:.3g} if {:g} is a wire gauge (AWG); ", square_mm_of_awg(number),
                             number)
               : "";
  }

  /// Returns "give cross_section_mm2: 0.25 if a decimal point was lost; " if a tenth or a hundredth of the section fits the core;
  /// otherwise an empty text.
  std::string fitting_section() const {
    for (const double share : {0.1, 0.01})
      if (const double conductor = conductor_ * std::sqrt(share);
          conductor < core_diameter_ && core_diameter_ <= thickest_insulation * conductor)
        return fmt::format("give cross_section_mm2: {:.4g} if a decimal point was lost; ",
                           1e6 * share * sheet_.cross_section);
    return "";
  }

  /// Returns the largest diameter of a core in this width. The bundle's width increases with it, almost in proportion.
  double widest_core(double inside) const {
    if (!(inside > 0))
      throw InputError(sheet_.where,
                       fmt::format("the jacket of {:.4g} mm leaves no room in {:.4g} mm", 1e3 * jacket_, 1e3 * outer_),
                       fitting_diameter() + "check jacket_thickness_mm");
    return core_in(inside);
  }
  double core_in(double inside) const {
    double core = inside / (sheet_.cores * sheet_.cores_per_group);
    for (int round = 0; round < rounds; ++round) core *= inside / cabled_width(core);
    return core;
  }

  int wire_count() const { return sum_of(wire_rings_, &CoreRing::count, 0); }

  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double slack_of_a_caliper = 0.02;  // tolerance of a fit of a part into its parent

  DataSheet sheet_;
  double wire_, outer_ = 0, jacket_ = 0;  // [m]
  bool has_class_;                        // given by the sheet itself
  double lay_factor_;                     // of lay lengths that the sheet leaves out
  std::vector<CoreRing> wire_rings_;
  double conductor_ = 0, core_diameter_ = 0, wire_lay_ = 0;  // [m]
};

struct Layers {
  std::vector<Component> components;
  std::optional<Sleeve> jacket;
};
void describe(Fields& f, Layers& layers) {
  f.list("components", layers.components, Need::required, "");
  f.maybe_group("jacket", layers.jacket, "");
}

/// Missing values in the sheets of a dresspack.
struct LeftOut {
  std::vector<std::string> by_rules;  ///< for the source of the dresspack
  std::vector<std::string> keys;      ///< for dresspack.estimates
  double lay_factor = 1;              ///< dresspack.estimated_lay_factor
};

void expand(Node& component, LeftOut& left_out) {
  const Node* written = component.find("data_sheet");
  if (!written) return;
  for (const char* key : {"components", "material", "radius_mm"})
    if (const Node* other = component.find(key))
      throw InputError(other->where, fmt::format("both data_sheet and {} are given", key), "keep one of the two");
  DataSheet sheet;
  sheet.where = written->where;
  const Node keys = written->is_scalar() ? sheet_from_line(*written) : *written;
  read_fields(keys, sheet);
  const Expansion expansion(sheet, left_out.lay_factor);
  const Node* const named = component.find("name");
  const std::string name = named ? named->text : "cable";
  if (const std::string estimates = expansion.estimates(); !estimates.empty())
    left_out.by_rules.push_back(fmt::format("{} {}", name, estimates));
  std::string estimated = expansion.estimated_keys();
  if (!keys.find("material")) estimated += (estimated.empty() ? "" : ", ") + ("material " + sheet.material);
  if (!sheet.unused.empty()) estimated += (estimated.empty() ? "" : ", ") + ("without effect: " + sheet.unused);
  if (!sheet.shield.empty())
    estimated +=
        fmt::format("{}{}: the shield's wires are not evaluated, and its thickness counts as that of the jacket",
                    estimated.empty() ? "" : ", ", sheet.shield);
  if (!estimated.empty()) left_out.keys.push_back(fmt::format("data_sheet of {}: {}", name, estimated));
  Node made = echo_fields(Layers{expansion.components(), component.find("jacket") ? std::nullopt : expansion.jacket()});
  made["radius_mm"] = scalar(text_in_unit(expansion.radius(), unit_of_key("radius_mm")));
  place_at(made, sheet.where);
  std::erase_if(component.entries, [](const Entry& entry) { return entry.key == "data_sheet"; });
  component.entries.insert(component.entries.end(), made.entries.begin(), made.entries.end());
}

/// Returns a text in lower case without spaces at both ends.
std::string plain(const std::string& text) { return lower_case(trimmed(text)); }

constexpr const char* example_line =
    "7 x 0.5 mm2, class 6, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm, jacket PUR 1.1 mm";

/// Returns "write '4 x 2 x 0.129 mm2, wire 0.153 mm' for AWG 26 of 7 wires" for 4x2xAWG26/7, "write '4 x 2.5 mm2'" for
/// 2.5 x 4 mm2 and 4 x 2.5 mm; otherwise an empty text.
std::string meant_section(const std::string& phrase) {
  static const std::regex gauge(
      R"((?:(\d+)(?: *[x*g] *| +|(?=awg))(?:\(? *(\d+) *[x*] *)?)?(?:awg *(\d{1,2})|(\d{1,2}) *awg)(?: */ *([1-9]\d{0,3}))? *\)?)"),
      other_unit(R"((\d+(?: *[x*] *\d+)?) *[x*g] *([\d.]+) *(?:mm)?)"),
      exchanged(R"((\d*\.\d+) *[x*g] *(\d+) *(?:mm2|mm\^2|mm²|qmm|sqmm|mm)?)");
  std::smatch found;
  if (std::regex_match(phrase, found, gauge)) {
    const std::string number = found[3].matched ? found[3] : found[4];
    const double section = square_mm_of_awg(std::stod(number));
    std::string wire, of_wires;
    if (found[5].matched) {
      wire = fmt::format(", wire {:.3g} mm", 2 * std::sqrt(section / std::stod(found[5]) / pi));
      of_wires = fmt::format(" of {} wires", found[5].str());
    }
    return fmt::format("write '{} x {}{:.3g} mm2{}' for AWG {}{}{}", found[1].matched ? found[1].str() : "CORES",
                       found[2].matched ? found[2].str() + " x " : "", section, wire, number, of_wires,
                       found[1].matched ? "" : ", with the number of cores");
  }
  if (phrase.find("awg") != std::string::npos)
    return "write 'CORES x N mm2' with the number of cores and the cross-section of this gauge (AWG) in mm2";
  if (std::regex_match(phrase, found, exchanged))
    return fmt::format("write '{} x {} mm2': the number of cores comes first", found[2].str(), found[1].str());
  if (!std::regex_match(phrase, found, other_unit)) return "";
  constexpr double thick_wire = 0.5;  // [mm] of flexible conductors
  return fmt::format("write '{} x {} mm2'", found[1].str(), found[2].str()) +
         (std::strtod(found[2].str().c_str(), nullptr) < thick_wire
              ? fmt::format(", or 'wire {} mm' if those are the wires of a core", found[2].str())
              : "");
}

/// Returns the name of config/materials for "jacket pur 1.1 mm"; empty: unknown.
std::string jacket_material(const std::string& phrase) {
  static const std::vector<std::pair<std::regex, const char*>> materials{
      {std::regex(R"(\b(pur|tpu|polyurethane)\b)"), "polyurethane"},
      {std::regex(R"(\bpvc\b)"), "pvc"},
      {std::regex(R"(\btpe\b)"), "tpe"}};
  for (const auto& [word, material] : materials)
    if (std::regex_search(phrase, word)) return material;
  return "";
}

/// Returns the words of "outer jacket purr" that name neither the jacket, nor its place, nor a known material; empty: none.
std::string unknown_material(const std::string& words) {
  static const std::regex own(R"(\b(outer|outside|inner|jacket|sheath|material|wall|thickness|thick|of|the)\b)"),
      space(" +"),
      without_wear_rate(
          R"(\b(pe|hdpe|ldpe|xlpe|pp|pa|nylon|polyamide|silicone?|rubber|neoprene|cr|nbr|epr|epdm|hypalon|csm|)"
          R"(fep|pfa|ptfe|etfe|lszh|lsoh|frnc|hffr|halogen|free|black|grey|gray|orange|green|blue|yellow)\b)");
  std::string rest =
      std::regex_replace(std::regex_replace(std::regex_replace(words, own, ""), without_wear_rate, ""), space, " ");
  rest.erase(0, rest.find_first_not_of(" -"));
  return rest.substr(0, rest.find_last_not_of(" -") + 1);
}

/// Refuses an unknown material, because without it the wear of the jacket would not be evaluated. Errors: InputError.
void refuse_unknown_material(const std::string& words, const Where& where) {
  if (const std::string unknown = unknown_material(words); !unknown.empty())
    throw InputError(where, fmt::format("the jacket's material '{}' of a data sheet is not known", unknown),
                     "write PUR, PVC or TPE; of another material the thickness alone, and its wear is not evaluated");
}

/// Replaces decimal commas by points: "12 x 0,25 mm2, OD 9,5 mm". A comma behind a unit, or before a number of cores, is a
/// separator.
std::string with_points(const std::string& text) {
  static const std::regex comma(R"((^|[^a-zA-Z0-9.²^]|\d[gGxX])(\d+),(\d+)(?![\d.]* *[xX*]))");
  return std::regex_replace(text, comma, "$1$2.$3");
}

/// Replaces the words of German data sheets.
std::string in_english(std::string phrase) {
  static const std::vector<std::pair<std::regex, const char*>> words{
      {std::regex("klasse"), "class"},
      {std::regex("(au(ß|ss)en)?durchmesser"), "outer diameter"},
      {std::regex("(au(ß|ss)en)?mantel"), "jacket"},
      {std::regex("schlagl(ä|ae)nge"), "lay length"},
      {std::regex("geschirmt"), "shielded"},
      {std::regex("feindr(ä|ae)htig"), "fine wire"}};
  for (const auto& [german, english] : words) phrase = std::regex_replace(phrase, german, english);
  return phrase;
}

/// Words for a shield.
const std::string shield_words =
    R"((?:(?:with |and )?(?:(?:braid|braided|copper|cu|overall|foil|tinned|aluminium|al)[ -]*)*(?:shield|screen|braid)(?:ed|ing)?|\(c\)))";

bool is_shield(const std::string& phrase) {
  static const std::regex words(shield_words + ".*");
  return std::regex_match(phrase, words);
}

/// Divides "4 x 2 x 0.25 mm2 shielded class 6" into its phrases.
std::vector<std::string> phrases_of(const std::string& phrase) {
  static const std::regex at_end("(.*?[^ ]) +(un(?:shielded|screened)|" + shield_words + ")"),
      section_and_class(R"((\d.*[^ ]) +(class *[1-6]))");
  std::smatch found;
  if (is_shield(phrase) ||
      (!std::regex_match(phrase, found, at_end) && !std::regex_match(phrase, found, section_and_class)))
    return {phrase};
  std::vector<std::string> phrases = phrases_of(found[1]);
  phrases.push_back(found[2]);
  return phrases;
}

/// Returns whether a phrase of shops and standards has no effect on a life.
bool changes_nothing(const std::string& phrase) {
  static const std::vector<std::regex> words{
      std::regex(R"(un(shielded|screened))"),
      std::regex(
          R"((highly |extra |extremely |very |super )?flex(ible)?( cable)?|stranded|fine wire|tinned( copper)?|bare copper|copper|cu)"),
      std::regex(
          R"((for )?(drag|energy|cable)[ -]?(chains?|tracks?|carriers?)( (cable|suitable|rated))?|robot(ic|ics)?( cable)?|torsion( cable)?|chainflex.*)"),
      std::regex(R"((ul|csa|cul|vde|ce|din|iec|en|awm|dnv|rohs|reach)([ /-].*)?)"),
      std::regex(
          R"((halogen|silicone|pvc|lsoh|lszh)[ -]?free|lszh|flame[ -]retardant|(oil|uv|abrasion|weld spatter)[ -]resistant)"),
      std::regex(
          R"((rated )?(voltage )?[\d./ ]+ *k?v( ac| dc)?|-?\d+ *(\.\.|to|\+|/)+ *\+?-?\d+ *(deg|°)? *c|temperature.*)"),
      std::regex(
          R"((insulation|core insulation|cores?) *:? *(pvc|tpe|pp|pe|pur|etfe|xlpe)|(black|grey|gray|orange|green|blue|yellow|colou?r.*|numbered.*))")};
  return std::ranges::any_of(words, [&](const std::regex& of) { return std::regex_match(phrase, of); });
}

/// Returns a remedy for a phrase that belongs to a key outside of the data sheet: "leave it out and give least_bend_radius_mm: 80
/// of the dresspack"; otherwise an empty text.
std::string other_key(const std::string& phrase) {
  static const std::regex bend(R"((min(imum)?\.? *)?bend(ing)? *radius.*)"), number(R"((\d[\d.]*) *mm)"),
      mass(R"((?:mass|weight)? *:? *(\d{1,9}(?:\.\d+)?) *kg */ *km)"),
      cycles(R"(.*(cycles|million|bends|strokes|torsion).*)");
  std::smatch found;
  if (std::regex_match(phrase, bend)) {
    std::string radius = " in mm";
    if (std::regex_search(phrase, found, number)) radius = ": " + found[1].str();
    return fmt::format("leave it out and give the dresspack least_bend_radius_mm{} if no part needs a larger one",
                       radius);
  }
  if (std::regex_match(phrase, found, mass))
    return fmt::format("leave it out and give mass_kg_per_m: {:.4g} beside data_sheet", std::stod(found[1]) / 1e3);
  if (std::regex_match(phrase, cycles)) return "leave it out and give the maker's test as ratings beside data_sheet";
  return "";
}

/// Returns the keys and values of one phrase of a sheet's line.
std::vector<std::pair<const char*, std::string>> keys_of_phrase(const std::string& phrase, const Where& where) {
  // 4 x 2.5 mm2 and 4 x (2 x 0.25) mm2; in shops also 3x1.5 qmm, and 4G2.5 with the protective conductor as one of the four.
  static const std::regex section(R"((\d+) *[x*] *(?:\(? *(\d+) *[x*] *)?([\d.]+) *\)? *(?:mm2|mm\^2|mm²|qmm|sqmm))"),
      with_earth(R"((\d+) *g *([\d.]+) *(?:mm2|mm\^2|mm²|qmm|sqmm)?)"),
      word_class("(?:(?:extra |super )?fine(?:ly)?[ -]strand(?:s|ed)? )?class *([1-6])"),
      length(R"(([a-z][a-z. -]*?) *([\d.]+) *mm(?: *([a-z]+))?)");
  static const std::vector<std::pair<std::regex, const char*>> lengths{
      {std::regex("(single )?wires?( diameter)?"), "wire_diameter_mm"},
      {std::regex("(outer |outside |overall )?diameter|od|o\\.d\\.?"), "outer_diameter_mm"},
      {std::regex("([a-z-]+ )?(jacket|sheath)( [a-z-]+)*"), "jacket_thickness_mm"},
      {std::regex("cores?( diameter)?"), "core_diameter_mm"},
      {std::regex("lay( length)?"), "lay_length_mm"},
      {std::regex("(pair|group) lay( length)?"), "group_lay_length_mm"},
      {std::regex("wire lay( length)?"), "wire_lay_length_mm"}};
  std::smatch found;
  if (std::regex_match(phrase, found, word_class)) return {{"conductor_class", found[1]}};
  if (std::regex_match(phrase, found, with_earth)) return {{"cores", found[1]}, {"cross_section_mm2", found[2]}};
  if (std::regex_match(phrase, found, section)) {
    std::vector<std::pair<const char*, std::string>> keys{{"cores", found[1]}, {"cross_section_mm2", found[3]}};
    if (found[2].matched) keys.emplace_back("cores_per_group", found[2]);
    return keys;
  }
  if (std::regex_match(phrase, found, length))
    for (const auto& [words, key] : lengths)
      if (std::regex_match(found[1].str(), words)) {
        std::vector<std::pair<const char*, std::string>> keys{{key, found[2]}};
        if (key == std::string_view("jacket_thickness_mm")) {
          const std::string material = jacket_material(phrase);
          if (material.empty())
            refuse_unknown_material(found[1].str() + " " + found[3].str(), where);
          else
            keys.emplace_back("jacket_material", material);
        }
        return keys;
      }
  static const std::regex jacket(
      R"((outer |outside )?(jacket|sheath)( material)? *:? *[a-z -]+|[a-z-]+ (outer )?(jacket|sheath)|pur|tpu|polyurethane|pvc|tpe)");
  if (std::regex_match(phrase, jacket)) {
    const std::string material = jacket_material(phrase);
    if (material.empty()) refuse_unknown_material(phrase, where);
    return {{material.empty() ? "unused" : "jacket_material", material.empty() ? phrase : material}};
  }
  if (changes_nothing(phrase)) return {{"unused", phrase}};
  if (is_shield(phrase)) return {{"shield", phrase}};
  static const std::regex without_unit(R"(([a-z][a-z -]*?) *([\d.]+))");
  std::string meant = meant_section(phrase);
  if (meant.empty() && std::regex_match(phrase, found, without_unit) &&
      std::ranges::any_of(lengths, [&](const auto& of) { return std::regex_match(found[1].str(), of.first); }))
    meant = fmt::format("write '{} {} mm'", found[1].str(), found[2].str());
  static const std::regex bare(R"((?:Ø|ø|⌀)? *([\d.]+ *mm))");
  if (meant.empty() && std::regex_match(phrase, found, bare))
    meant = fmt::format("write 'outer diameter {}' if it is that of the cable", found[1].str());
  static const std::regex two_kinds(R"((?:[a-z -]+ )?(\d+ *[x*g] *.*\d) *\+ *\(?\d+ *[x*g(].*)");
  if (meant.empty() && std::regex_match(phrase, found, two_kinds))
    meant = fmt::format(
        "a data sheet has one kind of cores: write '{} mm2' alone (the other cores have no life then), or describe the "
        "cable by its components, as the hybrid cable in config/README.md",
        std::string(found[1]).substr(0, found[1].str().find(" mm")));
  static const std::regex angle(R"((?:(pair|group|wire) )?lay angle *:? *([\d.]+) *(?:deg(?:rees?)?|°)?)");
  if (meant.empty() && std::regex_match(phrase, found, angle))
    meant = fmt::format(
        "write '{0}lay length LENGTH mm' with the circumference of the layer's middle over the tangent of the angle, or "
        "'{0}lay length {1} mm' if that was the length",
        found[1].matched ? found[1].str() + " " : "", found[2].str());
  const std::string other = other_key(phrase);
  throw InputError(
      where, fmt::format("'{}' of a data sheet is not understood", phrase),
      !meant.empty() ? meant
      : !other.empty()
          ? other
          : fmt::format(
                "leave it out if it gives no length; lengths as in '{}' in mm, or as keys (dresslife manual data_sheet)",
                example_line));
}

}  // namespace

Node sheet_from_line(const Node& line) {
  constexpr std::size_t longest = 2000;  // bytes: std::regex needs some 100 bytes of the stack for each letter
  if (line.text.size() > longest)
    throw InputError(line.where, fmt::format("data_sheet has {} bytes (at most {})", line.text.size(), longest),
                     "keep the phrases of `dresslife manual data_sheet`");
  Node sheet;
  sheet.kind = Node::Kind::map;
  const std::string text = with_points(line.text);
  std::string_view rest = text;
  Problems problems;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::vector<std::string> phrases = phrases_of(in_english(plain(std::string(rest.substr(0, end)))));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    for (const std::string& phrase : phrases)
      problems.attempt("", line.where, [&] {
        for (const auto& [key, value] : keys_of_phrase(phrase, line.where)) {
          if ((key == std::string_view("unused") || key == std::string_view("shield")) && sheet.find(key)) {
            sheet[key].text += ", " + value;
            continue;
          }
          if (sheet.find(key))
            throw InputError(line.where, fmt::format("'{}' gives {} a second time", phrase, key),
                             "keep one of the two");
          sheet[key] = scalar(value);
        }
      });
  }
  problems.finish();
  place_at(sheet, line.where);
  return sheet;
}

std::string sheet_syntax() {
  return fmt::format(
      "dresspack.components[].data_sheet\n"
      "  A cable's data sheet: a text, or a map of the keys below. The text has phrases in any order with commas between them:\n"
      "    CORES x N mm2              required: cores and cross_section_mm2; also 4G2.5, with the protective conductor\n"
      "    GROUPS x CORES x N mm2     cores that are first twisted together: cores and cores_per_group\n"
      "    class N                    conductor_class\n"
      "    wire N mm                  wire_diameter_mm\n"
      "    core diameter N mm         core_diameter_mm\n"
      "    outer diameter N mm        outer_diameter_mm; also OD\n"
      "    jacket PUR N mm            jacket_material (PUR, PVC or TPE) and jacket_thickness_mm, or one of them\n"
      "    lay length N mm            lay_length_mm; also pair lay length and wire lay length\n"
      "    Klasse, Mantel, ..         the German words for class, outer diameter, jacket, lay length, shielded\n"
      "    shielded, screened, (C)    a shield, also without a comma: its wires are not evaluated, and its thickness belongs to N of the jacket\n"
      "  Lengths that are missing follow from class or wire. `dresslife draw DRESSPACK.yaml` shows the result. Examples:\n"
      "    data_sheet: {}\n"
      "    data_sheet: 4 x 2 x 0.25 mm2 shielded, class 6, pair lay length 30 mm, jacket PUR\n\n",
      example_line);
}

void describe(Fields& f, DataSheet& sheet) {
  f.place(sheet.where);
  f.integer("cores", sheet.cores, Need::required, between(1, 200),
            "The number of cores in the cable, or of their groups: the 7 of 7 x 0.5 mm2.");
  f.integer("cores_per_group", sheet.cores_per_group, Need::optional, between(1, 8),
            "The number of cores that are first twisted together: 2 in a cable of pairs, the second number "
            "of 4 x 2 x 0.25 mm2.");
  f.number("cross_section_mm2", sheet.cross_section, Need::required, above(0),
           "The nominal cross-section of the metal of one core.");
  f.integer("conductor_class", sheet.conductor_class, Need::optional, between(0, fine_class),
            "The class 5 or 6 of IEC 60228. With it the rules of the standards estimate the lengths that "
            "are not given. 0: not given.");
  f.maybe_number("wire_diameter_mm", sheet.wire_diameter, above(0),
                 "The diameter of the single wires of a core. Default: by the class, 0.15 of class 6 from "
                 "0.5 to 4 mm2.");
  f.maybe_number("outer_diameter_mm", sheet.outer_diameter, above(0),
                 "The diameter of the cable. Default: with a class, the sum from the cores outwards.");
  f.maybe_number(
      "jacket_thickness_mm", sheet.jacket_thickness, at_least(0),
      "The thickness of the jacket with tapes and screens. The cores fill the rest if core_diameter_mm is "
      "not given. Default: with core_diameter_mm and outer_diameter_mm the rest, else with a class 1 mm and 3.5 % of the "
      "width of the cores (IEC 60502-1).");
  f.text("jacket_material", sheet.jacket_material, Need::optional,
         "A material with `wear`: a name of config/materials. Default: the wear of the jacket is not evaluated.");
  f.maybe_number("core_diameter_mm", sheet.core_diameter, above(0),
                 "The diameter of a core over its insulation. Default: with a class and without "
                 "outer_diameter_mm, by EN 50525.");
  f.maybe_number("lay_length_mm", sheet.lay_length, above(0),
                 "The lay length of the cores or groups. Default: 12 times their width.");
  f.maybe_number("group_lay_length_mm", sheet.group_lay_length, above(0),
                 "The lay length of the cores in a group. Default: 12 times the group's width.");
  f.maybe_number("wire_lay_length_mm", sheet.wire_lay_length, above(0),
                 "The lay length of the wires in a core. Default: 16 times the conductor's width.");
  f.text("material", sheet.material, Need::optional, "The material of the wires: a name of config/materials.");
  f.maybe_number("friction_coefficient", sheet.friction, between(0, 1e6),
                 "The Coulomb friction of cores and wires. Default: 0.3, an ESTIMATE.");
  f.text("shield", sheet.shield, Need::written, "The words of the sheet's line for a shield.");
  f.text("unused", sheet.unused, Need::written, "The words of the sheet's line that change no result.");
  f.maybe_number("jacket_pressure_MPa", sheet.jacket_pressure, at_least(0),
                 "The pressure of the jacket on cores and wires. Default: 0.17, an ESTIMATE by the friction "
                 "of published cables. measured_bending_stiffness_Nm2 beside data_sheet sets its level.");
}

std::vector<CoreRing> packed(int count, double diameter, double lay_length, Fillers fillers, const Where& where) {
  std::vector<CoreRing> best;
  const auto consider = [&](int middle, int first) {
    std::vector<CoreRing> rings = straight_rings(count, diameter, middle, first);
    const double gain = best.empty() ? 1 : width_of(best, diameter) - width_of(rings, diameter);
    const bool equal = std::abs(gain) <= touching * diameter;
    if (equal ? fullness(rings.back(), diameter) > fullness(best.back(), diameter) : gain > 0) best = std::move(rings);
  };
  const int widest = fillers == Fillers::allowed ? count : closed_ring;
  for (int first = 1; first <= std::min(count, widest); ++first) consider(0, first);
  for (int first = closed_ring + 1; first <= std::min(count - 1, filled_ring); ++first) consider(1, first);
  if (std::isinf(lay_length)) return best;
  double inner = 0;
  for (std::size_t k = 0; k < best.size(); ++k) {
    if (k > 0) best[k].radius = std::max(best[k].radius, inner + diameter);
    if (best[k].radius > 0) widen(best[k], diameter, lay_length, where);
    inner = best[k].radius;
  }
  return best;
}

double width_of(const std::vector<CoreRing>& rings, double diameter) { return 2 * rings.back().radius + diameter; }

void expand_data_sheets(Node& dresspack) {
  Problems problems;
  expand_data_sheets(dresspack, "", problems);
  problems.finish(dresspack.where.file);
}

namespace {

/// Refuses a cable that is thicker than the known bore of its hose, before its other errors.
void refuse_thicker_than_bore(const Node& dresspack, const Node& component) {
  const double bore = bore_of(dresspack);
  const Node* const written = component.find("data_sheet");
  if (!(bore > 0) || !written) return;
  Node keys;
  try {
    keys = written->is_scalar() ? sheet_from_line(*written) : *written;
  } catch (const InputError&) {  // expand() reports the error
    return;
  }
  const Node* const outer = keys.find("outer_diameter_mm");
  const double diameter = outer ? std::strtod(outer->text.c_str(), nullptr) : 0;
  if (diameter > bore)
    throw InputError(
        outer->where, fmt::format("the cable is {:.4g} mm thick (the hose is {:.4g} mm wide inside)", diameter, bore),
        fmt::format("check outer_diameter_mm, or take a hose with {}", wider_hose_of(dresspack, diameter)));
}

void expand_all(Node& dresspack, const std::string& path, Problems& problems, LeftOut& left_out) {
  Node* components = dresspack.is_map() ? dresspack.find("components") : nullptr;
  if (!components || !components->is_list()) return;
  for (std::size_t i = 0; i < components->items.size(); ++i) {
    Node& component = components->items[i];
    if (!component.is_map()) continue;
    const std::string item = fmt::format("{}{}components[{}]", path, path.empty() ? "" : ".", i + 1);
    if (problems.attempt(item, component.where, [&] {
          if (path.find("components") == std::string::npos) refuse_thicker_than_bore(dresspack, component);
          expand(component, left_out);
        }))
      expand_all(component, item, problems, left_out);
  }
}

}  // namespace

void expand_data_sheets(Node& dresspack, const std::string& path, Problems& problems) {
  LeftOut left_out;
  const Node* const factor = dresspack.is_map() ? dresspack.find("estimated_lay_factor") : nullptr;
  if (factor)
    if (const double value = std::strtod(factor->text.c_str(), nullptr);
        value >= least_lay_factor && value <= most_lay_factor)
      left_out.lay_factor = value;  // the dresspack's keys refuse others
  expand_all(dresspack, path, problems, left_out);
  Node* source = dresspack.is_map() ? dresspack.find("source") : nullptr;
  if (source && source->is_scalar() && !left_out.by_rules.empty())
    source->text +=
        fmt::format("{}{} (by IEC 60228, EN 50525 and IEC 60502-1)", estimate_mark, fmt::join(left_out.by_rules, "; "));
  const Node* const known = dresspack.is_map() ? dresspack.find("estimates") : nullptr;
  const std::string estimated = fmt::format("{}{}", fmt::join(left_out.keys, "; "), known ? known->text : "");
  if (factor && estimated.find("lay_length_mm") == std::string::npos)
    problems.attempt(path + ".estimated_lay_factor", factor->where, [&] {
      throw InputError(factor->where,
                       "estimated_lay_factor has no effect: no data sheet of the dresspack leaves out a lay length",
                       "leave out estimated_lay_factor");
    });
  if (left_out.keys.empty()) return;
  const Where where = dresspack.where;
  Node& estimates = dresspack["estimates"];
  estimates.kind = Node::Kind::scalar;
  estimates.text += fmt::format("{}{}", estimates.text.empty() ? "" : "; ", fmt::join(left_out.keys, "; "));
  place_at(estimates, where);
}

}  // namespace dresslife::pipeline
