#include "pipeline/job/dresspack.h"

#include <algorithm>

#include "pipeline/base/lists.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

namespace {

/// Keys of a component; only first-level components have them.
void describe(Fields& f, Laying& laying) {
  f.choice("position", laying.position,
           "Whether the part can move in the hose. held: it keeps its place. loose: it moves. auto: loose for a part "
           "that is no wire, may slide and has a lay angle of at most 20 deg, if the room in the hose is known "
           "(inner_diameter_mm or hose_corrugation).");
  f.number("slack_percent", laying.slack, Need::optional, between(0, 20),
           "The length of the part beyond its path in the hose at rest. Default for a loose part: 1, an "
           "ESTIMATE.");
  f.maybe_number("play_mm", laying.play, above(0),
                 "The distance that a loose part can move from its place. Default: the distance to the wall, the core "
                 "and the neighbours.");
  f.maybe_number("base_grip_N", laying.base_grip, above(0),
                 "The force at which the part slips in the base clamp. Default: it never slips.");
  f.maybe_number("tool_grip_N", laying.tool_grip, above(0),
                 "The force at which the part slips in the tool clamp. Default: it never slips.");
  f.maybe_number("mass_kg_per_m", laying.mass, above(0),
                 "The mass of a loose part or of a part without wires. Default: its wires with the densities of their "
                 "materials, in a polymer of 1200 kg/m3.");
}

}  // namespace

void describe(Fields& f, Component& component) {
  f.place(component.where);
  f.text("name", component.name, Need::required, "The name of the part. Equal parts are numbered from 1.");
  f.text(
      "entry", component.entry, Need::written,
      "The number of the part's entry in the list as written, in which place: auto divided entries. Key paths count these entries.");
  f.text("layer", component.layer, Need::optional,
         "The name of the layer, where several layers of equal parts lie over each other.");
  f.integer("count", component.count, Need::optional, between(1, 1000), "The number of equal parts in the layer (K).");
  f.number("radius_mm", component.radius, Need::required, above(0), "The radius of the part.");
  f.number(
      "helix_radius_mm", component.helix_radius, Need::required, at_least(0),
      "The distance from the parent's axis to the part's axis (R); a part that lies in the hose can have 'place: auto' instead.");
  f.number("lay_angle_deg", component.lay_angle, Need::optional, between(0, 60),
           "The angle between the part and the parent's axis (alpha).");
  f.choice("hand", component.hand, "The direction of the helix: right (Z) or left (S).");
  f.number("phase_deg", component.phase, Need::optional, between(-360, 360),
           "The angle of part 1 around the parent's axis at the base clamp.");
  f.maybe_number("friction_coefficient", component.friction, between(0, 1e6),
                 "The Coulomb friction of the part on its support. Default: 0.3, an ESTIMATE.");
  f.maybe_number(
      "radial_line_load_N_per_m", component.radial_line_load, at_least(0),
      "The force per length by which jacket and tape press the part on its support. Default: 0.17 MPa times the width "
      "of the part (ESTIMATE), or the pressure on its parent, and 0 for a cable in a hose.");
  f.number("tension_N", component.tension, Need::optional, at_least(0),
           "The tension at rest of a part with a lay inside of a cable. It presses the part on its support.");
  describe(f, component.laying);
  f.text("material", component.material, Need::optional,
         "The material of a wire: a name of config/materials. A part with components has none.");
  f.list("components", component.components, Need::optional, "The layers of parts inside this part.");
  f.maybe_group(
      "without_wires", component.plain,
      "The description of a part of the dresspack whose wires are not described, or which has none. It has mass, "
      "stiffness and a place. Only a cable or hose with ratings has a life.");
  f.number("jacket_stiffness_N_per_m2", component.jacket_stiffness, Need::optional, at_least(0),
           "The force per length and displacement by which a jacket holds the part along its path if it "
           "fills the gussets. It counts where strain.slip is friction.");
  f.maybe_number(
      "radial_stiffness_N_per_m2", component.radial_stiffness, above(0),
      "The radial stiffness of the part's support. Default: 5e7 (polymer) under the cores of a cable. Other supports "
      "are rigid. With strain.kinematics: thesis all are rigid.");
  f.maybe_number("measured_bending_stiffness_Nm2", component.measured_bending_stiffness, above(0),
                 "The measured bending moment over curvature of one part that has parts. It sets the level "
                 "of radial_line_load_N_per_m of everything inside, where strain.slip is friction.");
  f.number("measured_at_curvature_1_per_m", component.measured_at_curvature, Need::optional, above(0),
           "The curvature to which the straight part was bent in that test.");
  f.number("polymer_bending_stiffness_Nm2", component.polymer_bending_stiffness, Need::optional, at_least(0),
           "The share of the measured stiffness of jacket and insulation.");
  f.list(
      "ratings", component.ratings, Need::optional,
      "The cycles in test rigs that the maker of a cable or hose states. They give a life to a hose and to a cable without "
      "described wires.");
  f.maybe_group(
      "jacket", component.jacket,
      "The jacket of a cable in the dresspack, which may wear through on hose and neighbours. A data_sheet that "
      "names the jacket's material gives it. Default: its wear is not evaluated.");
}

