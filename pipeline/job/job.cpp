#include "pipeline/job/job.h"

#include <algorithm>

#include "pipeline/cable/cyclic_curve.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/catalogue.h"
#include "pipeline/job/data_sheet.h"
#include "pipeline/job/sources.h"
#include "pipeline/job/urdf.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

namespace {

/// How a job gives its dresspacks: one by two keys of its own, or a list. The manual tells of both.
struct Forms {
  bool one = true, list = false;
};
/// Precondition of reading: the job's list is empty when the document has one.
Forms forms_of(const Job& job) {
  const bool one = job.dresspacks.size() == 1 && job.dresspacks.front().name.empty();
  return {one, !one};
}

void describe_keys(Fields& f, Job& job, const Forms& forms) {
  // The motion first: whether it brings its own clamp poses decides whether a robot is needed.
  f.group("motion", job.motion, Need::required, "a name of config/programs, a file, or the entry itself");
  f.group("robot", job.robot, job.motion.needs_robot() ? Need::required : Need::optional,
          "a name of config/robots, a file, or the entry itself", !job.robot.joints.empty());
  if (forms.one) {
    MountedDresspack& only = job.dresspacks.front();
    f.group("dresspack", only.dresspack, Need::required,
            "a name of config/dresspacks, a file, or the entry itself");
    f.group("routing", only.routing, job.motion.rig ? Need::optional : Need::required,
            "clamps and free length", !job.motion.rig);
  }
  if (forms.list)
    f.list("dresspacks", job.dresspacks, forms.one ? Need::optional : Need::required,
           "several on one robot, instead of dresspack and routing");
  f.group("cell", job.cell, Need::optional, "what stands still around the robot: obstacles of the dresspack");
  f.group("simulation", job.simulation, Need::optional, "settings of dresslife-sim");
  f.group("strain", job.strain, Need::optional, "settings of dresslife-strain");
  f.group("fatigue", job.fatigue, Need::optional, "settings of dresslife-fatigue");
  f.group("uncertainty", job.uncertainty, Need::optional, "what is not known, and how well");
  f.maybe_group("calibration", job.calibration,
                "a file that dresslife calibrate wrote: what observations have taught of what is not known");
}

}  // namespace

void describe(Fields& f, Job& job) { describe_keys(f, job, forms_of(job)); }

