#include "pipeline/cable/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

constexpr double copper = 8960,
                 aluminium = 2700;  // densities of the heaviest and the lightest metal of cables [kg/m3]
// Damping ratio pi f tau at 1.8 Hz, the median frequency of published swings of hanging cables (ratio 0.115). Above 1 there is no
// swing. Steel ropes without friction between their wires have 0.005.
constexpr double swing_frequency = 1.8, least_ratio = 0.005, most_ratio = 1;
constexpr double stiffest = 115e9, shear = 45e9;  // moduli of copper [Pa]: no dresspack is a solid copper bar
constexpr double stiffest_polymer =
    15e9;                              // [Pa]: polyamide with 50 % of glass fibres; hoses without fibres have 0.1 to 3
constexpr double most_stretch = 0.02;  // strain by the weight of a metre; a simulation stops at this strain
constexpr double strongest_jacket = 10e6;  // [Pa]: pressure at which soft jackets (PVC, PUR) yield
constexpr double thinnest = 0.01e-3;       // radius of a wire [m]: the finest strands have a diameter of 0.03 mm
constexpr double least_lay =
    0.6 * degree;  // a turn in 100 helix diameters or more; lays of cables are 3 to 40 deg, 0.05 to 0.7 rad
// Lay length in widths of the layer: four times the longest lay of cores in flexible cables, 8 to 16 (config/defaults.md).
constexpr double longest_lay = 64;
constexpr std::pair<double, double> usual_wires{0.05e-3,
                                                0.5e-3};  // diameters of wires in flexible conductors and shields [m]

// Share of the mass of the construction. Copper wires are a third of it or more, and foamed insulation weighs a third of a solid one.
constexpr double lightest_share = 0.3;
constexpr double widest_hose = 0.2,
                 thinnest_cable = 1e-3;   // [m]: hoses on robots have diameters of 15 to 110 mm, sensor cables 2 mm
constexpr double thin_hose = 5e-3;        // [m]: the thinnest hose or cable on a robot that a wrong unit may stand for
constexpr double thickest_wall = 0.25;    // share of the diameter: corrugated hoses have 0.05 to 0.1, rubber hoses 0.2
constexpr double thinnest_wall = 0.1e-3;  // [m]: corrugated hoses have 0.3 mm and more
constexpr double same_height = 0.2;  // of a corrugation: catalogues round diameters to 0.5 mm; heights are 1.5 to 6 mm
constexpr double largest_bend_radius = 40;  // diameters: makers' limits are 3 to 15
constexpr double tight_bend = 1.3;          // diameters: the limit of corrugated hoses that do not move
// In diameters, for moving parts, from makers: hoses have 3 to 10, cables 5 to 15. For fixed cables, makers give 3 to 4.
constexpr double widest_hose_bend = 10, widest_cable_bend = 15;
constexpr double least_torsion = 0.01,
                 most_torsion = 100;      // G J / E I: a solid bar has 0.77, corrugated hoses up to 10
constexpr double largest_friction = 1.5;  // rubber on steel has 1
constexpr double least_most_twist = 5, largest_most_twist = 3600;     // [deg/m]: makers allow 50 to 360
constexpr double least_most_tension = 5, largest_most_tension = 1e5;  // [N]
constexpr double least_slack = 5e-4;  // half a millimetre per metre: no cable is installed so accurately
constexpr double least_grip = 1;      // [N]: weight of a cable in half a metre of hose
constexpr double largest_construction_curvature = 50;                // [1/m]: a radius of 20 mm
constexpr double thinnest_sleeve = 0.05e-3, thickest_sleeve = 0.25;  // [m], and share of the diameter
/// [m3/(N m)]: a tenth of the lowest rate of sliding polymers (1e-7 mm3/(N m)); above abrasive cloth on polyurethane (0.075).
constexpr double least_wear = 1e-17, most_wear = 1e-10;
constexpr double strongest_part =
    200e6;  // [Pa] over the whole cross-section of a part: half of a cable is metal, which breaks at 400 MPa
constexpr double fewest_rated = 100;  // cycles
// Of test rigs. Radius of the cable's axis in diameters: published ratings have 4 to 20. Twist [deg/m]: they have 180 to 2700.
constexpr double tightest_rig = 2, widest_rig = 100, least_rig_twist = 10, most_rig_twist = 3600;
constexpr std::pair usual_rig{4.0, 20.0};
constexpr double longest_rig = 20;                            // [m]: test chains have up to 10
constexpr double softest_wire = 10e9, stiffest_wire = 450e9;  // [Pa]: magnesium 45, tungsten 400
constexpr double weakest_wire = 30e6, strongest_wire = 10e9;  // [Pa]: soft aluminium 50 MPa, steel cord 4 GPa
constexpr double largest_ductility = 10;                      // copper of the thesis has 2.4
constexpr double steepest_strength = -0.3, steepest_ductility = -1.2,
                 flattest_ductility = -0.3;  // b -0.05 to -0.15, c -0.5 to -0.8
