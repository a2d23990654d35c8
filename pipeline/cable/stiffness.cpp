#include "pipeline/cable/stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/corrugation.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/cable/polymer.h"
#include "pipeline/job/parts_room.h"

namespace dresslife::pipeline {
namespace {

constexpr double copper_density = 8900;      // [kg/m3], of a wire whose material has none; plausible.cpp warns
constexpr double torsion_of_core = 0.8;      // ESTIMATE: that of a solid round bar
constexpr double gravity = 9.81;             // [m/s2]
constexpr double believable_stretch = 1e-3;  // by the hose's own weight; hoses of polyamide have 1e-4 and less
constexpr double stiffest_cable =
    8;  // twice the largest ratio of bending tests of cables to their calculation, 3.7 (strain/measurements.md)
constexpr double believable = 2;  // twice the E I changed lives of shipped jobs by a factor of up to five

bool is_hose(const Dresspack& dresspack) { return inner_radius(dresspack).has_value(); }

/// Returns E I of all polymer in the dresspack. A dresspack that is no hose is a cable of parts in a jacket, or contains a single
/// cable.
double polymer_of(const Dresspack& dresspack) {
  const std::vector<Component>& parts = dresspack.components;
  const double sum = sum_of(parts, [](const Component& part) {
    return part.count * (part.plain ? properties_of(*part.plain, part.radius).bending : polymer_bending(part));
  });
  const bool is_cable = parts.size() == 1 && parts[0].count == 1 && parts[0].helix_radius == 0;
  return is_hose(dresspack) || (is_cable && !parts[0].components.empty())
             ? sum
             : dresspack.stiffness_factor * jacket_bending(dresspack.diameter / 2);
}

bool knows_wall(const Dresspack& dresspack) {
  return dresspack.hose_corrugation || (dresspack.inner_diameter && !dresspack.hose_strain_factor);
}

HoseStiffness wall_of(const Dresspack& dresspack) {
  const Material* const material = find_material(dresspack, dresspack.hose_material);
  if (material == nullptr || !knows_wall(dresspack)) return {};
  const double E = dresspack.stiffness_factor * material->youngs_modulus, G = E / (2 * (1 + material->poisson_ratio));
  if (!dresspack.hose_corrugation) {
    const double outer = dresspack.diameter / 2, inner = *dresspack.inner_diameter / 2;
    const double I = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
    return {E * I, G * 2 * I, E * pi * (outer * outer - inner * inner)};
  }
  const Corrugation& profile = *dresspack.hose_corrugation;
  const Fold fold = fold_of(profile);
  const double R = wall_factors(dresspack).radius;
  const double EA = 2 * pi * R * profile.pitch * E * std::pow(profile.wall, 3) / (48 * fold.compliance);
  return {EA * R * R / 2, 2 * pi * R * R * R * profile.wall * G * profile.pitch / fold.unfolded(), EA};
}

double density_of(const Dresspack& dresspack, std::string_view material, double otherwise) {
  const Material* const of = find_material(dresspack, material);
  return of ? of->density.value_or(otherwise) : otherwise;
}

/// Adds the mass of the wires minus that of the polymer that they displace [kg/m].
void add_wires(const Dresspack& dresspack, const Component& part, double count, double cosines, double& mass) {
  count *= part.count;
  cosines *= std::cos(part.lay_angle);
  for (const Component& inner : part.components) add_wires(dresspack, inner, count, cosines, mass);
  if (!part.components.empty()) return;
  const double area = count * pi * part.radius * part.radius;
  mass += (density_of(dresspack, part.material, copper_density) - polymer_density) * area / cosines;
}

/// Returns the cross-section of the wall [m2].
double section_of_wall(const Dresspack& dresspack) {
  if (dresspack.hose_corrugation) {
    const Corrugation& profile = *dresspack.hose_corrugation;
    return pi * (dresspack.diameter - profile.height) * profile.wall * fold_of(profile).unfolded() / profile.pitch;
  }
  return pi / 4 * (dresspack.diameter * dresspack.diameter - *dresspack.inner_diameter * *dresspack.inner_diameter);
}

HoseStiffness core_of(const Dresspack& dresspack) {
  const double bending = dresspack.core_bending_stiffness.value_or(0);
  return {bending, dresspack.core_torsional_stiffness.value_or(torsion_of_core * bending),
          dresspack.core_axial_stiffness.value_or(0)};
}

/// Returns a cable that consists of this layer only.
Component alone(const Component& layer) {
  Component cable;
  cable.components = {layer};
  return cable;
}

Component whole(const Dresspack& dresspack) {
  Component all;
  all.components = dresspack.components;
  return all;
}

/// Resistance of the wires, computed once for all states.
class Wires {
 public:
  explicit Wires(const Dresspack& dresspack) : bending_(dresspack, whole(dresspack), StraightParts::slide) {
    for (const Component& layer : dresspack.components) layers_.push_back(pull_and_twist(dresspack, alone(layer)));
  }
  double bending(SlipState state, double curvature) const {
    switch (state) {
      case SlipState::sliding:
        return bending_.free_stiffness();
      case SlipState::friction:
        return bending_.moment(curvature, 1) / curvature;
      case SlipState::stuck:
        return bending_.stuck_stiffness();
    }
    return 0;
  }
  /// Returns the moment by friction alone [N m].
  double friction(double curvature) const { return bending_.friction(curvature, 1); }
  const std::vector<PullAndTwist>& layers() const { return layers_; }