namespace {

void check_names(const std::vector<MountedDresspack>& dresspacks) {
  for (std::size_t d = 0; d < dresspacks.size(); ++d) {
    const MountedDresspack& mounted = dresspacks[d];
    if (mounted.name.find('/') != std::string::npos)
      throw InputError(mounted.where, fmt::format("name '{}' holds a '/'", mounted.name),
                       "choose another: it begins the paths of the dresspack's wires");
    for (std::size_t other = 0; other < d; ++other)
      if (dresspacks[other].name == mounted.name)
        throw InputError(mounted.where, fmt::format("two dresspacks are named '{}'", mounted.name),
                         "give each another name");
  }
}

/// What all dresspacks of a robot share: one pose in which they are clamped, one material of each name.
void check_shared(const std::vector<MountedDresspack>& dresspacks) {
  Problems problems;
  const MountedDresspack* posed = nullptr;
  std::vector<const Material*> known;
  for (const MountedDresspack& mounted : dresspacks) {
    if (!mounted.routing.mounting_pose.empty()) {
      if (posed && posed->routing.mounting_pose != mounted.routing.mounting_pose)
        problems.add(mounted.routing.where,
                     fmt::format("mounting_pose_deg differs from that of dresspack '{}' (all are clamped "
                                 "in one pose)",
                                 posed->name),
                     "give the same, or give it once");
      posed = &mounted;
    }
    for (const Material& material : mounted.dresspack.materials) {
      const auto same = std::find_if(known.begin(), known.end(),
                                     [&](const Material* other) { return other->name == material.name; });
      if (same == known.end())
        known.push_back(&material);
      else if (to_yaml(echo_fields(**same)) != to_yaml(echo_fields(material)))
        problems.add(material.where,
                     fmt::format("material '{}' is another than that of the dresspack before", material.name),
                     "give one of the two another name");
    }
  }
  problems.finish();
}

/// A prescribed deformation is that of one dresspack of known length; nobody reads what would carry, touch or
/// hold it.
void check_prescribed(const Job& job, const Node& document) {
  const char* key = job.motion.rig ? "motion.rig" : "motion.deformation";
  Problems problems;
  const auto refuse = [&](const Where& where, const std::string& what) {
    problems.add(where, fmt::format("{} beside {} (which says how the dresspack deforms)", what, key),
                 "leave it out");
  };
  for (const char* other : {"robot", "cell"})
    if (const Node* given = document.find(other)) refuse(given->where, fmt::format("{} is given", other));
  if (job.dresspacks.size() > 1)
    problems.add(job.motion.where,
                 fmt::format("{} deforms one dresspack (there are {})", key, job.dresspacks.size()),
                 "keep one dresspack");
  const Node* routing = document.find("routing");
  if (job.motion.rig && routing) refuse(routing->where, "routing is given");
  for (const Entry& entry : routing ? routing->entries : std::vector<Entry>{})
    if (entry.key != "free_length_m" && entry.key != "tool_end" && entry.key != "pre_twist_deg" &&
        entry.key != "tool_mass_kg")
      refuse(entry.where, "routing." + entry.key + " is given");
  const Routing& only = job.dresspacks.front().routing;
  if (only.pre_twist != 0 || only.tool_mass != 0 || !is_clamped(only.tool_end))
    refuse(only.where, "an end that is free or twisted is given");
  problems.finish(document.where.file);
}

/// A simulated cable has the mass and the stiffness that a rig does without.
void check_simulated(const Dresspack& dresspack) {
  Problems problems;
  const std::pair<const char*, double> needed[] = {{"mass_kg_per_m", dresspack.mass_per_length},
                                                   {"bending_stiffness_Nm2", dresspack.bending_stiffness},
                                                   {"torsional_stiffness_Nm2", dresspack.torsional_stiffness},
                                                   {"axial_stiffness_N", dresspack.axial_stiffness}};
  for (const auto& [key, value] : needed)
    if (value <= 0)
      problems.add(dresspack.where,
                   fmt::format("dresspack.{} is missing (a cable that is simulated needs it)", key),
                   "give it, or let motion.rig or motion.deformation move the cable");
  if (dresspack.damping_source.empty())
    problems.add(dresspack.where, "dresspack.damping_source is missing (a cable that is simulated needs it)",
                 "give damping_time_ms and where it comes from");
  problems.finish();
}

/// Of one dresspack. path: of what holds its keys, "" or "dresspacks[2].". Returns how many levels of parts
/// it has, where that can be told.
std::optional<int> check_mounted(const Job& job, const MountedDresspack& mounted, const std::string& path,
                                 Problems& problems) {
  const std::string dresspack = path + "dresspack", routing = path + "routing";
  const auto judge = [&](const std::string& key, const Where& where, const auto& check) {
    return !problems.touch(key) && problems.attempt(key, where, check);
  };
  if (!job.motion.is_prescribed() && !problems.touch("motion")) {
    if (!problems.touch("robot") && !problems.touch(dresspack + ".diameter_mm"))
      judge(routing, mounted.routing.where, [&] {
        check_routing(mounted.routing, mounted.dresspack.diameter, job.robot,
                      !job.motion.clamp_poses.empty());
      });
    judge(dresspack, mounted.dresspack.where, [&] { check_simulated(mounted.dresspack); });
  }
  std::optional<int> depth;
  if (!problems.touch("strain"))
    judge(dresspack + ".components", mounted.dresspack.where,
          [&] { depth = check_dresspack(mounted.dresspack, job.strain.slip); });
  judge(dresspack + ".materials", mounted.dresspack.where,
        [&] { check_materials(mounted.dresspack.materials); });
  judge(dresspack + ".components", mounted.dresspack.where,
        [&] { refuse_gross_overlap(mounted.dresspack); });  // dresslife-strain warns of less
  return depth;
}

void check_dresspacks(const Job& job, const Where& strain, Problems& problems) {
  const Forms forms = forms_of(job);
  if (!forms.one)
    problems.attempt("dresspacks", job.dresspacks.front().where, [&] { check_names(job.dresspacks); });
  if (job.dresspacks.size() > 1 && !job.motion.clamp_poses.empty())
    problems.add(job.motion.where,
                 fmt::format("motion.clamp_poses brings the clamps of one dresspack (there are {})",
                             job.dresspacks.size()),
                 "describe the motion by a robot, or keep one dresspack", "motion");
  int depth = 0;
  bool told = true;  // how deep each is
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const std::string path = forms.one ? "" : fmt::format("dresspacks[{}].", d + 1);
    const std::optional<int> levels = check_mounted(job, job.dresspacks[d], path, problems);
    told = told && levels;
    depth = std::max(depth, levels.value_or(0));
  }
  if (told) problems.attempt("", job.motion.where, [&] { check_shared(job.dresspacks); });
  if (told && job.strain.slip.size() > 1 && static_cast<int>(job.strain.slip.size()) != depth)
    problems.add(
        strain,
        fmt::format("strain.slip lists {} levels (the dresspack has {})", job.strain.slip.size(), depth),
        "give one word, or one per level, outermost first");
}