constexpr double heaviest_filling = 2500;  // [kg/m3]: hydraulic hoses with four layers of steel wire have 1500 to 2000
constexpr double least_grams =
    50;  // [kg/m]: a larger number is in g/m; a smaller one may be the mass of a whole dresspack
constexpr double lightest_part =
    50;  // [kg/m3] over the cross-section of a part without wires: foam; an air hose of 8/5.5 mm has 630
constexpr double usual_bore = 0.45;
// In units of a usual jacket, 1 mm + 0.035 bundle diameters (pipeline/resolve/cable_rules.h): two sheaths with a screen between
// them have 1.9. Below 0.25 it is the insulation of a core; pairs and cores narrower than 4 mm have such sheaths. ESTIMATE.
constexpr double thickest_jacket = 2, thinnest_jacket = 0.25, narrow_part = 4e-3, jacket_base = 1e-3,
                 jacket_slope = 0.035;
constexpr double shortest_pitch = 0.3e-3;  // [m]: the finest corrugated hoses have 1 mm
// Pitch over height: the two shipped profiles have 1.1, wide ones 2; a pitch that is exchanged with the height has less than 1. ESTIMATE.
constexpr double shortest_fold = 0.8;
// Height over outer diameter. Usual: conduits of polyamide of 13 to 106 mm, an ESTIMATE. The limits contain the conduits of JIS C 8411,
// table 5, with their least bore: 0.08 (CD 70) to 0.19 (PF 14).
constexpr double lowest_fold = 0.05, highest_fold = 0.2, usual_folds[] = {0.06, 0.12};
constexpr double largest_grip = 1e5;  // [N]: ten times the breaking force of a power cable

constexpr OtherUnit from_metres{1e3, "metres instead of millimetres", "metres"},
    from_percent{1e-2, "per cent instead of a share", "per cent"},
    from_share{1e2, "a share instead of per cent", "a share"},
    from_kilonewtons{1e3, "kilonewtons instead of newtons", "kN"},
    from_radians_per_metre{1 / degree, "radians or turns per metre", "rad/m"},
    from_turns_per_metre{360, "turns per metre", "turns/m"};

/// Returns the mass of all wires per metre of the part along their lays, with the density of aluminium [kg/m].
double least_wire_mass(const std::vector<Component>& components) {
  double mass = 0;
  for (const Component& of : components) {
    const double each = is_wire(of) ? aluminium * pi * of.radius * of.radius : least_wire_mass(of.components);
    mass += of.count * each / std::cos(of.lay_angle);
  }
  return mass;
}

class Judge {
 public:
  explicit Judge(std::vector<Warning>& warnings) : add(warnings, WarningKind::material) {}

  const WarningsOfKind add;

  /// Warns of a wire that is too thin. A data sheet has the diameter instead of the radius.
  void thin_wire(const Component& of) {
    const auto [least, most] = usual_wires;
    const Meant radius = meant_length("radius_mm", 1e3 * of.radius, 0.5e3 * least, 0.5e3 * most);
    const Meant width = meant_length("wire_diameter_mm", 2e3 * of.radius, 1e3 * least, 1e3 * most);
    add(of.where,
        fmt::format("radius_mm of '{}' is {:.3g} (limit {:.2g} or more for a wire)", of.name, 1e3 * of.radius,
                    1e3 * thinnest),
        radius.cause.empty() ? "another unit" : radius.cause,
        radius.cause.empty() ? "radius_mm: half of the wire's diameter in millimetres"
                             : radius.remedy + "; in a data sheet " + width.remedy);
  }