void describe(Fields& f, Corrugation& corrugation) {
  f.place(corrugation.where);
  f.number("pitch_mm", corrugation.pitch, Need::required, above(0), "The length of one corrugation along the hose.");
  f.number("height_mm", corrugation.height, Need::required, above(0),
           "Half the difference of outer and inner diameter.");
  f.number("wall_mm", corrugation.wall, Need::required, above(0), "The thickness of the wall.");
}

void describe(Fields& f, Sleeve& sleeve) {
  f.place(sleeve.where);
  f.number("thickness_mm", sleeve.thickness, Need::required, above(0), "The thickness that may wear through.");
  f.text("material", sleeve.material, Need::required, "A material with `wear`: a name of config/materials.");
}

void describe(Fields& f, BendingFriction& friction) {
  f.number("stiffness_Nm2", friction.stiffness, Need::required, above(0),
           "The moment per curvature while the element holds.");
  f.number("slides_at_1_per_m", friction.slides_at, Need::required, above(0),
           "The change of curvature beyond which the element slides. Its moment is then the stiffness times this.");
}

void describe(Fields& f, Dresspack& dresspack) {
  f.place(dresspack.where);
  f.text("name", dresspack.name, Need::required, "The name of the dresspack.");
  f.text("source", dresspack.source, Need::required, "The source of the numbers.");
  f.text("estimates", dresspack.estimates, Need::written,
         "The keys that were left out and their estimated values. dresslife writes it into resolved jobs.");
  f.maybe_number("estimated_lay_factor", dresspack.estimated_lay_factor, between(least_lay_factor, most_lay_factor),
                 "The factor of the lay lengths that data sheets leave out, to see what they change. Default: 1.");
  f.boolean("cable_alone", dresspack.cable_alone, Need::written,
            "Whether it is a cable by itself. The form `cable:` sets it. Stiffness, mass and damping may then be "
            "left out where a rig or a deformation moves it.");
  const Need need = dresspack.cable_alone ? Need::optional : Need::required;
  const Range range = dresspack.cable_alone ? at_least(0) : above(0);
  constexpr Range up_to_a_metre{0, 1000,
                                true};  // no robot carries more, and the search for contacts takes minutes then
  f.number("diameter_mm", dresspack.diameter, Need::required, up_to_a_metre, "The outer diameter of the hose.");
  constexpr std::string_view from = "from_construction";
  f.number_or_word("mass_kg_per_m", dresspack.mass_per_length, dresspack.mass_from_construction, from, need, range,
                   "The mass of the filled hose. from_construction: the sum of its parts, its wall and its sleeve.");
  f.number_or_word(
      "bending_stiffness_Nm2", dresspack.bending_stiffness, dresspack.bending_from_construction, from, need, range,
      "E I of the filled hose. from_construction: it is computed from parts, wall and core in construction_state. In "
      "the state friction the simulation adds the friction of the parts.");
  f.number_or_word("torsional_stiffness_Nm2", dresspack.torsional_stiffness, dresspack.torsional_from_construction,
                   from, need, range, "G J of the filled hose. from_construction: as for bending.");
  f.number_or_word("axial_stiffness_N", dresspack.axial_stiffness, dresspack.axial_from_construction, from, need, range,
                   "E A of the filled hose. from_construction: as for bending.");
  f.choice("construction_state", dresspack.construction_state,
           "The state of the parts for a stiffness from_construction: they slide freely, with friction, or not "
           "at all.");
  f.number("construction_curvature_1_per_m", dresspack.construction_curvature, Need::optional, between(1e-3, 100),
           "The curvature of the hose for construction_state friction. The larger it is, the more parts "
           "slide.");
  f.maybe_number("core_bending_stiffness_Nm2", dresspack.core_bending_stiffness, at_least(0),
                 "E I of the filling in the middle that is no component. It counts where a stiffness is "
                 "from_construction.");
  f.maybe_number("core_torsional_stiffness_Nm2", dresspack.core_torsional_stiffness, at_least(0),
                 "G J of that filling. Default: 0.8 of its E I, as of a solid round bar.");
  f.maybe_number("core_axial_stiffness_N", dresspack.core_axial_stiffness, at_least(0),
                 "E A of that filling. It is 0 for a filling with slack.");
  f.number("rest_curvature_1_per_m", dresspack.rest_curvature, Need::optional, any_number(),
           "The curvature of the delivered hose without load, toward the x axis of its base clamp. "
           "base_clamp.roll_deg turns it. The parts are free of strain in that shape.");
  f.number("damping_time_ms", dresspack.damping_time, need, at_least(0),
           "The Kelvin-Voigt time of twist and, without loss_factor, of bending, from a decay test.");
  f.maybe_number(
      "loss_factor", dresspack.loss_factor, between(0, 0.7),
      "The loss factor of bending without friction, the same from 0.8 to 30 Hz: twice the damping ratio of a "
      "swing against bending alone. The stiffness without friction is then that at 1 Hz.");
  if (!dresspack.bending_from_construction)
    f.list(
        "bending_friction", dresspack.bending_friction, Need::optional,
        "The part of bending_stiffness_Nm2 that is friction, as at most four elements. bending_stiffness_Nm2 is then "
        "moment over curvature of the first bend to construction_curvature_1_per_m. The key needs a stiffness as a "
        "number. Default: the friction of the parts if that is more than a tenth; none with construction_state: sliding.");
  f.text("damping_source", dresspack.damping_source, need, "The source of the damping. The life depends on it.");
  f.number("friction_coefficient", dresspack.friction, Need::optional, between(0, 2),
           "The Coulomb friction of the hose on the robot. Between two dresspacks the smaller one counts. "
           "Default with components: 0.3, an ESTIMATE.");
  f.maybe_number(
      "least_bend_radius_mm", dresspack.least_bend_radius, above(0),
      "The smallest bend radius that the maker allows in motion. A smaller one causes a warning, and counts as a kink of a smooth hose. "
      "Default: ten diameters, in a corrugated hose those of its parts and at least three of the hose.");
  f.place_of("least_bend_radius_mm", dresspack.least_bend_radius_where);
  f.maybe_number("most_twist_deg_per_m", dresspack.most_twist, above(0),
                 "The largest twist that the maker allows in motion. More causes a warning. Default: 180.");
  f.maybe_number("most_tension_N", dresspack.most_tension, above(0),
                 "The largest tension of the filled hose that the maker allows in motion. More causes a warning. "
                 "Default: no limit.");
  f.text("hose_material", dresspack.hose_material, Need::optional,
         "The material of the hose's wall: a name of config/materials. Without it the wall's strain is not "
         "evaluated.");
  f.maybe_number("hose_strain_factor", dresspack.hose_strain_factor, between(1e-3, 100),
                 "The strain of the wall over that of a smooth hose of the same diameter. Default: 1, or the factor of "
                 "hose_corrugation.");
  f.maybe_group("hose_corrugation", dresspack.hose_corrugation,
                "The profile of the hose's wall. It gives the strain factor of the wall.");
  f.maybe_number("inner_diameter_mm", dresspack.inner_diameter, above(0),
                 "The inner diameter of a hose with loose parts. Default: the one of hose_corrugation. Without both a "
                 "jacket holds the parts.");
  f.number("core_diameter_mm", dresspack.core_diameter, Need::optional, at_least(0),
           "The diameter of the filling in the middle of a hose that is no component.");
  f.text("core_parts", dresspack.core_parts, Need::optional,
         "The parts in this filling, in words. Results name them as not evaluated.");
  f.maybe_group(
      "sleeve", dresspack.sleeve,
      "A sleeve over the hose, or the jacket of a cable without a hose, that may wear through. Default: the wall "
      "of hose_corrugation, or the `jacket` of the cable.");
  f.list("components", dresspack.components, Need::optional,
         "The parts in the hose. Without them only the motion is computed. `place: auto` instead of "
         "helix_radius_mm and phase_deg packs parts into the bore.");
  f.list("core_components", dresspack.core_components, Need::optional,
         "The parts in the filling of the core, instead of core_parts: hoses, which may kink, and cables with ratings. "
         "The keys core_.. give the stiffness of the filling, mass_kg_per_m contains its mass.");
  f.list("materials", dresspack.materials, Need::optional, "Materials that are not in config/materials.");
  f.list("ratings", dresspack.ratings, Need::optional,
         "The cycles in test rigs that the maker states, of a dresspack that is one cable without a hose.");
}