/// A curve whose lives do not rise with falling strain is none.
void check_slopes(const Job& job, const Where& where) {
  for (const MountedDresspack& mounted : job.dresspacks)
    for (const Material& material : mounted.dresspack.materials)
      if (material.strain_life_table.empty() &&
          !(material.fatigue_strength_exponent + job.fatigue.slope_change <= -0.02))
        throw InputError(
            where,
            fmt::format("fatigue.slope_change {} leaves '{}' a slope b of {} (must be -0.02 or less)",
                        job.fatigue.slope_change, material.name,
                        material.fatigue_strength_exponent + job.fatigue.slope_change),
            "give a smaller one");
}

/// Whether what was read fits together. What was not read is not judged.
void check(const Job& job, const Node& document, Problems& problems) {
  const auto where = [&](const char* key) {
    return document.find(key) ? document.find(key)->where : document.where;
  };
  const auto judge = [&](std::initializer_list<const char*> keys, const auto& check) {
    if (std::none_of(keys.begin(), keys.end(), [&](const char* key) { return problems.touch(key); }))
      problems.attempt(*keys.begin(), where(*keys.begin()), check);
  };
  if (job.motion.is_prescribed() && !job.dresspacks.empty())
    judge({"motion", "routing"}, [&] { check_prescribed(job, document); });
  if (job.motion.needs_robot()) judge({"robot"}, [&] { check_robot(job.robot, where("robot")); });
  judge({"robot"}, [&] {
    for (const Link& link : job.robot.links) check_boxes(link.boxes, where("robot"));
  });
  judge({"cell"}, [&] { check_boxes(job.cell.boxes, where("cell")); });
  judge({"motion", "robot"}, [&] { check_motion(job.motion, job.robot); });
  if (!job.dresspacks.empty()) check_dresspacks(job, where("strain"), problems);
  judge({"simulation"}, [&] { check_simulation(job.simulation, where("simulation")); });
  judge({"fatigue", "dresspack", "dresspacks"}, [&] { check_slopes(job, where("fatigue")); });
}

/// Once what they are taken from is known to be sound.
void take_stiffnesses(Dresspack& dresspack, const std::vector<Slip>& slip) {
  if (!is_from_construction(dresspack)) return;
  check_dresspack(dresspack, slip);
  take_from_construction(dresspack);
}

/// strain.gate of a job with a rig that names none: above the rounding of strains in single precision (W26).
constexpr double gate_of_rigs = 1e-6;