  void parts(const std::vector<Component>& components) {
    // of all layers that are stranded together: they have one lay length, so the innermost has a small angle
    const double widest =
        largest_of(components, 0.0, [](const Component& of) { return 2 * (of.helix_radius + of.radius); });
    for (std::size_t k = 0; k < components.size(); ++k) {
      const Component& of = components[k];
      const std::string name = fmt::format(" of '{}'", of.name);
      const double section = pi * of.radius * of.radius;
      if (is_wire(of) && of.radius < thinnest) thin_wire(of);
      if (of.lay_angle > 0 && of.lay_angle < least_lay &&
          2 * pi * of.helix_radius > longest_lay * widest * std::tan(of.lay_angle))
        add(of.where,
            fmt::format("lay_angle_deg of '{}' is {:.3g}, a turn in {:.3g} m (limit 0, or {:.2g} deg or more)", of.name,
                        of.lay_angle / degree, 2 * pi * of.helix_radius / std::tan(of.lay_angle), least_lay / degree),
            "radians instead of degrees",
            fmt::format("lay_angle_deg: {:.3g} if that was radians, or 0", of.lay_angle / degree / degree));
      const double turn = of.lay_angle > least_lay ? 2 * pi * of.helix_radius / std::tan(of.lay_angle) : 0;  // [m]
      if (const double width = 2 * (of.helix_radius + of.radius); !of.components.empty() && turn > longest_lay * width)
        add(of.where,
            fmt::format("the lay length of '{}' is {:.3g} mm, {:.0f} times the width of its layer (limit {:g})",
                        of.name, 1e3 * turn, turn / width, longest_lay),
            "a lay length with a digit too many",
            fmt::format("lay_length_mm: {:.3g} in a data sheet, or lay_angle_deg: {:.3g}", 1e2 * turn,
                        std::atan(10 * std::tan(of.lay_angle)) / degree));
      if (const double pressure = of.radial_line_load.value_or(0) / (2 * of.radius); pressure > strongest_jacket)
        add(of.where,
            fmt::format(
                "radial_line_load_N_per_m of '{}' is {:.4g}, {:.3g} MPa on its width (limit {:g}: jackets yield)",
                of.name, *of.radial_line_load, pressure / 1e6, strongest_jacket / 1e6),
            "another unit", "a jacket's 0.17 MPa times the part's width, or no key");
      if (const double usual = jacket_base + jacket_slope * 2 * (of.radius - (of.jacket ? of.jacket->thickness : 0));
          of.jacket && of.jacket->thickness > thickest_jacket * usual)
        add(of.where,
            fmt::format("the jacket of '{}' is {:.3g} mm thick (limit {:.3g}: {:g} times a usual one)", of.name,
                        1e3 * of.jacket->thickness, 1e3 * thickest_jacket * usual, thickest_jacket),
            "the added diameter instead of one wall, or another unit",
            fmt::format("jacket {:.3g} mm if that was both walls, or {:.2g} mm, a usual one",
                        5e2 * of.jacket->thickness, 1e3 * usual));
      else if (of.jacket && 2 * of.radius >= narrow_part && of.jacket->thickness >= thinnest_sleeve &&
               of.jacket->thickness < thinnest_jacket * usual)
        add(of.where,
            fmt::format("the jacket of '{}' is {:.3g} mm thick (limit {:.2g} or more: {:g} times a usual one)", of.name,
                        1e3 * of.jacket->thickness, 1e3 * thinnest_jacket * usual, thinnest_jacket),
            "the insulation of a core, or a lost digit",
            fmt::format("jacket {:.2g} mm, a usual one, or no jacket if none is known", 1e3 * usual));
      if (of.jacket)
        add.number(of.where, "thickness_mm", " of the jacket" + name, 1e3 * of.jacket->thickness,
                   {1e3 * thinnest_sleeve}, {from_metres});
      add.number(of.where, "friction_coefficient", name, of.friction.value_or(0), {0, largest_friction},
                 {from_percent});
      add.number(of.where, "tension_N", name, of.tension,
                 {0, strongest_part * section, fmt::format(": {:g} MPa on its section", strongest_part / 1e6)}, {},
                 {"another unit", "no tension_N, or the pull with which it was installed"});
      if (of.laying.mass) {
        const double mass = *of.laying.mass, foam = of.plain ? lightest_part * section : 0;
        add.number(of.where, "mass_kg_per_m", name, mass, {0, copper * section, ": solid copper"},
                   {{1e-3, "grams instead of kilograms", "g/m"}}, {"another unit", "", ", or no key"});
        add.number(of.where, "mass_kg_per_m", name, mass, {foam, no_limit, ": foam"},
                   {{1e3, "tonnes instead of kilograms, or kg/mm", "kg/mm"}}, {"another unit", "", ", or no key"});
        add.number(of.where, "mass_kg_per_m", name, mass,
                   {least_wire_mass(of.components), no_limit, ": its wires, if they were of aluminium"}, {},
                   {"another unit", "mass_kg_per_m from the data sheet (kg/km over 1000), or no key"});
      }
      if (of.plain && of.plain->bore) tube(of, 1e3 * *of.plain->bore, 2e3 * of.radius);
      ratings(of.ratings, of.name, 2 * of.radius);
      for (std::size_t other = 0; other < k; ++other)
        if (components[other].name == of.name && components[other].layer == of.layer)
          add(of.where,
              fmt::format("two parts side by side are named '{}' (the other: line {})", of.name,
                          components[other].where.line),
              "a copied entry", "another name, or layer: NAME; results do not distinguish equal names");
      parts(of.components);
    }
  }

