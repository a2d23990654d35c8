#include "pipeline/cable/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/warning_words.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/parts_room.h"

namespace dresslife::pipeline {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double copper = 8960,
                 aluminium = 2700;  // densities: the heaviest and the lightest metal of cables [kg/m3]
// Damping ratio pi f tau at 1.8 Hz, the median of published swings of hanging cables (0.115 there). Beyond 1 nothing
// swings; steel ropes without friction between their wires have 0.005.
constexpr double swing_frequency = 1.8, least_ratio = 0.005, most_ratio = 1;
constexpr double stiffest = 115e9, shear = 45e9;  // moduli of copper [Pa]: a dresspack is no solid bar of it
constexpr double most_stretch = 0.02;             // by the weight of a metre, at which a simulation stops
constexpr double strongest_jacket = 10e6;         // [Pa]: the pressure at which soft jackets (PVC, PUR) yield
constexpr double thinnest = 0.01e-3;              // radius of a wire [m]: the finest strands are 0.03 mm wide
constexpr double least_lay =
    0.6 * degree;  // a turn in 100 helix diameters and more; lays of cables are 3 to 40 deg, 0.05 to 0.7 rad

constexpr double widest_hose = 0.2, thinnest_cable = 1e-3;  // [m]: hoses on robots are 15 to 110 mm wide, sensor cables 2
constexpr double thickest_wall = 0.25;     // of the diameter: a corrugated hose has 0.05 to 0.1, a rubber hose 0.2
constexpr double thinnest_wall = 0.1e-3;   // [m]: corrugated hoses have 0.3 mm and more, and their folds
constexpr double largest_bend_radius = 40;  // diameters: makers' limits are 3 to 15
constexpr double least_torsion = 0.01, most_torsion = 100;  // G J over E I: a solid bar has 0.77, corrugated hoses to 10
constexpr double largest_friction = 1.5;   // rubber on steel has 1
constexpr double largest_slack = 0.05;     // dresspacks are laid with 1 to 2 %
constexpr double heaviest_filling = 2500;  // [kg/m3]: hydraulic hoses with four layers of steel wire have 1500 to 2000
constexpr double least_grams = 50;         // [kg/m]: more is g/m; less may be the mass of a whole dresspack
constexpr double largest_grip = 1e5;       // [N]: ten times what tears a power cable

/// Of all wires in a metre of the part, lays along: as if of aluminium [kg/m].
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
  explicit Judge(std::vector<Warning>& warnings) : warnings_(warnings) {}

  void add(const Where& where, const std::string& what, const std::string& cause, const std::string& remedy) {
    warnings_.push_back(warning_of(WarningKind::material, where.text(), what, cause, remedy));
  }

  void parts(const std::vector<Component>& components) {
    for (std::size_t k = 0; k < components.size(); ++k) {
      const Component& of = components[k];
      if (is_wire(of) && of.radius < thinnest)
        add(of.where,
            fmt::format("radius_mm of '{}' is {:.3g} (limit {:.2g} or more for a wire)", of.name,
                        1e3 * of.radius, 1e3 * thinnest),
            "metres instead of millimetres",
            fmt::format("radius_mm: {:.3g} if that was metres", 1e6 * of.radius));
      if (of.lay_angle > 0 && of.lay_angle < least_lay)
        add(of.where,
            fmt::format(
                "lay_angle_deg of '{}' is {:.3g}, a turn in {:.3g} m (limit 0, or {:.2g} deg or more)",
                of.name, of.lay_angle / degree, 2 * pi * of.helix_radius / std::tan(of.lay_angle),
                least_lay / degree),
            "radians instead of degrees",
            fmt::format("lay_angle_deg: {:.3g} if that was radians, or 0", of.lay_angle / degree / degree));
      if (const double pressure = of.radial_line_load.value_or(0) / (2 * of.radius);
          pressure > strongest_jacket)
        add(of.where,
            fmt::format(
                "radial_line_load_N_per_m of '{}' is {:.4g}, {:.3g} MPa on its width (limit {:g}: jackets yield)",
                of.name, *of.radial_line_load, pressure / 1e6, strongest_jacket / 1e6),
            "another unit", "a jacket's 0.05 MPa times the part's width, or no key");
      if (of.friction.value_or(0) > largest_friction)
        add(of.where, fmt::format("friction_coefficient of '{}' is {:.3g} (limit {:g})", of.name, *of.friction, largest_friction),
            "per cent instead of a share",
            fmt::format("friction_coefficient: {:.3g} if that was per cent", *of.friction / 100));
      for (std::size_t other = 0; other < k; ++other)
        if (components[other].name == of.name && components[other].layer == of.layer)
          add(of.where,
              fmt::format("two parts side by side are named '{}' (the other: line {})", of.name,
                          components[other].where.line),
              "a copied entry", "another name, or layer: NAME; results do not distinguish equal names");
      parts(of.components);
    }
  }