/// Exactly one of the two forms in which a job gives its dresspacks; of both, the list is kept.
void check_forms(Node& document, Problems& problems) {
  const Node* list = document.find("dresspacks");
  for (const char* key : {"dresspack", "routing"}) {
    const Node* alone = document.find(key);
    if (list && alone)
      problems.add(alone->where,
                   fmt::format("both dresspacks and {0} are given (each of the list has its own {0})", key),
                   "keep one of the two");
    const Node* motion = document.find("motion");
    const bool of_rig = key == std::string_view("routing") && motion && motion->find("rig");
    if (!list && !alone && !of_rig)
      problems.add(document.where, fmt::format("{} is missing (and there is no list dresspacks)", key),
                   "give dresspack and routing, or a list dresspacks of name, dresspack, routing", key);
  }
  if (!list) return;
  if (!list->is_list() || list->items.empty())
    problems.add(list->where, "dresspacks holds no dresspack", "write a list of name, dresspack and routing",
                 "dresspacks");
  std::erase_if(document.entries, [](const Entry& e) { return e.key == "dresspack" || e.key == "routing"; });
}

/// Clamps at mounting points, stiffnesses from construction, and what a rig brings by itself.
void complete(Job& job, const Node& document, Problems& problems) {
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    MountedDresspack& mounted = job.dresspacks[d];
    const std::string path = forms_of(job).one ? "" : fmt::format("dresspacks[{}].", d + 1);
    if (!problems.touch("robot") && !problems.touch(path + "routing"))
      problems.attempt(path + "routing", mounted.routing.where,
                       [&] { place_clamps(mounted.routing, job.robot); });
    if (!problems.touch(path + "dresspack"))
      problems.attempt(path + "dresspack", mounted.dresspack.where,
                       [&] { take_stiffnesses(mounted.dresspack, job.strain.slip); });
  }
  if (!job.motion.rig || problems.touch("motion")) return;
  problems.attempt("motion", job.motion.where, [&] { check_rig(*job.motion.rig); });
  const Node* strain = document.find("strain");
  // Millions of cycles below the usual gate are what a rig is for, and its few samples cost nothing.
  if (!strain || !strain->find("gate")) job.strain.gate = gate_of_rigs;
}

}  // namespace

// ---- reading and writing jobs -----------------------------------------------------------------------------

Job job_from(Node document, const std::vector<std::string>& sets) {
  if (!document.is_map())
    throw InputError(document.where, "holds no job", "write robot, motion, dresspack, routing");
  Problems problems;
  for (const std::string& set : sets)
    problems.attempt("", {"--set " + set}, [&] { apply_set(document, set); });
  check_forms(document, problems);
  resolve_job(document, problems);
  if (const Node* calibration = document.find("calibration"))
    problems.attempt("calibration", calibration->where, [&] { apply_calibration(document); });
  Job job;
  if (document.find("dresspacks")) job.dresspacks.clear();
  read_fields(document, Describe([&](Fields& f) { describe(f, job); }), problems);
  complete(job, document, problems);
  check(job, document, problems);
  problems.finish(document.where.file);
  if (job.motion.rig)
    job.dresspacks.front().routing.free_length =
        rig_length(*job.motion.rig, job.dresspacks.front().dresspack.diameter);
  return job;
}

Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return job_from(read_document(file), sets);
}

Setup setup_from(Node document) { return job_from(std::move(document)); }

std::string job_text(const Job& job) { return to_yaml(echo_fields(job)); }

std::string job_text(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return job_text(read_job(file, sets));
}