  /// diameter: of the cable or hose with these ratings [m].
  void ratings(const std::vector<Rating>& ratings, const std::string& name, double diameter) {
    for (const Rating& rating : ratings) {
      add.number(rating.where, "cycles", fmt::format(" of a rating of '{}'", name), rating.cycles, {fewest_rated},
                 {{1e6, "millions of cycles", "millions"}});
      rig(rating.rig, name, diameter);
    }
  }

 private:
  void rig(const Rig& rig, const std::string& name, double diameter) {
    const std::string of = fmt::format(" in a rating of '{}'", name);
    if (rig.twist)
      add.number(rig.where, "twist_deg_per_m", of, *rig.twist / degree, {least_rig_twist, most_rig_twist},
                 {from_radians_per_metre, from_turns_per_metre},
                 {"another unit, or a length in millimetres",
                  "twist_deg_per_m: the maker's angle to either side, over the length in metres"});
    add.number(rig.where, "travel_m", of, rig.travel.value_or(0), {0, longest_rig},
               {{1e-3, "millimetres instead of metres", "mm"}},
               {"another unit", "", "; leave it if the maker states it"});
    const bool bends = rig.radius || rig.radius_diameters || rig.pulley_diameter;
    if (!bends || rig.kind == RigKind::swivel || !(diameter > 0)) return;  // clips may have sharp edges
    const double times = axis_radius(rig, diameter) / diameter;
    if (times >= tightest_rig * (1 - 1e-9) && times <= widest_rig * (1 + 1e-9)) return;
    struct Given {
      const char* key;
      double value, one;  // one: a diameter of the cable in the unit of the key
    };
    const Given given = rig.kind == RigKind::two_pulley
                            ? Given{"pulley_diameter_mm", 1e3 * *rig.pulley_diameter, 2e3 * diameter}
                        : rig.radius ? Given{"radius_mm", 1e3 * *rig.radius, 1e3 * diameter}
                                     : Given{"radius_diameters", *rig.radius_diameters, 1};
    const auto [low, high] = usual_rig;
    Meant meant = meant_length(given.key, given.value, low * given.one, high * given.one);
    if (rig.radius && given.value >= low && given.value <= high)
      meant = {"diameters instead of millimetres", fmt::format("radius_diameters: {:.4g} if so", given.value)};
    else if (rig.radius_diameters || meant.remedy.empty())
      meant = {"another unit", fmt::format("{} as the maker states", given.key)};
    add(rig.where,
        fmt::format("{} in a rating of '{}' is {:.4g}: its axis is bent to {:.3g} diameters (limits {:g} .. {:g})",
                    given.key, name, given.value, times, tightest_rig, widest_rig),
        meant.cause, meant.remedy);
  }

  /// Judges bore and outer diameter of a hose in the hose [mm].
  void tube(const Component& of, double bore, double outer) {
    if (bore >= narrowest_bore * outer && bore <= widest_bore * outer) return;
    const auto fits = [&](double inner, double around) {
      return inner >= usual_bore * around && inner <= widest_bore * around;
    };
    std::vector<std::string> remedies;
    if (fits(2 * bore, outer))
      remedies.push_back(fmt::format("bore_mm: {:.4g} if {:.4g} is half the bore", 2 * bore, bore));
    if (fits(bore, outer / 2))
      remedies.push_back(fmt::format("radius_mm: {:.4g} if {:.4g} is the outer diameter", outer / 4, outer / 2));
    if (const Meant meant = meant_length("bore_mm", bore, usual_bore * outer, widest_bore * outer);
        !meant.remedy.empty())
      remedies.push_back(meant.remedy);
    if (bore > widest_bore * outer) remedies.push_back(fmt::format("bore_mm: {:.3g} (ESTIMATE)", outer * 2 / 3));
    if (remedies.empty()) remedies.push_back("radius_mm, half the outer diameter, and bore_mm, the inner diameter");
    add(of.plain->where,
        fmt::format(
            "bore_mm of '{}' is {:.3g}, and it is {:.4g} mm wide outside by radius_mm {:.4g} (limits {:.3g} .. {:.3g}: {:g} to {:g} times "
            "as much)",
            of.name, bore, outer, outer / 2, narrowest_bore * outer, widest_bore * outer, narrowest_bore, widest_bore),
        "a radius instead of a diameter or a diameter instead of a radius, or another unit", joined(remedies, "; or "));
  }
};