 private:
  CableBending bending_;
  std::vector<PullAndTwist> layers_;  ///< one for each layer of the dresspack
};

double pull_of_plain(const Component& part) {
  return part.plain ? part.count * properties_of(*part.plain, part.radius).axial * std::pow(std::cos(part.lay_angle), 3)
                    : 0;
}

HoseStiffness stiffness_with(const Wires& wires, const Dresspack& dresspack, SlipState state, double curvature) {
  const HoseStiffness wall = wall_of(dresspack), core = core_of(dresspack);
  const double polymer = polymer_of(dresspack);
  HoseStiffness sum{wall.bending + core.bending + polymer + wires.bending(state, curvature),
                    wall.torsional + core.torsional + torsion_of_polymer * polymer, wall.axial + core.axial};
  PullAndTwist together;  // of the parts that twist stretches
  for (std::size_t k = 0; k < dresspack.components.size(); ++k) {
    const PullAndTwist& of = wires.layers()[k];
    const bool pulls = state == SlipState::stuck || dresspack.components[k].laying.slack == 0;
    if (pulls) {
      together.pull_by_elongation += of.pull_by_elongation;
      together.coupling += of.coupling;
      together.torque_by_twist += of.torque_by_twist;
    } else {
      sum.torsional += of.relaxed();
    }
    sum.axial += pulls ? of.pull_by_elongation + pull_of_plain(dresspack.components[k]) : 0;
  }
  sum.torsional += is_single_cable(dresspack) ? together.relaxed() : together.torque_by_twist;
  return sum;
}

/// Returns the friction of a bend as elements. Their sum equals the friction's share of M(kappa) at the curvatures of the
/// elements and is smaller between them. There are up to four. At the first curvature a third of all friction acts; if this is
/// larger, it is the curvature at which the elements together are nine times as stiff as the sliding hose. At the others, 50, 85
/// and 99.5 % of the remaining friction act. sliding: E I of the hose [N m2].
std::vector<BendingFriction> friction_of(const Wires& wires, double sliding) {
  constexpr double all = 1e4;     // [1/m]: nothing in a cable sticks up to this curvature
  constexpr double stiffest = 9;  // with more, the implicit part of (S3) slows swings of 5 Hz by more than 10 % at 5 ms
  constexpr double first_share = 0.33;
  const double most = wires.friction(all);
  if (!(most > 1e-9 * sliding)) return {};
  // Finds a curvature: where the friction's moment reaches a share of all friction, or where its secant falls to a limit. Both
  // are monotonic.
  const auto where = [&](const auto& reached) {
    double low = 1e-6, high = all;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = std::sqrt(low * high);
      (reached(middle) ? high : low) = middle;
    }
    return high;
  };
  const auto holds = [&](double moment) { return where([&](double k) { return wires.friction(k) >= moment; }); };
  std::vector<double> at{std::max(holds(first_share * most),
                                  where([&](double k) { return wires.friction(k) <= stiffest * sliding * k; }))};
  const double first = wires.friction(at.front());
  for (const double share : {0.5, 0.85, 0.995}) at.push_back(holds(first + share * (most - first)));
  std::vector<BendingFriction> elements;
  double before = 0, moment_before = 0, slope_before = 0;
  for (const double k : at) {
    const double moment = wires.friction(k), slope = (moment - moment_before) / (k - before);
    if (moment - moment_before < 1e-3 * most) continue;       // if a stiff element has almost all friction
    const bool straight = slope > (1 - 1e-6) * slope_before;  // within the halvings: nothing slides between the two
    if (!elements.empty() && straight)
      elements.pop_back();
    else if (!elements.empty())
      elements.back().stiffness = slope_before - slope;
    elements.push_back({slope, k});
    before = k, moment_before = moment, slope_before = slope;
  }
  return elements;
}

std::string state_words(const Dresspack& dresspack) {
  const std::string state(word(dresspack.construction_state));
  return dresspack.construction_state == SlipState::friction
             ? fmt::format("{} at {:.3g} 1/m", state, dresspack.construction_curvature)
             : state;
}

}  // namespace