namespace {

/// What of a wire's material decides strains: how stiff it is, and, where a grip bounds the force of a cable,
/// its cyclic curve, given or as it follows from the strain-life constants.
struct MetalKeys {
  Material material;
  bool pulls_at_grips = false;
};

void describe(Fields& echo, MetalKeys& keys) {
  Material& m = keys.material;
  echo.text("name", m.name, Need::required, "");
  echo.number("youngs_modulus_GPa", m.youngs_modulus, Need::required, any_number(), "");
  if (!keys.pulls_at_grips || !m.strain_life_table.empty()) return;  // a polymer is taken as elastic
  m.cyclic_hardening_exponent = hardening_exponent(m);
  m.cyclic_strength = cyclic_strength(m);
  echo.maybe_number("cyclic_strength_MPa", m.cyclic_strength, any_number(), "");
  echo.maybe_number("cyclic_hardening_exponent", m.cyclic_hardening_exponent, any_number(), "");
}

bool has_wires_of(const std::vector<Component>& components, const std::string& material) {
  return std::any_of(components.begin(), components.end(), [&](const Component& component) {
    return component.material == material || has_wires_of(component.components, material);
  });
}

/// What of a dresspack decides the strain of its parts.
struct StrainKeys {
  MountedDresspack mounted;
  std::vector<MetalKeys> materials{};