/// Returns whether a wire is of this material.
bool has_wire_of(const std::vector<Component>& components, const std::string& material) {
  return std::ranges::any_of(components, [&](const Component& of) {
    return is_wire(of) ? of.material == material : has_wire_of(of.components, material);
  });
}

/// Judges the constants of wire metals.
void plausible_metal(const Material& of, Judge& judge) {
  const std::string name = fmt::format(" of the wires' material '{}'", of.name);
  judge.add.number(of.where, "youngs_modulus_GPa", name, of.youngs_modulus / 1e9,
                   {softest_wire / 1e9, stiffest_wire / 1e9},
                   {{1e3, "TPa instead of GPa, or no metal", "TPa"}, {1e-3, "MPa instead of GPa, or no metal", "MPa"}},
                   {"another unit, or no metal", ""});
  for (const auto& [key, value] : {std::pair{"tensile_strength_MPa", of.tensile_strength},
                                   {"fatigue_strength_MPa", std::optional(of.fatigue_strength)}})
    if (value && *value > 0)
      judge.add.number(of.where, key, name, *value / 1e6, {weakest_wire / 1e6, strongest_wire / 1e6},
                       {{1e3, "GPa instead of MPa", "GPa"}, {1e-3, "kPa instead of MPa", "kPa"}});
  if (of.fatigue_strength <= 0) return;
  if (of.fatigue_strength_exponent < of.fatigue_ductility_exponent)
    judge.add(
        of.where,
        fmt::format(
            "fatigue_strength_exponent of '{}' is {:g}, and fatigue_ductility_exponent {:g} (limit: the second is the steeper one)",
            of.name, of.fatigue_strength_exponent, of.fatigue_ductility_exponent),
        "exchanged exponents",
        fmt::format("fatigue_strength_exponent: {:g} and fatigue_ductility_exponent: {:g}",
                    of.fatigue_ductility_exponent, of.fatigue_strength_exponent));
  else {
    judge.add.number(of.where, "fatigue_strength_exponent", name, of.fatigue_strength_exponent, {steepest_strength, 0},
                     {}, {"a slope of another curve", "-0.05 to -0.15 for metals"});
    judge.add.number(of.where, "fatigue_ductility_exponent", name, of.fatigue_ductility_exponent,
                     {steepest_ductility, flattest_ductility}, {},
                     {"a slope of another curve", "-0.5 to -0.8 for metals"});
  }
  judge.add.number(of.where, "fatigue_ductility", name, of.fatigue_ductility, {0, largest_ductility}, {from_percent});
}

/// Judges limits from makers, and the sleeve and other parts around the hose.
void plausible_limits(const Dresspack& dresspack, Judge& judge) {
  if (dresspack.most_twist)
    judge.add.number(dresspack.where, "most_twist_deg_per_m", "", *dresspack.most_twist / degree,
                     {least_most_twist, largest_most_twist}, {from_radians_per_metre, from_turns_per_metre},
                     {"another unit", "most_twist_deg_per_m: 180, or the maker's limit"});
  if (dresspack.most_tension)
    judge.add.number(dresspack.where, "most_tension_N", "", *dresspack.most_tension,
                     {least_most_tension, largest_most_tension},
                     {from_kilonewtons, {1e-3, "millinewtons instead of newtons", "mN"}});
  judge.add.number(dresspack.where, "friction_coefficient", "", dresspack.friction, {0, largest_friction}, {},
                   {"a guess that is too high", "friction_coefficient: 0.5"});
  if (dresspack.construction_curvature > largest_construction_curvature)
    judge.add(dresspack.where,
              fmt::format("construction_curvature_1_per_m is {:g} (limit {:g})", dresspack.construction_curvature,
                          largest_construction_curvature),
              "a bend radius in mm",
              fmt::format("construction_curvature_1_per_m: {:.3g} if that was a radius in mm",
                          1e3 / dresspack.construction_curvature));
  if (dresspack.sleeve)
    judge.add.number(dresspack.where, "thickness_mm", " of the sleeve", 1e3 * dresspack.sleeve->thickness,
                     {1e3 * thinnest_sleeve, 1e3 * thickest_sleeve * dresspack.diameter}, {from_metres},
                     {"the diameter instead of the thickness, or another unit", "thickness_mm of one wall"});
}

