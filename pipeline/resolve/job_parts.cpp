#include <algorithm>

#include "pipeline/base/digest.h"
#include "pipeline/base/program_files.h"
#include "pipeline/base/related_files.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/cyclic_curve.h"
#include "pipeline/job/job_forms.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/echo_text.h"

namespace dresslife::pipeline {

namespace {

/// Keys of a wire's material that affect strains: its stiffness and, if a grip limits the force of a cable, its cyclic curve
/// (given, or computed from the strain-life constants).
struct MetalKeys {
  Material material;
  bool pulls_at_grips = false;
};

void describe(Fields& echo, MetalKeys& keys) {
  Material& m = keys.material;
  echo.text("name", m.name, Need::required, "");
  echo.number("youngs_modulus_GPa", m.youngs_modulus, Need::required, any_number(), "");
  if (!keys.pulls_at_grips || !m.strain_life_table.empty()) return;  // a polymer is elastic
  m.cyclic_hardening_exponent = hardening_exponent(m);
  m.cyclic_strength = cyclic_strength(m);
  echo.maybe_number("cyclic_strength_MPa", m.cyclic_strength, any_number(), "");
  echo.maybe_number("cyclic_hardening_exponent", m.cyclic_hardening_exponent, any_number(), "");
}

bool has_wires_of(const std::vector<Component>& components, const std::string& material) {
  return std::ranges::any_of(components, [&](const Component& component) {
    return component.material == material || has_wires_of(component.components, material);
  });
}

/// Keys of a dresspack that affect the strain of its parts.
struct StrainKeys {
  MountedDresspack mounted;
  std::vector<MetalKeys> materials{};