 private:
  std::vector<Warning>& warnings_;
};

/// Diameters, bend radius and torsion beside each other, and what parts have.
void plausible_size(const Dresspack& dresspack, Judge& judge) {
  const double diameter = dresspack.diameter;
  if (diameter > widest_hose || diameter < thinnest_cable)
    judge.add(dresspack.where,
              fmt::format("diameter_mm is {:.4g} (limits {:g} .. {:g})", 1e3 * diameter, 1e3 * thinnest_cable, 1e3 * widest_hose),
              diameter > widest_hose ? "tenths of a millimetre, or an extra zero" : "centimetres or metres",
              diameter > widest_hose ? fmt::format("diameter_mm: {:.4g} if there is an extra zero", 1e2 * diameter)
                                     : fmt::format("diameter_mm: {:.4g} if that was metres", 1e6 * diameter));
  if (dresspack.inner_diameter) {
    const double wall = (diameter - *dresspack.inner_diameter) / 2;
    if (wall > thickest_wall * diameter || wall < thinnest_wall)
      judge.add(dresspack.where,
                fmt::format("the wall is {:.3g} mm thick by diameter_mm and inner_diameter_mm (limits {:.3g} .. {:.3g})", 1e3 * wall,
                            1e3 * thinnest_wall, 1e3 * thickest_wall * diameter),
                "one of the two diameters in another unit or of another hose",
                fmt::format("inner_diameter_mm: {:.3g} (ESTIMATE), or diameter_mm as measured", 1e3 * usual_bore_share * diameter));
  }
  if (dresspack.least_bend_radius && *dresspack.least_bend_radius > largest_bend_radius * diameter)
    judge.add(dresspack.where,
              fmt::format("least_bend_radius_mm is {:.4g} (limit {:.4g}: {:g} diameters)", 1e3 * *dresspack.least_bend_radius,
                          1e3 * largest_bend_radius * diameter, largest_bend_radius),
              "an extra zero", fmt::format("least_bend_radius_mm: {:.4g} if there is an extra zero", 1e2 * *dresspack.least_bend_radius));
  if (const double share = dresspack.torsional_stiffness / dresspack.bending_stiffness;
      dresspack.bending_stiffness > 0 && dresspack.torsional_stiffness > 0 && !(share > least_torsion && share < most_torsion))
    judge.add(dresspack.where,
              fmt::format("torsional_stiffness_Nm2 is {:.3g} times bending_stiffness_Nm2 (limits {:g} .. {:g})", share, least_torsion,
                          most_torsion),
              "one of the two in another unit", "torsional_stiffness_Nm2: from_construction, or both as measured");
  for (const Component& of : dresspack.components) {
    if (of.laying.slack > 100 * largest_slack)
      judge.add(of.where, fmt::format("slack_percent of '{}' is {:.3g} (limit {:g})", of.name, of.laying.slack, 100 * largest_slack),
                "millimetres in a metre instead of per cent", fmt::format("slack_percent: {:.3g} if that was mm in a metre", of.laying.slack / 10));
    for (const auto& [key, grip] : {std::pair{"base_grip_N", of.laying.base_grip}, {"tool_grip_N", of.laying.tool_grip}})
      if (grip && *grip > largest_grip)
        judge.add(of.where, fmt::format("{} of '{}' is {:.3g} (limit {:g})", key, of.name, *grip, largest_grip), "another unit",
                  fmt::format("no {}: then the clamp holds the cable", key));
  }
}

}  // namespace