/// Judges diameters, bend radius and torsion against each other, and against the parts.
void plausible_size(const Dresspack& dresspack, Judge& judge) {
  const double diameter = dresspack.diameter;
  if (diameter > widest_hose || diameter < thinnest_cable) {
    const Meant meant = meant_length("diameter_mm", 1e3 * diameter, 1e3 * thin_hose, 1e3 * widest_hose);
    judge.add(dresspack.where,
              fmt::format("diameter_mm is {:.4g} (limits {:g} .. {:g})", 1e3 * diameter, 1e3 * thinnest_cable,
                          1e3 * widest_hose),
              meant.cause.empty() ? "another unit" : meant.cause,
              meant.remedy.empty() ? "diameter_mm as a caliper finds it" : meant.remedy);
  }
  if (const auto& profile = dresspack.hose_corrugation)
    judge.add.number(profile->where, "pitch_mm", "", 1e3 * profile->pitch, {1e3 * shortest_pitch}, {from_metres});
  if (const auto& profile = dresspack.hose_corrugation; profile && profile->pitch >= shortest_pitch) {
    if (profile->pitch < shortest_fold * profile->height)
      judge.add(profile->where,
                fmt::format("pitch_mm is {:.3g} and height_mm {:.3g} (limit {:g} or more of the height)",
                            1e3 * profile->pitch, 1e3 * profile->height, shortest_fold),
                "the two exchanged",
                fmt::format("pitch_mm: {:.3g} and height_mm: {:.3g} if they were exchanged", 1e3 * profile->height,
                            1e3 * profile->pitch));
    else if (const double share = profile->height / diameter;
             diameter <= widest_hose && (share < lowest_fold || share > highest_fold))
      judge.add(profile->where,
                fmt::format("height_mm is {:.3g}, {:.2g} times diameter_mm {:.4g} (limits {:g} .. {:g})",
                            1e3 * profile->height, share, 1e3 * diameter, lowest_fold, highest_fold),
                "the corrugation or the diameter of another hose",
                fmt::format("diameter_mm {:.3g} .. {:.3g} with this corrugation, or height_mm as a caliper finds it",
                            1e3 * profile->height / usual_folds[1], 1e3 * profile->height / usual_folds[0]));
  }
  if (const auto& profile = dresspack.hose_corrugation; profile && dresspack.inner_diameter) {
    const double height = (diameter - *dresspack.inner_diameter) / 2;
    if (std::abs(profile->height - height) > same_height * height)
      judge.add(
          profile->where,
          fmt::format(
              "height_mm of hose_corrugation is {:.3g}, and half the difference of diameter_mm {:.4g} and inner_diameter_mm "
              "{:.4g} is {:.3g} (limit {:g} % apart)",
              1e3 * profile->height, 1e3 * diameter, 1e3 * *dresspack.inner_diameter, 1e3 * height, 100 * same_height),
          "the corrugation of another hose, or the difference of the diameters instead of half of it",
          fmt::format("height_mm: {:.3g}, or the diameters of this corrugation", 1e3 * height));
  }
  if (dresspack.inner_diameter) {
    const double wall = (diameter - *dresspack.inner_diameter) / 2;
    if (wall > thickest_wall * diameter || wall < thinnest_wall)
      judge.add(
          dresspack.where,
          fmt::format("the wall is {:.3g} mm thick by diameter_mm and inner_diameter_mm (limits {:.3g} .. {:.3g})",
                      1e3 * wall, 1e3 * thinnest_wall, 1e3 * thickest_wall * diameter),
          "one of the two diameters in another unit or of another hose",
          fmt::format("inner_diameter_mm: {:.3g} (ESTIMATE), or diameter_mm as measured",
                      1e3 * usual_bore_share * diameter));
  }
  if (const double radius = dresspack.least_bend_radius.value_or(diameter);
      radius < diameter || radius > largest_bend_radius * diameter) {
    const Meant meant = meant_length("least_bend_radius_mm", 1e3 * radius, 1e3 * tight_bend * diameter,
                                     1e3 * largest_bend_radius * diameter);
    judge.add(dresspack.where,
              fmt::format("least_bend_radius_mm is {:.4g} (limits {:.4g} .. {:.4g}: 1 to {:g} diameters)", 1e3 * radius,
                          1e3 * diameter, 1e3 * largest_bend_radius * diameter, largest_bend_radius),
              meant.cause.empty() ? "the bend radius or diameter_mm of another hose" : meant.cause,
              meant.remedy.empty() ? "least_bend_radius_mm as the maker states" : meant.remedy);
  } else if (dresspack.least_bend_radius) {
    const bool hose = dresspack.inner_diameter || dresspack.hose_corrugation;
    const double low = hose ? tightest_hose : tightest_cable, high = hose ? widest_hose_bend : widest_cable_bend;
    if (const double times = radius / diameter; times < low * (1 - 1e-9) || times > high * (1 + 1e-9))
      judge.add(
          dresspack.where,
          fmt::format("least_bend_radius_mm is {:.4g}, {:.3g} diameters (limits {:g} .. {:g} of a moved {})",
                      1e3 * radius, times, low, high, hose ? "hose" : "cable"),
          times > high ? "the bend diameter instead of the bend radius"
                       : "half of the radius, or the radius for a part that lies still",
          times > high
              ? fmt::format(
                    "least_bend_radius_mm: {:.4g} if that was the diameter; leave it if the maker states this radius",
                    5e2 * radius)
              : fmt::format(
                    "least_bend_radius_mm: {:.4g} if that was half; leave it if the maker states this radius for motion",
                    2e3 * radius));
  }
  if (const double share = dresspack.torsional_stiffness / dresspack.bending_stiffness;
      dresspack.bending_stiffness > 0 && dresspack.torsional_stiffness > 0 &&
      !(share > least_torsion && share < most_torsion))
    judge.add(dresspack.where,
              fmt::format("torsional_stiffness_Nm2 is {:.3g} times bending_stiffness_Nm2 (limits {:g} .. {:g})", share,
                          least_torsion, most_torsion),
              "one of the two in another unit", "torsional_stiffness_Nm2: from_construction, or both as measured");
  for (const Component& of : dresspack.components) {
    const std::string name = fmt::format(" of '{}'", of.name);
    if (of.laying.slack > 0)
      judge.add.number(of.where, "slack_percent", name, of.laying.slack,
                       {100 * least_slack, 100 * largest_slack, ", or 0"},
                       {from_share, {0.1, "millimetres in a metre instead of per cent", "mm in a metre"}});
    for (const auto& [key, grip] :
         {std::pair{"base_grip_N", of.laying.base_grip}, {"tool_grip_N", of.laying.tool_grip}})
      if (grip)
        judge.add.number(of.where, key, name, *grip, {least_grip, largest_grip}, {from_kilonewtons},
                         {"another unit", fmt::format("no {}: then the clamp holds the cable", key)});
  }
}