  explicit StrainKeys(const MountedDresspack& of) : mounted(of) {
    const std::vector<Component>& components = of.dresspack.components;
    const bool grips = std::ranges::any_of(components, [](const Component& component) {
      return component.laying.base_grip || component.laying.tool_grip;
    });
    for (const Material& material : of.dresspack.materials)
      if (has_wires_of(components, material.name)) materials.push_back({material, grips});
  }
  StrainKeys() = default;
};

void describe(Fields& echo, StrainKeys& keys) {
  Dresspack& dresspack = keys.mounted.dresspack;
  if (!keys.mounted.name.empty()) echo.text("name", keys.mounted.name, Need::required, "");
  echo.list("components", dresspack.components, Need::optional, "");
  echo.list("materials", keys.materials, Need::optional, "");
  echo.maybe_number("inner_diameter_mm", dresspack.inner_diameter, any_number(), "");
  if (dresspack.core_diameter != 0)
    echo.number("core_diameter_mm", dresspack.core_diameter, Need::optional, any_number(), "");
  if (dresspack.rest_curvature != 0)
    echo.number("rest_curvature_1_per_m", dresspack.rest_curvature, Need::optional, any_number(), "");
  if (dresspack.construction_curvature != Dresspack{}.construction_curvature)
    echo.number("construction_curvature_1_per_m", dresspack.construction_curvature, Need::optional, any_number(), "");
  echo.maybe_number("core_bending_stiffness_Nm2", dresspack.core_bending_stiffness, any_number(), "");
  if (dresspack.hose_material.empty()) return;
  echo.text("hose_material", dresspack.hose_material, Need::optional, "");
  echo.maybe_number("hose_strain_factor", dresspack.hose_strain_factor, any_number(), "");
  echo.maybe_group("hose_corrugation", dresspack.hose_corrugation, "");
  echo.number("diameter_mm", dresspack.diameter, Need::optional, any_number(), "");
}

/// Keys of a part whose life follows from ratings.
struct RatedKeys {
  std::string name;
  double radius = 0;
  std::optional<double> damage_exponent;
  std::vector<Rating> ratings;
};

void describe(Fields& echo, RatedKeys& keys) {
  echo.text("name", keys.name, Need::required, "");
  echo.number("radius_mm", keys.radius, Need::required, any_number(), "");
  echo.maybe_number("damage_exponent", keys.damage_exponent, any_number(), "");
  echo.list("ratings", keys.ratings, Need::required, "");
}

/// Keys of a hose that may kink.
struct KinkKeys {
  std::string name;
  double radius = 0, helix_radius = 0;
  PlainPart plain;
};

void describe(Fields& echo, KinkKeys& keys) {
  echo.text("name", keys.name, Need::required, "");
  echo.number("radius_mm", keys.radius, Need::required, any_number(), "");
  echo.number("helix_radius_mm", keys.helix_radius, Need::required, any_number(), "");
  echo.maybe_number("bore_mm", keys.plain.bore, any_number(), "");
  echo.maybe_number("least_bend_radius_mm", keys.plain.least_bend_radius, any_number(), "");
  echo.maybe_number("pressure_bar", keys.plain.pressure, any_number(), "");
  echo.maybe_number("most_pressure_bar", keys.plain.most_pressure, any_number(), "");
}

/// Keys of a cable whose jacket may wear.
struct JacketKeys {
  std::string name;
  Sleeve jacket;
};

void describe(Fields& echo, JacketKeys& keys) {
  echo.text("name", keys.name, Need::required, "");
  echo.group("jacket", keys.jacket, Need::required, "");
}

/// Removes the keys that only dresslife-fatigue uses.
void drop_fatigue_keys(Dresspack& dresspack) {
  drop_ratings(dresspack);
  for (std::vector<Component>* const parts : {&dresspack.components, &dresspack.core_components})
    for (Component& component : *parts) {
      if (component.plain) component.plain->pressure.reset(), component.plain->most_pressure.reset();
      if (parts == &dresspack.components) component.jacket.reset();
    }
}

/// Keys of a dresspack that affect its lives.
struct FatigueKeys {
  MountedDresspack mounted;
};

void describe(Fields& echo, FatigueKeys& keys) {
  if (!keys.mounted.name.empty()) echo.text("name", keys.mounted.name, Need::required, "");
  Dresspack& dresspack = keys.mounted.dresspack;
  echo.list("materials", dresspack.materials, Need::optional, "");
  echo.maybe_group("sleeve", dresspack.sleeve, "");
  std::vector<RatedKeys> rated;
  for (const Component& part : dresspack.components)
    if (part.plain && !part.ratings.empty())
      rated.push_back({part.name, part.radius, part.plain->damage_exponent, part.ratings});
  if (!rated.empty()) echo.list("rated", rated, Need::optional, "");
  std::vector<JacketKeys> jackets;
  for (const Component& part : dresspack.components)
    if (part.jacket) jackets.push_back({part.name, *part.jacket});
  if (!jackets.empty()) echo.list("jackets", jackets, Need::optional, "");
  std::vector<KinkKeys> hoses;
  for (const Component& part : dresspack.components)
    if (part.plain && part.plain->kind == PlainKind::hose)
      hoses.push_back({part.name, part.radius, part.helix_radius, *part.plain});
  if (!hoses.empty()) echo.list("hoses", hoses, Need::optional, "");
  if (!dresspack.core_parts.empty()) echo.text("core_parts", dresspack.core_parts, Need::optional, "");
  if (!dresspack.core_components.empty()) echo.list("core_components", dresspack.core_components, Need::optional, "");
}

/// Describes the dresspacks in the form of the job: keys of a single one, or a list.
template <class Keys>
void describe_each(Fields& echo, const JobForms& forms, std::vector<Keys> keys) {
  if (forms.one)
    describe(echo, keys.front());
  else
    echo.list("dresspacks", keys, Need::required, "");
}

/// Removes the origin of stiffnesses: the motion depends on their values only.
void count_as_numbers(Dresspack& dresspack) {
  const Dresspack untold;
  dresspack.mass_from_construction = false;
  dresspack.bending_from_construction = dresspack.torsional_from_construction = dresspack.axial_from_construction =
      false;
  dresspack.construction_state = untold.construction_state;
  if (dresspack.bending_friction.empty()) dresspack.construction_curvature = untold.construction_curvature;
  dresspack.core_bending_stiffness = dresspack.core_torsional_stiffness = dresspack.core_axial_stiffness = {};
}

/// Temperature for strain and fatigue. The usual temperature is left out, so that the texts of older jobs do not change.
void describe_temperature(Fields& echo, Cell& cell) {
  if (cell.temperature != Cell::usual_temperature)
    echo.number("temperature_C", cell.temperature, Need::optional, any_number(), "");
}

void describe_sim(Fields& echo, Job& copy) {
  const JobForms forms = forms_of(copy);
  std::vector<double> by_rule;  // the least bend radii that follow from keys that are left out below
  for (MountedDresspack& mounted : copy.dresspacks) {
    Dresspack& dresspack = mounted.dresspack;
    if (!dresspack.least_bend_radius) by_rule.push_back(least_bend_radius(dresspack));
    drop_fatigue_keys(dresspack);
    dresspack.estimates.clear();
    dresspack.estimated_lay_factor.reset();
    count_as_numbers(dresspack);
    if (copy.motion.is_prescribed()) break;  // the wires determine how a pull stretches the cable
    dresspack.components.clear();
    dresspack.materials.clear();
    dresspack.hose_material.clear();
    dresspack.hose_strain_factor.reset();
    dresspack.hose_corrugation.reset();
    dresspack.inner_diameter.reset();
    dresspack.core_diameter = 0;
    dresspack.core_parts.clear();
    dresspack.sleeve.reset();
  }
  echo.group("motion", copy.motion, Need::required, "");
  echo.group("robot", copy.robot, Need::optional, "", !copy.robot.joints.empty());
  if (forms.one) {
    echo.group("dresspack", copy.dresspacks.front().dresspack, Need::required, "");
    echo.group("routing", copy.dresspacks.front().routing, Need::required, "", !copy.motion.rig);
  } else {
    echo.list("dresspacks", copy.dresspacks, Need::required, "");
  }
  copy.cell.temperature = Cell::usual_temperature;  // the stiffnesses contain its effect
  echo.group("cell", copy.cell, Need::optional, "");
  echo.group("simulation", copy.simulation, Need::optional, "");
  if (!by_rule.empty()) echo.numbers("bend_radius_by_rule_mm", by_rule, Need::optional, "");
  double other = copy.motion.is_prescribed() ? 0 : other_stiffness(copy.uncertainty);
  echo.number("other_stiffness", other, Need::optional, any_number(), "");
}

void describe_strain(Fields& echo, Job& copy) {
  std::vector<StrainKeys> keys;
  for (MountedDresspack& mounted : copy.dresspacks) {
    drop_fatigue_keys(mounted.dresspack);
    keys.push_back(StrainKeys(mounted));
  }
  describe_each(echo, forms_of(copy), keys);
  describe_temperature(echo, copy.cell);
  echo.group("strain", copy.strain, Need::optional, "");
  double clamped = clamped_length(copy);  // of the cable in a rig
  echo.number("clamped_length_m", clamped, Need::optional, any_number(), "");
  echo.boolean("uncertain", copy.uncertainty.enabled, Need::optional, "");
  bool known = true;  // dresslife-strain leaves out the variations of these parameters
  for (const Uncertain parameter : {Uncertain::friction_hose, Uncertain::slack, Uncertain::grip})
    if (is_known(copy.uncertainty, parameter))
      echo.boolean("known_" + std::string(uncertain_parameters()[index_of(parameter)].name), known, Need::optional, "");
}

void describe_fatigue(Fields& echo, Job& copy) {
  std::vector<FatigueKeys> keys;
  for (const MountedDresspack& mounted : copy.dresspacks) keys.push_back({mounted});
  describe_each(echo, forms_of(copy), keys);
  describe_temperature(echo, copy.cell);
  echo.group("fatigue", copy.fatigue, Need::optional, "");
  echo.group("inspection", copy.inspection, Need::optional, "");
  echo.group("uncertainty", copy.uncertainty, Need::optional, "");
  echo.maybe_group("calibration", copy.calibration, "");
}

// The content of a file matters, and its digest is compared in addition to the text; its folder does not matter.
std::string file_name(const std::filesystem::path& file) { return file.filename().string(); }

}  // namespace

EchoSections part_sections(const Job& job, JobPart part, const EchoKeys& omitted) {
  const auto described = part == JobPart::sim      ? describe_sim
                         : part == JobPart::strain ? describe_strain
                                                   : describe_fatigue;
  return echo_sections(Describe([&, copy = job](Fields& f) mutable { described(f, copy); }), file_name, omitted);
}

std::string part_text(const Job& job, JobPart part) { return joined_text(part_sections(job, part)); }

std::string motion_digest(const Job& job) {
  Motion motion = job.motion;
  std::string text =
      job.robot.name + to_yaml(echo_fields(Describe([&](Fields& f) { describe(f, motion); }), file_name));
  for (const MountedDresspack& mounted : job.dresspacks) {
    Routing routing = mounted.routing;
    text += mounted.name + ":" + mounted.dresspack.name +
            to_yaml(echo_fields(Describe([&](Fields& f) { describe(f, routing); }), file_name));
  }
  for (const std::filesystem::path& file : files_beside(job)) text += xxh3_of_file(file);
  return xxh3(text);
}

std::vector<std::filesystem::path> files_beside(const Job& job) {
  std::vector<std::filesystem::path> files;
  for (const auto& file : {job.motion.clamp_poses, job.motion.deformation, job.motion.program})
    if (!file.empty() && !is_folder(file)) files.push_back(file);
  std::vector<std::filesystem::path> programs{job.motion.program}, beside = program_files(job.motion.program);
  for (const ProgramFile& module : job.motion.modules) {
    files.push_back(module.file);
    programs.push_back(module.file);
    for (const auto& file : program_files(module.file)) beside.push_back(file);
  }
  for (const auto& file : related_files(programs, std::move(beside), job.motion.routine)) files.push_back(file);
  for (const Link& link : job.robot.links)
    for (const MeshFile& mesh : link.meshes) files.push_back(mesh.file);
  for (const MeshFile& mesh : surroundings(job).meshes) files.push_back(mesh.file);
  return files;
}

}  // namespace dresslife::pipeline