double mass_of_part(const Dresspack& dresspack, const Component& part) {
  if (part.plain) return properties_of(*part.plain, part.radius).mass;
  const double area = pi * part.radius * part.radius;
  if (is_wire(part)) return density_of(dresspack, part.material, copper_density) * area;
  double mass = polymer_density * area;
  for (const Component& inner : part.components) add_wires(dresspack, inner, 1, 1, mass);
  return mass;
}

double mass_of_construction(const Dresspack& dresspack) {
  double mass = 0, parts = 0;
  if (is_hose(dresspack))
    mass += density_of(dresspack, dresspack.hose_material, polymer_density) * section_of_wall(dresspack);
  if (is_hose(dresspack) && dresspack.sleeve)
    mass += density_of(dresspack, dresspack.sleeve->material, polymer_density) * pi * dresspack.sleeve->thickness *
            (dresspack.diameter + dresspack.sleeve->thickness);
  for (const std::vector<Component>& inside : {dresspack.components, dresspack.core_components})
    for (const Component& part : inside) {
      mass += part.count * part.laying.mass.value_or(mass_of_part(dresspack, part)) / std::cos(part.lay_angle);
      parts += part.count * pi * part.radius * part.radius / std::cos(part.lay_angle);
    }
  const double left = pi / 4 * dresspack.diameter * dresspack.diameter - parts;
  return is_hose(dresspack) ? mass : mass + polymer_density * std::max(left, 0.0);
}

HoseStiffness stiffness_of_construction(const Dresspack& dresspack, SlipState state, double curvature) {
  return stiffness_with(Wires(dresspack), dresspack, state, curvature);
}

std::vector<double> bending_moments(const Dresspack& dresspack, double friction, const std::vector<double>& curvature) {
  const Wires wires(dresspack);
  const double sliding = stiffness_with(wires, dresspack, SlipState::sliding, 1).bending;
  std::vector<double> moments;
  for (const double k : curvature)  // for twice the friction, the moment is doubled at twice the curvature
    moments.push_back(sliding * k + (friction > 0 ? friction * wires.friction(k / friction) : 0));
  return moments;
}