double elastic_bending_stiffness(const Dresspack& dresspack) {
  double elastic = dresspack.bending_stiffness;
  for (const BendingFriction& friction : dresspack.bending_friction)
    elastic -= friction.stiffness * std::min(1.0, friction.slides_at / dresspack.construction_curvature);
  return elastic;
}

std::optional<double> inner_radius(const Dresspack& dresspack) {
  if (dresspack.inner_diameter) return *dresspack.inner_diameter / 2;
  if (dresspack.hose_corrugation) return dresspack.diameter / 2 - dresspack.hose_corrugation->height;
  return {};
}

bool lies_loose(const Dresspack& dresspack, const Component& component) {
  switch (component.laying.position) {
    case Position::held:
      return false;
    case Position::loose:
      return true;
    case Position::automatic:
      return inner_radius(dresspack) && component.lay_angle <= steepest_loose_lay && !is_wire(component);
  }
  return false;
}

const Material* find_material(const Dresspack& dresspack, std::string_view name) {
  return find_in(dresspack.materials, &Material::name, name);
}

bool is_hose_wall(const Dresspack& dresspack, std::string_view component) {
  return !dresspack.hose_material.empty() && component.starts_with(hose_wall_name) &&
         component.find_first_not_of("0123456789", hose_wall_name.size() + 1) == std::string_view::npos &&
         component.size() > hose_wall_name.size() + 1 && component[hose_wall_name.size()] == ' ';
}