  explicit StrainKeys(const MountedDresspack& of) : mounted(of) {
    const std::vector<Component>& components = of.dresspack.components;
    const bool grips = std::any_of(components.begin(), components.end(), [](const Component& component) {
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
    echo.number("construction_curvature_1_per_m", dresspack.construction_curvature, Need::optional,
                any_number(), "");
  echo.maybe_number("core_bending_stiffness_Nm2", dresspack.core_bending_stiffness, any_number(), "");
  if (dresspack.hose_material.empty()) return;
  echo.text("hose_material", dresspack.hose_material, Need::optional, "");
  echo.maybe_number("hose_strain_factor", dresspack.hose_strain_factor, any_number(), "");
  echo.maybe_group("hose_corrugation", dresspack.hose_corrugation, "");
  echo.number("diameter_mm", dresspack.diameter, Need::optional, any_number(), "");
}

/// What of a dresspack decides its lives.
struct FatigueKeys {
  MountedDresspack mounted;
};

void describe(Fields& echo, FatigueKeys& keys) {
  if (!keys.mounted.name.empty()) echo.text("name", keys.mounted.name, Need::required, "");
  echo.list("materials", keys.mounted.dresspack.materials, Need::optional, "");
}

/// As in the job: the only one's keys stand alone, those of several in a list.
template <class Keys>
void describe_each(Fields& echo, const Forms& forms, std::vector<Keys> keys) {
  if (forms.one)
    describe(echo, keys.front());
  else
    echo.list("dresspacks", keys, Need::required, "");
}

/// The motion hangs on how stiff the dresspack is, not on why.
void count_as_numbers(Dresspack& dresspack) {
  const Dresspack untold;
  dresspack.mass_from_construction = false;
  dresspack.bending_from_construction = dresspack.torsional_from_construction =
      dresspack.axial_from_construction = false;
  dresspack.construction_state = untold.construction_state;
  dresspack.construction_curvature = untold.construction_curvature;
  dresspack.core_bending_stiffness = dresspack.core_torsional_stiffness = dresspack.core_axial_stiffness = {};
}

void describe_sim(Fields& echo, Job copy) {
  const Forms forms = forms_of(copy);
  for (MountedDresspack& mounted : copy.dresspacks) {
    drop_ratings(mounted.dresspack);
    Dresspack& dresspack = mounted.dresspack;
    count_as_numbers(dresspack);
    if (copy.motion.is_prescribed()) break;  // its wires say how a pull stretches the cable
    dresspack.components.clear();
    dresspack.materials.clear();
    dresspack.hose_material.clear();
    dresspack.hose_strain_factor.reset();
    dresspack.hose_corrugation.reset();
    dresspack.inner_diameter.reset();
    dresspack.core_diameter = 0;
  }
  echo.group("motion", copy.motion, Need::required, "");
  echo.group("robot", copy.robot, Need::optional, "", !copy.robot.joints.empty());
  if (forms.one) {
    echo.group("dresspack", copy.dresspacks.front().dresspack, Need::required, "");
    echo.group("routing", copy.dresspacks.front().routing, Need::required, "", !copy.motion.rig);
  } else {
    echo.list("dresspacks", copy.dresspacks, Need::required, "");
  }
  echo.group("cell", copy.cell, Need::optional, "");
  echo.group("simulation", copy.simulation, Need::optional, "");
}

void describe_strain(Fields& echo, Job copy) {
  std::vector<StrainKeys> keys;
  for (MountedDresspack& mounted : copy.dresspacks) {
    drop_ratings(mounted.dresspack);
    keys.push_back(StrainKeys(mounted));
  }
  describe_each(echo, forms_of(copy), keys);
  echo.group("strain", copy.strain, Need::optional, "");
  echo.boolean("uncertain", copy.uncertainty.enabled, Need::optional, "");
}

void describe_fatigue(Fields& echo, Job copy) {
  std::vector<FatigueKeys> keys;
  for (const MountedDresspack& mounted : copy.dresspacks) keys.push_back({mounted});
  describe_each(echo, forms_of(copy), keys);
  echo.group("fatigue", copy.fatigue, Need::optional, "");
  echo.group("uncertainty", copy.uncertainty, Need::optional, "");
  echo.maybe_group("calibration", copy.calibration, "");
}

}  // namespace

std::string part_text(const Job& job, Part part) {
  const auto described = part == Part::sim      ? describe_sim
                         : part == Part::strain ? describe_strain
                                                : describe_fatigue;
  return to_yaml(echo_fields(Describe([&](Fields& f) { described(f, job); })));
}

std::vector<std::filesystem::path> files_beside(const Job& job) {
  std::vector<std::filesystem::path> files;
  for (const auto& file : {job.motion.clamp_poses, job.motion.deformation, job.motion.program})
    if (!file.empty() && !is_folder(file)) files.push_back(file);
  for (const ProgramFile& module : job.motion.modules) {
    files.push_back(module.file);
    for (const auto& file : files_of_program(module.file)) files.push_back(file);
  }
  for (const auto& file : files_of_program(job.motion.program)) files.push_back(file);
  for (const Link& link : job.robot.links)
    for (const MeshFile& mesh : link.meshes) files.push_back(mesh.file);
  for (const MeshFile& mesh : job.cell.meshes) files.push_back(mesh.file);
  return files;
}

Dresspack read_dresspack(const std::filesystem::path& file) {
  Node job;
  job["dresspack"] = read_yaml(file);
  job.where = {file.string()};
  const Node& written = *job.find("dresspack");
  if (!written.is_map() || written.find("dresspack") || written.find("dresspacks"))
    throw InputError({file.string()}, "holds no dresspack", "name a file of the keys of job.dresspack");
  resolve_job(job);
  Dresspack dresspack;
  read_fields(*job.find("dresspack"), dresspack);
  check_dresspack(dresspack, {Slip::free});
  check_materials(dresspack.materials);
  refuse_gross_overlap(dresspack);
  take_from_construction(dresspack);
  return dresspack;
}

std::string job_manual() {
  const Describe both_forms = [](Fields& f) {
    Job job;
    describe_keys(f, job, {true, true});
  };
  return field_manual("job", both_forms) + field_manual<UrdfRequest>("job.robot from a URDF") +
         field_manual<DataSheet>("dresspack.components from a data sheet (key data_sheet)");
}

namespace {

const Material& resolved_material(const Job& job, const std::string& wanted) {
  for (const MountedDresspack& mounted : job.dresspacks)
    for (const Material& material : mounted.dresspack.materials)
      if (material.name == wanted) return material;
  throw std::logic_error("material '" + wanted + "' was not resolved");
}

}  // namespace

Material material_of(const Job& job, const std::string& name) {
  return changed(resolved_material(job, job.fatigue.material.empty() ? name : job.fatigue.material),
                 job.fatigue);
}

ParameterKnowledge knowledge_of(const Job& job) {
  return job.calibration ? knowledge_of(*job.calibration) : prior_of(job.uncertainty);
}

const Material& hose_material_of(const Job& job, const Dresspack& dresspack) {
  return resolved_material(job, dresspack.hose_material);
}

}  // namespace dresslife::pipeline