std::vector<Warning> plausibility_warnings(const Dresspack& dresspack) {
  std::vector<Warning> warnings;
  Judge judge(warnings);
  const double mass = dresspack.mass_per_length, section = pi / 4 * dresspack.diameter * dresspack.diameter;
  const double least = least_wire_mass(dresspack.components);
  // Beside what its parts have, a hose is filled at most with steel braid and rubber. Without parts it may be anything.
  const double built = dresspack.components.empty() ? 0 : mass_of_construction(dresspack);
  const double most = built > 0 ? built + heaviest_filling * section : copper * section;
  if (mass > most)
    judge.add(dresspack.where,
              fmt::format("mass_kg_per_m is {:.4g} (limit {:.3g}: {})", mass, most,
                          built > 0 ? "its parts, and diameter_mm filled with rubber and steel braid" : "solid copper of diameter_mm"),
              mass < least_grams ? "the mass of the whole dresspack, or diameter_mm in another unit"
                                 : "grams instead of kilograms, or diameter_mm in another unit",
              fmt::format("mass_kg_per_m: {:.4g} if that was g/m{}; or check diameter_mm: {:.4g}", mass / 1000,
                          built > 0 ? fmt::format(", {:.3g} by its parts and wall", built) : "", 1e3 * dresspack.diameter));
  if (mass > 0 && mass < least)
    judge.add(dresspack.where,
              fmt::format("mass_kg_per_m is {:.3g} (limit {:.3g}: its wires, if they were of aluminium)",
                          mass, least),
              "another unit, or the empty hose", "mass_kg_per_m of the filled hose, or from_construction");
  const double ratio = pi * swing_frequency * dresspack.damping_time;
  if (!dresspack.damping_source.empty() && (ratio < least_ratio || ratio > most_ratio))
    judge.add(
        dresspack.where,
        fmt::format(
            "damping_time_ms is {:.3g} (limits {:.2g} .. {:.3g}: a damping ratio of {:g} to {:g} at {:g} Hz)",
            1e3 * dresspack.damping_time, 1e3 * least_ratio / pi / swing_frequency,
            1e3 * most_ratio / pi / swing_frequency, least_ratio, most_ratio, swing_frequency),
        ratio < least_ratio ? "seconds instead of milliseconds, or no damping at all"
                            : "microseconds instead of milliseconds",
        "20 for a hose with cables, or the decay of its swing as measured");
  const auto beyond_solid = [&](const char* key, double value, double solid, const char* unit) {
    if (value > solid)
      judge.add(
          dresspack.where,
          fmt::format("{} is {:.3g} (limit {:.3g} {}: solid copper of diameter_mm)", key, value, solid, unit),
          "another unit, or diameter_mm in another unit",
          fmt::format("{} as measured, or from_construction", key));
  };
  const double second_moment = section * dresspack.diameter * dresspack.diameter / 16;
  beyond_solid("bending_stiffness_Nm2", dresspack.bending_stiffness, stiffest * second_moment, "N m2");
  beyond_solid("torsional_stiffness_Nm2", dresspack.torsional_stiffness, shear * 2 * second_moment, "N m2");
  beyond_solid("axial_stiffness_N", dresspack.axial_stiffness, stiffest * section, "N");
  constexpr double gravity = 9.81;
  const double weight = std::min(mass, most) * gravity;  // a mass that is doubtful does not make the stiffness doubtful
  if (dresspack.axial_stiffness > 0 && weight > most_stretch * dresspack.axial_stiffness)
    judge.add(
        dresspack.where,
        fmt::format(
            "axial_stiffness_N is {:.3g} (limit {:.3g} or more: {:g} % of stretch by the weight of a metre)",
            dresspack.axial_stiffness, weight / most_stretch, 100 * most_stretch),
        "kilonewtons instead of newtons",
        fmt::format("axial_stiffness_N: {:.3g} if that was kN, or from_construction",
                    1000 * dresspack.axial_stiffness));
  if (dresspack.least_bend_radius && *dresspack.least_bend_radius < dresspack.diameter / 2)
    judge.add(
        dresspack.where,
        fmt::format("least_bend_radius_mm is {:.3g} (limit {:.3g}: half of diameter_mm)",
                    1e3 * *dresspack.least_bend_radius, 1e3 * dresspack.diameter / 2),
        "metres instead of millimetres",
        fmt::format("least_bend_radius_mm: {:.3g} if that was metres", 1e6 * *dresspack.least_bend_radius));
  plausible_size(dresspack, judge);
  for (const Component& of : dresspack.components)
    if (of.laying.play.value_or(0) > dresspack.diameter / 2)
      judge.add(of.where,
                fmt::format("play_mm of '{}' is {:.4g} (limit {:.3g}: half of diameter_mm)", of.name,
                            1e3 * *of.laying.play, 1e3 * dresspack.diameter / 2),
                "another unit", "no play_mm: it follows from the bore");
  judge.parts(dresspack.components);
  return warnings;
}

}  // namespace dresslife::pipeline