std::string missing_wall(const Dresspack& dresspack) {
  const bool hose = is_hose(dresspack);
  if (!dresspack.bending_from_construction || (hose && !dresspack.hose_material.empty() && knows_wall(dresspack)))
    return "";
  if (!hose && !room_of_parts(dresspack).estimated) return "";
  const std::string profile = dresspack.hose_corrugation ? "" : corrugation_line(usual_corrugation(dresspack));
  const std::string material = dresspack.hose_material.empty() ? "hose_material: hose_polyamide" : "";
  return material + (material.empty() || profile.empty() ? "" : " and ") + profile;
}

std::vector<std::string> missing_in_construction(const Dresspack& dresspack) {
  std::vector<std::string> missing;
  if (dresspack.core_diameter > 0 && !dresspack.core_bending_stiffness)
    missing.push_back(
        fmt::format("what fills its core of {:.3g} mm (core_bending_stiffness_Nm2)", 1e3 * dresspack.core_diameter));
  if (is_hose(dresspack) && dresspack.hose_material.empty())
    missing.push_back("its wall (hose_material)");
  else if (is_hose(dresspack) && !knows_wall(dresspack))
    missing.push_back("its wall (hose_corrugation)");
  return missing;
}

void take_from_construction(Dresspack& dresspack) {
  if (!is_from_construction(dresspack) && !lacks_friction(dresspack)) return;
  if (dresspack.mass_from_construction) dresspack.mass_per_length = mass_of_construction(dresspack);
  const Wires wires(dresspack);
  const HoseStiffness taken =
      stiffness_with(wires, dresspack, dresspack.construction_state, dresspack.construction_curvature);
  if (lacks_friction(dresspack)) {
    // A number below that of the construction has the construction's share of friction, so that something elastic is left. A number
    // above it has a stiffer wall or polymer, which has no friction.
    const double friction = wires.friction(dresspack.construction_curvature) / dresspack.construction_curvature,
                 given = dresspack.bending_stiffness, share = std::min(1.0, given / taken.bending);
    // Less friction changes the damping by less than the uncertainty of loss_factor, a factor of two of 0.3. It is left out: then
    // the motion depends on no cable, and dresspacks with other cables share it.
    constexpr double negligible = 0.1;
    if (share * friction > negligible * given)
      dresspack.bending_friction = friction_of(wires, given / share - friction);
    for (BendingFriction& element : dresspack.bending_friction) element.stiffness *= share;
  }
  const auto take = [&](bool wanted, const char* key, double value, double& to) {
    if (!wanted) return;
    if (!(value > 0))
      throw InputError(
          dresspack.where,
          fmt::format("dresspack.{} is from_construction, which has none (no part, wall or core of it carries)", key),
          fmt::format("give {}, components with wires, hose_material and its profile, or the core's", key));
    to = value;
  };
  take(dresspack.bending_from_construction, "bending_stiffness_Nm2", taken.bending, dresspack.bending_stiffness);
  if (dresspack.bending_from_construction) {
    dresspack.bending_friction.clear();
    if (dresspack.construction_state == SlipState::friction)
      dresspack.bending_friction = friction_of(wires, stiffness_with(wires, dresspack, SlipState::sliding, 1).bending);
  }
  take(dresspack.torsional_from_construction, "torsional_stiffness_Nm2", taken.torsional,
       dresspack.torsional_stiffness);
  take(dresspack.axial_from_construction, "axial_stiffness_N", taken.axial, dresspack.axial_stiffness);
}