namespace {

void check_plain(const Component& part, const Component* parent, Problems& problems) {
  problems.attempt("", part.where, [&] { check_plain_part(*part.plain, part.radius, part.name); });
  if (parent)
    problems.add(part.where, fmt::format("'{}' is without wires and lies in '{}'", part.name, parent->name),
                 "leave it out: what a cable holds beside its wires counts as polymer");
  if (!part.material.empty() || !part.components.empty())
    problems.add(
        part.where,
        fmt::format("'{}' is without wires and has {}", part.name, part.material.empty() ? "components" : "a material"),
        "leave out one of the two");
  if (part.measured_bending_stiffness || part.polymer_bending_stiffness > 0)
    problems.add(part.where, fmt::format("'{}' is without wires and has a cable's stiffness", part.name),
                 "give without_wires.bending_stiffness_Nm2");
  if (part.plain->kind == PlainKind::cable && !part.laying.mass)
    problems.add(part.where, fmt::format("cable '{}' without described wires has no mass_kg_per_m", part.name),
                 "give it: data sheets state it");
}

/// Refuses a tension that has no effect. Tension presses a helix on its support. Along a cable in the hose friction acts with the
/// forces of its path (strain/loose/tension.h). parent: null for a part of the dresspack.
void check_tension(const Component& part, const Component* parent, Problems& problems) {
  const bool whole = !parent && !is_wire(part);
  if (part.tension == 0 || (!whole && part.lay_angle > 0)) return;
  problems.add(part.where,
               fmt::format("tension_N of '{}' is {:.4g} (limit 0: {})", part.name, part.tension,
                           whole ? "a part right in the dresspack is pulled by its path and its slack"
                                 : "a part without a lay does not press on its support"),
               whole ? "remove it, or give slack_percent, the length of the part beyond its path"
                     : "remove it, or give lay_angle_deg");
}

/// parent: null for a part of the dresspack. Returns the number of levels of parts, including this one.
int check_component(const Component& component, const Component* parent, Problems& problems) {
  const Where& where = component.where;
  if (component.plain)
    check_plain(component, parent, problems);
  else if (component.components.empty() == component.material.empty())
    problems.add(
        where, fmt::format("'{}' must have either a material (a wire) or components", component.name),
        parent ? "give one of the two" : "give one of the two, or without_wires: {kind: hose, fibre, filler or cable}");
  if (component.count > 1 && component.helix_radius == 0)
    problems.add(where,
                 fmt::format("{} parts '{}' lie on the axis (helix_radius_mm is 0)", component.count, component.name),
                 "give their distance from the axis");
  if (component.helix_radius == 0 && component.lay_angle != 0)
    problems.add(where, fmt::format("'{}' on the axis has a lay angle", component.name), "set lay_angle_deg to 0");
  if (component.name.find('/') != std::string::npos || component.layer.find('/') != std::string::npos)
    problems.add(where, fmt::format("name '{}' holds a '/'", component.name), "choose another name");
  check_tension(component, parent, problems);
  const double reach = component.helix_radius + component.radius;
  if (parent && reach > parent->radius * (1 + caliper_error))
    problems.add(
        where,
        fmt::format("'{}' reaches {:.4g} mm from the axis of '{}', {:.3g} mm outside it (radius {:.4g} mm)",
                    component.name, 1e3 * reach, parent->name, 1e3 * (reach - parent->radius), 1e3 * parent->radius),
        "check helix_radius_mm and radius_mm");
  return 1 + largest_of(component.components, 0,
                        [&](const Component& inner) { return check_component(inner, &component, problems); });
}

/// Checks that a thin wall with round crests and roots fits the profile (corrugation.h).
void check_hose(const Dresspack& dresspack) {
  if (!dresspack.hose_corrugation || !(dresspack.diameter > 0)) return;  // a refused diameter is another problem
  const Corrugation& c = *dresspack.hose_corrugation;
  if (dresspack.hose_strain_factor)
    throw InputError(c.where, "both hose_strain_factor and hose_corrugation are given", "keep one of the two");
  const auto refuse = [&](const char* key, double value, const char* bound, double limit, const char* why,
                          const std::string& remedy) {
    throw InputError(c.where,
                     fmt::format("{} of hose_corrugation is {:.4g} (must be {} {:.4g} mm: {})", key, 1e3 * value, bound,
                                 1e3 * limit, why),
                     remedy);
  };
  const auto refuse_more = [&](const char* key, double value, double limit, const char* why) {
    if (value <= limit) return;
    const std::string slip =
        value <= 10 * limit ? fmt::format("give {}: {:.4g} if a decimal point was lost; or ", key, 1e2 * value) : "";
    refuse(key, value, "at most", limit, why, slip + "measure the profile, or give hose_strain_factor instead");
  };
  refuse_more("wall_mm", c.wall, c.pitch / 4, "a quarter of the pitch; wall_mm is the thickness of the plastic");
  refuse_more("height_mm", c.height, dresspack.diameter / 2, "half of the hose's diameter_mm");
  if (c.height - c.wall < c.pitch / 2)
    refuse(
        "height_mm", c.height, "at least", c.pitch / 2 + c.wall,
        "wall_mm plus half of the pitch; height_mm is that of a crest over a root",
        "measure the profile, or give hose_strain_factor and inner_diameter_mm instead: a shallow profile is not evaluated");
}

bool hold_wires(const std::vector<Component>& parts) {
  return std::ranges::any_of(parts, [](const Component& part) { return is_wire(part) || hold_wires(part.components); });
}

/// Checks the keys of laying: a loose part needs a known space and must be straight; deeper parts and wires cannot be loose.
void check_laying(const Dresspack& dresspack, const Component& component, bool first_level) {
  const Laying& laying = component.laying;
  const bool lone = is_wire(component);
  if (!(laying == Laying{}) && (!first_level || lone))
    throw InputError(component.where,
                     fmt::format("'{}' has position, slack, play, grip or mass (they are of cables right in the "
                                 "dresspack; this is {})",
                                 component.name, lone ? "a wire" : "a part of a cable"),
                     "give them to the cable");
  for (const Component& inner : component.components) check_laying(dresspack, inner, false);
  if (!first_level || !lies_loose(dresspack, component)) return;
  if (component.lay_angle > steepest_loose_lay)
    throw InputError(
        component.where,
        fmt::format("'{}' is loose and has a lay angle of {:g} deg (a loose cable's path is known where it is "
                    "nearly along the hose, up to {:g} deg)",
                    component.name, std::numbers::inv_pi * 180 * component.lay_angle,
                    std::numbers::inv_pi * 180 * steepest_loose_lay),
        "give it a longer lay, or position: held");
  if (!inner_radius(dresspack) && !laying.play)
    throw InputError(component.where, fmt::format("'{}' is loose (how much room it has is not known)", component.name),
                     "give dresspack.inner_diameter_mm or its play_mm");
}

/// Checks that a bend of the least radius exists: at half the diameter, its inner side has the length 0.
void check_bend_radius(const Dresspack& dresspack) {
  const double radius = dresspack.least_bend_radius.value_or(dresspack.diameter), diameter = dresspack.diameter;
  if (!(diameter > 0) || radius >= diameter / 2) return;
  constexpr double low = 1, high = 40;  // in diameters: limits of makers
  const Meant meant = meant_length("least_bend_radius_mm", 1e3 * radius, 1e3 * low * diameter, 1e3 * high * diameter);
  throw InputError(dresspack.least_bend_radius_where,
                   fmt::format("least_bend_radius_mm is {:.4g} (must be at least {:.4g} mm: half of diameter_mm)",
                               1e3 * radius, 5e2 * diameter),
                   meant.remedy.empty()
                       ? "give the radius of the axis that the maker allows in motion, or check diameter_mm"
                       : "give " + meant.remedy);
}

/// Checks that the parts fit into the hose.
void check_room(const Dresspack& dresspack) {
  const auto inner = inner_radius(dresspack);
  if (!inner || !(dresspack.diameter > 0)) return;  // a missing diameter is another problem
  if (2 * *inner > dresspack.diameter || *inner <= 0)
    throw InputError(
        dresspack.where,
        fmt::format("inner_diameter_mm is {:.4g} (diameter_mm is {:.4g})", 2e3 * *inner, 1e3 * dresspack.diameter),
        dresspack.diameter < 1e-3  // thinner than any dresspack
            ? fmt::format("give diameter_mm: {:.4g} if that was metres", 1e6 * dresspack.diameter)
            : "the inner one is the smaller");
  if (dresspack.core_diameter > 2 * *inner)
    throw InputError(dresspack.where,
                     fmt::format("core_diameter_mm is {:.4g} (the hose is {:.4g} wide inside)",
                                 1e3 * dresspack.core_diameter, 2e3 * *inner),
                     "check core_diameter_mm");
}

/// Checks the place of a part. The middle is described either by the keys of the core or by a component. No part may be inside of
/// the core or outside of the bore.
void check_place(const Dresspack& dresspack, const Component& component) {
  if (!(dresspack.diameter > 0)) return;  // a refused diameter is another problem
  const PartsRoom room = room_of_parts(dresspack);
  if (!(room.bore > 0)) return;  // a refused bore is another problem
  const bool has_core = room.core > 0 || dresspack.core_bending_stiffness.value_or(0) > 0;
  if (component.helix_radius == 0 && has_core && inner_radius(dresspack))
    throw InputError(
        component.where,
        fmt::format("'{}' lies in the middle, and the keys core_.. describe something else that does", component.name),
        "leave out the keys core_.., or the component");
  if (const double by = inside_core(room, component); by > 0 && room.core == 0)
    throw InputError(component.where,
                     fmt::format("'{}' covers the axis by {:.3g} mm (helix_radius_mm is {:.4g}, radius_mm {:.4g})",
                                 component.name, 1e3 * by, 1e3 * component.helix_radius, 1e3 * component.radius),
                     room.bore < 2 * component.radius
                         ? "give helix_radius_mm: 0; beside the axis it has no room"
                         : fmt::format("give helix_radius_mm: {:.4g} or more{}", 1e3 * component.radius,
                                       component.count == 1 ? ", or 0 in the middle" : ""));
  else if (by > 0)
    throw InputError(
        component.where,
        fmt::format("'{}' begins {:.4g} mm from the axis, {:.3g} mm inside the core (core_diameter_mm is "
                    "{:.4g})",
                    component.name, 1e3 * (component.helix_radius - component.radius), 1e3 * by, 2e3 * room.core),
        fmt::format("give helix_radius_mm: {:.4g} or more, or core_diameter_mm: {:.4g} or less",
                    1e3 * (room.core + component.radius),
                    2e3 * std::max(0.0, component.helix_radius - component.radius)));
  const double by = outside_bore(room, component);
  if (by == 0 || room.estimated) return;  // an estimated bore only gives a warning (overlap.h)
  const bool hose = inner_radius(dresspack).has_value();
  const double needed = 2e3 * (component.helix_radius + component.radius);
  throw InputError(
      component.where,
      fmt::format("'{}' reaches {:.4g} mm from the axis, {:.3g} mm outside the {} (radius {:.4g} mm)", component.name,
                  1e3 * (component.helix_radius + component.radius), 1e3 * by, hose ? "hose's bore" : "dresspack",
                  1e3 * room.bore),
      fmt::format("give helix_radius_mm: {:.4g} or less, or {}", 1e3 * std::max(0.0, room.bore - component.radius),
                  hose ? wider_hose(needed, dresspack) : fmt::format("diameter_mm: {:.4g} or more", needed)));
}

/// Refuses wires in a hose without a known bore: it is unknown whether the parts fit, and how far they can move.
void check_bore(const Dresspack& dresspack) {
  if (dresspack.hose_material.empty() || inner_radius(dresspack) || !has_wires(dresspack) || dresspack.cable_alone)
    return;
  throw InputError(
      dresspack.where, "hose_material is given and the hose's bore is not (whether its parts fit is not known)",
      fmt::format("give the profile of a corrugated hose; of {:.4g} mm usually {} (ESTIMATE). Of a smooth pipe give "
                  "inner_diameter_mm alone: it bends some hundred times harder",
                  1e3 * dresspack.diameter, corrugation_line(usual_corrugation(dresspack))));
}

void check_bending_friction(const Dresspack& dresspack) {
  if (dresspack.bending_friction.size() > most_bending_frictions)
    throw InputError(dresspack.where,
                     fmt::format("bending_friction has {} elements (at most {})", dresspack.bending_friction.size(),
                                 most_bending_frictions),
                     "keep those that hold most");
  if (dresspack.bending_friction.empty() || elastic_bending_stiffness(dresspack) > 0) return;
  throw InputError(dresspack.where,
                   fmt::format("bending_friction holds {:.3g} N m2 at {:.3g} 1/m, all of bending_stiffness_Nm2, {:.3g}",
                               dresspack.bending_stiffness - elastic_bending_stiffness(dresspack),
                               dresspack.construction_curvature, dresspack.bending_stiffness),
                   "give as bending_stiffness_Nm2 moment over curvature of the first bend, friction included");
}

/// Checks that a test can bend the axis so: at half the diameter, the inner side of the bend has the length 0.
void check_rig_radius(const Rig& rig, double diameter) {
  if (!rig.radius && !rig.radius_diameters) return;
  const double radius = axis_radius(rig, diameter);
  if (!(diameter > 0) || radius >= diameter / 2) return;
  constexpr double low = 4, high = 20;  // in diameters: published ratings
  const Meant meant = meant_length("radius_mm", 1e3 * radius, 1e3 * low * diameter, 1e3 * high * diameter);
  throw InputError(rig.where,
                   fmt::format("the rig of a rating bends the axis to {:.4g} mm (must be at least {:.4g} mm: half the "
                               "diameter of the cable or hose)",
                               1e3 * radius, 5e2 * diameter),
                   rig.radius && !meant.remedy.empty() ? "give " + meant.remedy
                                                       : "give the radius of the axis that the maker states");
}

/// Checks copies of the ratings, because check_rig() fills in defaults and the job must stay unchanged.
void check_ratings(const std::vector<Rating>& ratings, double diameter, bool of_plain) {
  for (Rating rating : ratings) {
    if (!rating.rig.where.line) rating.rig.where = rating.where;
    check_rig(rating.rig);
    check_rig_radius(rating.rig, diameter);
    if (of_plain && (rating.rig.kind == RigKind::swivel || rating.rig.kind == RigKind::axial))
      throw InputError(rating.rig.where,
                       fmt::format("a rating of kind {} says nothing about a hose or a cable without described wires",
                                   word(rating.rig.kind)),
                       "give a rating in torsion, rolling_flex, two_pulley or tick_tock");
  }
}

/// Checks that only whole cables and hoses have ratings.
void check_ratings(const Component& component, bool first_level) {
  const bool plain = component.plain && has_rated_life(component.plain->kind);
  if (!component.ratings.empty() && (!first_level || (component.components.empty() && !plain)))
    throw InputError(
        component.ratings.front().where,
        fmt::format("'{}' has ratings (they are of cables and hoses right in the dresspack)", component.name),
        component.plain ? "set without_wires.kind: cable or hose, or leave them out" : "give them to the cable");
  check_ratings(component.ratings, 2 * component.radius, plain);
  for (const Component& inner : component.components) check_ratings(inner, false);
}

/// Checks the components of the core, which only have a life.
void check_core(const Dresspack& dresspack, Problems& problems) {
  for (const Component& part : dresspack.core_components) {
    Laying mass_alone;
    mass_alone.mass = part.laying.mass;
    if (!part.plain || part.lay_angle != 0 || !(part.laying == mass_alone) || part.jacket || part.tension > 0 ||
        !part.components.empty()) {
      problems.add(part.where, fmt::format("'{}' of core_components has more than a life", part.name),
                   "give name, count, radius_mm, helix_radius_mm, without_wires and ratings only");
      continue;
    }
    problems.attempt("", part.where, [&] { check_plain_part(*part.plain, part.radius, part.name); });
    problems.attempt("", part.where, [&] { check_ratings(part, true); });
    const double reach = part.helix_radius + part.radius;
    if (!(reach <= dresspack.core_diameter / 2 * (1 + caliper_error)))
      problems.add(part.where,
                   fmt::format("'{}' reaches {:.4g} mm from the axis (core_diameter_mm is {:.4g})", part.name,
                               1e3 * reach, 1e3 * dresspack.core_diameter),
                   "check core_diameter_mm, helix_radius_mm and radius_mm");
  }
  if (!dresspack.core_components.empty() && !dresspack.core_parts.empty())
    problems.add(dresspack.core_components.front().where, "both core_parts and core_components are given",
                 "keep one of the two");
}

}  // namespace