/// Warns of wires without a density in a part whose mass is computed.
void doubt_densities(const Dresspack& dresspack, const Judge& judge) {
  for (const Material& of : dresspack.materials)
    for (const Component& part : dresspack.components) {
      const bool counts = dresspack.mass_from_construction || lies_loose(dresspack, part);
      if (of.density || part.laying.mass || !counts || !has_wire_of({part}, of.name)) continue;
      judge.add(of.where,
                fmt::format("'{}' has no density (limit: one is needed; '{}' weighs as if it were copper)", of.name,
                            part.name),
                "a material without this key",
                "density_kg_per_m3: 8900 for copper, 2700 for aluminium, 7850 for steel");
      break;
    }
}

}  // namespace

std::vector<Warning> plausibility_warnings(const Dresspack& dresspack) {
  std::vector<Warning> warnings;
  Judge judge(warnings);
  const double mass = dresspack.mass_per_length, section = pi / 4 * dresspack.diameter * dresspack.diameter;
  const double wires = least_wire_mass(dresspack.components);
  // In addition to its parts, a hose is filled with steel braid and rubber at most. Without parts its content is unknown.
  const double built = dresspack.components.empty() ? 0 : mass_of_construction(dresspack);
  const double least = std::max(wires, lightest_share * built);
  const double most = built > 0 ? built + heaviest_filling * section : copper * section;
  if (mass > most)
    judge.add(
        dresspack.where,
        fmt::format("mass_kg_per_m is {:.4g} (limit {:.3g}: {})", mass, most,
                    built > 0 ? "its parts, and diameter_mm filled with rubber and steel braid"
                              : "solid copper of diameter_mm"),
        mass < least_grams ? "the mass of the whole dresspack, or diameter_mm in another unit"
                           : "grams instead of kilograms, or diameter_mm in another unit",
        fmt::format("{}{}; or check diameter_mm: {:.4g}",
                    mass / 1000 > wires ? fmt::format("mass_kg_per_m: {:.4g} if that was g/m", mass / 1000)
                                        : "mass_kg_per_m of a metre",
                    built > 0 ? fmt::format(", {:.3g} by its parts and wall", built) : "", 1e3 * dresspack.diameter));
  if (mass > 0 && mass < least)
    judge.add(dresspack.where,
              fmt::format("mass_kg_per_m is {:.3g} (limit {:.3g}: {})", mass, least,
                          wires == least ? "its wires, if they were of aluminium"
                                         : fmt::format("{:g} % of what its parts and its wall weigh by their sizes",
                                                       100 * lightest_share)),
              "another unit, or the empty hose",
              fmt::format("mass_kg_per_m of the filled hose, or from_construction ({:.3g})", built));
  const double ratio = pi * swing_frequency * dresspack.damping_time;
  if (!dresspack.damping_source.empty() && (ratio < least_ratio || ratio > most_ratio))
    judge.add(
        dresspack.where,
        fmt::format("damping_time_ms is {:.3g} (limits {:.2g} .. {:.3g}: a damping ratio of {:g} to {:g} at {:g} Hz)",
                    1e3 * dresspack.damping_time, 1e3 * least_ratio / pi / swing_frequency,
                    1e3 * most_ratio / pi / swing_frequency, least_ratio, most_ratio, swing_frequency),
        ratio < least_ratio ? "seconds instead of milliseconds, or no damping at all"
                            : "microseconds instead of milliseconds",
        "20 for a hose with cables, or the decay of its swing as measured");
  const double second_moment = section * dresspack.diameter * dresspack.diameter / 16;
  for (const auto& [key, value, solid] :
       {std::tuple{"bending_stiffness_Nm2", dresspack.bending_stiffness, stiffest * second_moment},
        {"torsional_stiffness_Nm2", dresspack.torsional_stiffness, shear * 2 * second_moment},
        {"axial_stiffness_N", dresspack.axial_stiffness, stiffest * section}})
    judge.add.number(
        dresspack.where, key, "", value, {0, solid, ": solid copper of diameter_mm"}, {},
        {"another unit, or diameter_mm in another unit", "the stiffness as measured, or from_construction"});
  constexpr double gravity = 9.81;
  const double weight = std::min(mass, most) * gravity;  // an implausible mass does not make the stiffness implausible
  if (const bool computed = dresspack.axial_from_construction;
      dresspack.axial_stiffness > 0 && weight > most_stretch * dresspack.axial_stiffness)
    judge.add(
        dresspack.where,
        fmt::format("axial_stiffness_N is {:.3g}{} (limit {:.3g} or more: {:g} % of stretch by the weight of a metre)",
                    dresspack.axial_stiffness, computed ? " from the construction" : "", weight / most_stretch,
                    100 * most_stretch),
        !computed                    ? "kilonewtons instead of newtons"
        : dresspack.hose_corrugation ? "a corrugation that is too high or too thin"
                                     : "a wall or parts that are too soft or missing",
        !computed ? fmt::format("axial_stiffness_N: {:.3g} if that was kN, or from_construction",
                                1000 * dresspack.axial_stiffness)
        : dresspack.hose_corrugation
            ? "height_mm, wall_mm and pitch_mm of hose_corrugation as a caliper finds them, or axial_stiffness_N as measured"
            : "hose_material and inner_diameter_mm of the hose, or axial_stiffness_N as measured");
  plausible_size(dresspack, judge);
  plausible_limits(dresspack, judge);
  if (const Material* const wall = find_material(dresspack, dresspack.hose_material); wall)
    judge.add.number(dresspack.where, "youngs_modulus_GPa", fmt::format(" of hose_material '{}'", wall->name),
                     1e-9 * wall->youngs_modulus, {0, 1e-9 * stiffest_polymer, ": polymers"}, {},
                     {"the material of a wire", "hose_material: hose_polyamide, or the hose's own material"});
  for (const Material& of : dresspack.materials)
    for (const WearRate& wear : of.wear)
      judge.add.number(of.where, "rate_mm3_per_Nm", fmt::format(" of '{}'", of.name), 1e9 * wear.rate,
                       {1e9 * least_wear, 1e9 * most_wear}, {{1e9, "m3/(N m) instead of mm3/(N m)", "m3/(N m)"}},
                       {"another unit: abrasive cloth takes off less than the upper limit",
                        "rate_mm3_per_Nm as measured; polymers that slide: 1e-7 .. 1e-3"});
  for (const Material& of : dresspack.materials)
    if (has_wire_of(dresspack.components, of.name)) plausible_metal(of, judge);
  for (const Component& of : dresspack.components)
    judge.add.number(of.where, "play_mm", fmt::format(" of '{}'", of.name), 1e3 * of.laying.play.value_or(0),
                     {0, 500 * dresspack.diameter, ": half of diameter_mm"}, {},
                     {"another unit", "no play_mm: it follows from the bore"});
  doubt_densities(dresspack, judge);
  judge.parts(dresspack.components);
  judge.parts(dresspack.core_components);
  judge.ratings(dresspack.ratings, dresspack.name, dresspack.diameter);
  return warnings;
}

}  // namespace dresslife::pipeline