namespace {

/// Returns a warning about stiffnesses from an incomplete construction.
std::optional<Warning> too_little(const Dresspack& dresspack, const std::vector<std::string>& missing) {
  std::vector<std::string> taken, keys;
  const auto take = [&](bool from_construction, const char* key, double value) {
    if (!from_construction) return;
    taken.push_back(fmt::format("{} {:.3g}", key, value));
    keys.push_back(key);
  };
  take(dresspack.bending_from_construction, "bending_stiffness_Nm2", dresspack.bending_stiffness);
  take(dresspack.torsional_from_construction, "torsional_stiffness_Nm2", dresspack.torsional_stiffness);
  take(dresspack.axial_from_construction, "axial_stiffness_N", dresspack.axial_stiffness);
  if (taken.empty() || missing.empty()) return std::nullopt;
  const double stretch = gravity * dresspack.mass_per_length / dresspack.axial_stiffness;
  const std::string soft =
      dresspack.axial_from_construction && stretch > believable_stretch
          ? fmt::format("; it would stretch by {:.2g} % (limit {:g} %) under a metre of its own weight", 100 * stretch,
                        100 * believable_stretch)
          : "";
  const bool wall = is_hose(dresspack) && dresspack.hose_material.empty();
  const std::string profile = dresspack.hose_corrugation ? ""
                                                         : fmt::format(" and {} (ESTIMATE) if it is corrugated",
                                                                       corrugation_line(usual_corrugation(dresspack)));
  return warning_of(WarningKind::material, "",
                    fmt::format("too low: {} from the construction{}", joined(taken, ", "), soft),
                    fmt::format("the construction lacks {}", joined(missing, " and ")),
                    fmt::format("{}, or measured values of {}",
                                wall ? "hose_material: hose_polyamide (the wall's)" + profile : "the missing keys",
                                joined(keys, ", ")));
}

/// Returns a warning about a smooth wall that a mechanic cannot bend to its bend radius: the profile of a corrugated hose is
/// probably missing.
std::optional<Warning> too_stiff_wall(const Dresspack& dresspack) {
  // [N m]: two hands 0.1 m apart push with 100 N each, half of the limit of EN 1005-3 for pushing with the whole body. For
  // polyamide, a tube of 8/6 mm bent to 40 mm needs 6, the corrugated hose of config/dresspacks/handling.yaml (48 mm) bent to 200
  // mm needs 3.
  constexpr double by_hand = 10;
  if (dresspack.hose_material.empty() || dresspack.hose_corrugation || !knows_wall(dresspack)) return std::nullopt;
  const double wall = wall_of(dresspack).bending, radius = least_bend_radius(dresspack);
  if (!(wall / radius > by_hand)) return std::nullopt;
  Dresspack corrugated = dresspack;
  corrugated.hose_corrugation = usual_corrugation(dresspack);
  const Corrugation& usual = *corrugated.hose_corrugation;
  return warning_of(
      WarningKind::material, dresspack.where.text(),
      fmt::format(
          "the smooth wall of the hose ({:.4g} mm outside, {:.4g} mm inside) has E I {:.3g} N m2; to bend it to {:.4g} mm ({}) takes "
          "{:.3g} N m (limit {:g}: two hands, 100 N each, 0.1 m apart) and strains its surface by {:.2g} %",
          1e3 * dresspack.diameter, 1e3 * *dresspack.inner_diameter, wall, 1e3 * radius,
          dresspack.least_bend_radius ? "least_bend_radius_mm" : "ten diameters of the hose", wall / radius, by_hand,
          100 * dresspack.diameter / 2 / radius),
      "a corrugated hose without hose_corrugation: inner_diameter_mm alone means a smooth pipe",
      fmt::format(
          "{} (ESTIMATE: the wall's E I is then {:.3g} N m2, and least_bend_radius_mm as its maker states); of a smooth hose "
          "a hose_material with its own youngs_modulus_GPa",
          corrugation_line(usual), wall_of(corrugated).bending));
}

}  // namespace