bool has_wires(const Dresspack& dresspack) { return hold_wires(dresspack.components); }

bool is_from_construction(const Dresspack& dresspack) {
  return dresspack.mass_from_construction || dresspack.bending_from_construction ||
         dresspack.torsional_from_construction || dresspack.axial_from_construction;
}

bool lacks_friction(const Dresspack& dresspack) {
  return !dresspack.bending_from_construction && dresspack.bending_stiffness > 0 &&
         dresspack.bending_friction.empty() && dresspack.construction_state == SlipState::friction &&
         has_wires(dresspack);
}

void drop_ratings(Dresspack& dresspack) {
  dresspack.ratings.clear();
  dresspack.core_components.clear();
  for (Component& component : dresspack.components) {
    component.ratings.clear();
    if (component.plain) component.plain->damage_exponent.reset(), component.plain->least_bend_radius.reset();
  }
}

int check_dresspack(const Dresspack& dresspack, const std::vector<Slip>& slip) {
  Problems problems;
  const auto attempt = [&](const Where& where, const auto& check) { problems.attempt("", where, check); };
  const int depth = largest_of(dresspack.components, 0, [&](const Component& component) {
    return check_component(component, nullptr, problems);
  });
  attempt(dresspack.where, [&] { check_hose(dresspack); });
  attempt(dresspack.where, [&] { check_bend_radius(dresspack); });
  attempt(dresspack.where, [&] { check_bending_friction(dresspack); });
  attempt(dresspack.where, [&] { check_room(dresspack); });
  attempt(dresspack.where, [&] { check_bore(dresspack); });
  if (!dresspack.ratings.empty() && inner_radius(dresspack))
    problems.add(dresspack.ratings.front().where, "ratings stand beside a hose (they are of a cable)",
                 "give them to the cable in dresspack.components");
  attempt(dresspack.where, [&] { check_ratings(dresspack.ratings, dresspack.diameter, false); });
  const auto crowd = dresspack.diameter > 0 ? crowd_in(dresspack) : std::nullopt;
  if (crowd) problems.add(crowd->where, crowd->what, crowd->remedy);
  check_core(dresspack, problems);
  for (const Component& component : dresspack.components) {
    attempt(component.where, [&] { check_ratings(component, true); });
    attempt(component.where, [&] { check_laying(dresspack, component, true); });
    if (!crowd) attempt(component.where, [&] { check_place(dresspack, component); });
    if (component.laying.position == Position::loose && !slides(slip.front()))
      problems.add(component.where,
                   fmt::format("'{}' is loose, and sticks to the hose (strain.slip of its level is {})", component.name,
                               word(slip.front())),
                   "set strain.slip of the first level to free or friction, or position: held");
  }
  problems.finish(dresspack.where.file);
  return depth;
}

}  // namespace dresslife::pipeline