std::vector<Warning> stiffness_warnings(const Dresspack& dresspack) {
  const double given = dresspack.bending_stiffness, curvature = dresspack.construction_curvature;
  if (dresspack.components.empty() || given <= 0) return {};
  const auto missing = missing_in_construction(dresspack);
  std::vector<Warning> warnings;
  if (const auto warning = too_little(dresspack, missing)) warnings.push_back(*warning);
  const auto wall = too_stiff_wall(dresspack);
  if (dresspack.bending_from_construction) {
    if (wall) warnings.push_back(*wall);
    return warnings;
  }
  const std::string without = missing.empty() ? "" : fmt::format(" without {}", joined(missing, " and "));
  const Wires wires(dresspack);
  const auto bending = [&](SlipState state) { return stiffness_with(wires, dresspack, state, curvature).bending; };
  const double sliding = bending(SlipState::sliding), friction = bending(SlipState::friction),
               stuck = bending(SlipState::stuck);
  // The stiffness of a jacket around parts, and how it holds them, are unknown for a cable.
  const double least = is_hose(dresspack) ? std::max(friction / believable, sliding) : sliding - polymer_of(dresspack);
  // A wall of unknown construction is at most as stiff as a solid bar of polyamide 66 (3.3 GPa dry, the stiffest without glass).
  constexpr double stiffest = 3.3e9;
  const double solid = stiffest * std::numbers::pi / 64 * std::pow(dresspack.diameter, 4);
  const double most = !missing.empty()     ? stuck + solid
                      : is_hose(dresspack) ? std::min(friction * believable, stuck)
                                           : std::min(friction * stiffest_cable, stuck);
  if (given >= least && given <= most) return warnings;
  if (wall) {  // the given stiffness may be right
    warnings.push_back(*wall);
    return warnings;
  }
  const std::string limits = fmt::format("{:.3g} .. {:.3g}", least, most);
  warnings.push_back(warning_of(
      WarningKind::material, "",
      fmt::format(
          "bending_stiffness_Nm2 is {:.3g} (limits {}); calculated from the dresspack's parts{}: {:.3g} at a curvature of "
          "{:.3g} 1/m ({:.3g} sliding .. {:.3g} glued)",
          given, limits, without, friction, curvature, sliding, stuck),
      "an estimate of the stiffness that does not belong to these parts, their friction and their pressures",
      fmt::format("bending_stiffness_Nm2: {:.3g} or from_construction; or measure it by the sag of a hanging length",
                  friction)));
  return warnings;
}

std::string stiffness_text(const Dresspack& dresspack) {
  if (dresspack.components.empty() && dresspack.hose_material.empty()) return "";
  const double curvature = dresspack.construction_curvature;
  const Wires wires(dresspack);
  const HoseStiffness sliding = stiffness_with(wires, dresspack, SlipState::sliding, curvature),
                      friction = stiffness_with(wires, dresspack, SlipState::friction, curvature),
                      stuck = stiffness_with(wires, dresspack, SlipState::stuck, curvature);
  std::string text;
  if (dresspack.mass_from_construction)
    text += fmt::format("mass {:.4g} kg/m from construction: wires by their densities in a polymer of {:.0f} kg/m3\n",
                        dresspack.mass_per_length, polymer_density);
  const auto line = [&](const char* name, const char* unit, double used, bool taken, double HoseStiffness::*of) {
    const std::string source = taken ? fmt::format("from construction ({})", state_words(dresspack)) : "given";
    text += used > 0 ? fmt::format("{} {:.4g} {} {}; ", name, used, unit, source) : fmt::format("{} [{}] ", name, unit);
    text += fmt::format("of its construction {:.3g} sliding, {:.3g} with friction at {:.3g} 1/m, {:.3g} glued\n",
                        sliding.*of, friction.*of, curvature, stuck.*of);
  };
  line("E I", "N m2", dresspack.bending_stiffness, dresspack.bending_from_construction, &HoseStiffness::bending);
  if (!dresspack.bending_from_construction && !dresspack.bending_friction.empty())
    text += fmt::format("friction holds {:.2g} N m2 of the given E I\n",
                        dresspack.bending_stiffness - elastic_bending_stiffness(dresspack));
  line("G J", "N m2", dresspack.torsional_stiffness, dresspack.torsional_from_construction, &HoseStiffness::torsional);
  line("E A", "N", dresspack.axial_stiffness, dresspack.axial_from_construction, &HoseStiffness::axial);
  const auto missing = missing_in_construction(dresspack);
  return missing.empty() ? text : text + fmt::format("without {}\n", joined(missing, " and "));
}

}  // namespace dresslife::pipeline
