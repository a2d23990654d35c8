#include "pipeline/resolve/check_job.h"

#include <algorithm>
#include <cmath>

#include "pipeline/cable/overlap.h"
#include "pipeline/job/job_forms.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

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

/// Checks common properties of a robot's dresspacks: one pose in which they are clamped, one material of each name.
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
      const auto same =
          std::ranges::find_if(known, [&](const Material* other) { return other->name == material.name; });
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

/// Checks a prescribed deformation: it needs one dresspack of known length, and keys of things that carry, touch or hold the
/// dresspack are refused because they would have no effect.
void check_prescribed(const Job& job, const Node& document) {
  const char* key = job.motion.rig ? "motion.rig" : "motion.deformation";
  Problems problems;
  const auto refuse = [&](const Where& where, const std::string& what) {
    problems.add(where, fmt::format("{} beside {} (which says how the dresspack deforms)", what, key), "leave it out");
  };
  if (const Node* robot = document.find("robot")) refuse(robot->where, "robot is given");
  const Node* cell = document.find("cell");
  for (const Entry& entry : cell ? cell->entries : std::vector<Entry>{})
    if (entry.key != "temperature_C") refuse(entry.where, "cell." + entry.key + " is given");
  if (const Node* const list = document.find("dresspacks"))
    problems.add(list->where, fmt::format("dresspacks is given, and {} deforms one dresspack", key),
                 "give one with the key dresspack instead of the list");
  const Node* routing = document.find("routing");
  if (job.motion.rig && routing) refuse(routing->where, "routing is given");
  for (const Entry& entry : routing ? routing->entries : std::vector<Entry>{})
    if (entry.key != "free_length_m" && entry.key != "tool_end" && entry.key != "pre_twist_deg" &&
        entry.key != "tool_mass_kg" && entry.key != "side")
      refuse(entry.where, "routing." + entry.key + " is given");
  const Routing& only = job.dresspacks.front().routing;
  if (only.pre_twist != 0 || only.tool_mass != 0 || !is_clamped(only.tool_end))
    refuse(only.where, "an end that is free or twisted is given");
  if (only.side != Side::either) refuse(only.where, "routing.side is given");
  problems.finish(document.where.file);
}

/// Checks that a simulated cable has a mass and a stiffness, which a rig does not need.
void check_simulated(const Dresspack& dresspack) {
  Problems problems;
  const std::pair<const char*, double> needed[] = {{"mass_kg_per_m", dresspack.mass_per_length},
                                                   {"bending_stiffness_Nm2", dresspack.bending_stiffness},
                                                   {"torsional_stiffness_Nm2", dresspack.torsional_stiffness},
                                                   {"axial_stiffness_N", dresspack.axial_stiffness}};
  for (const auto& [key, value] : needed)
    if (value <= 0)
      problems.add(
          dresspack.where, fmt::format("dresspack.{} is missing (a cable that is simulated needs it)", key),
          "give from_construction or the measured value, or let motion.rig or motion.deformation move the cable");
  if (dresspack.damping_source.empty())
    problems.add(dresspack.where, "dresspack.damping_source is missing (a cable that is simulated needs it)",
                 "give damping_time_ms (20 is usual) and where it comes from, or ESTIMATE");
  problems.finish();
}

/// Checks that materials of wires and of the hose's wall have a life of cycles, and that of a sleeve has wear rates.
void check_uses(const Component& part, const Dresspack& dresspack) {
  const auto lives = [&](const std::string& name) {
    const Material* const material = find_material(dresspack, name);
    return !material || material->has_strain_life();
  };
  if (is_wire(part) && !lives(part.material))
    throw InputError(part.where, fmt::format("'{}' is of '{}', which only has wear rates", part.name, part.material),
                     "name a material with a strain-life curve");
  for (const Component& inner : part.components) {
    if (inner.jacket)
      throw InputError(inner.jacket->where, fmt::format("'{}' lies in a cable and has a jacket", inner.name),
                       "give the jacket to the cable in dresspack.components");
    check_uses(inner, dresspack);
  }
}

void check_wear(const Sleeve& layer, const std::string& key, const Dresspack& dresspack) {
  const Material* const material = find_material(dresspack, layer.material);
  if (material && material->wear.empty())
    throw InputError(layer.where, fmt::format("{}.material '{}' has no wear rates", key, material->name),
                     fmt::format("give the material the list wear, or leave the {} out", key));
}

/// name, whole: in words, "the sleeve", "dresspack". radius: of the whole [m].
void check_thickness(const Sleeve& layer, const std::string& name, const char* whole, double radius) {
  if (layer.thickness < radius) return;
  throw InputError(
      layer.where,
      fmt::format("{} is {:.4g} mm thick, the {} {:.4g} mm wide", name, 1e3 * layer.thickness, whole, 2e3 * radius),
      "give thickness_mm of one wall, less than the radius");
}

void check_uses(const Dresspack& dresspack) {
  for (const Component& part : dresspack.components) {
    check_uses(part, dresspack);
    if (!part.jacket) continue;
    check_wear(*part.jacket, "jacket", dresspack);
    check_thickness(*part.jacket, fmt::format("the jacket of '{}'", part.name), "cable", part.radius);
  }
  const Material* const hose = find_material(dresspack, dresspack.hose_material);
  if (hose && !hose->has_strain_life())
    throw InputError(dresspack.where,
                     fmt::format("hose_material '{}' only has wear rates (the wall's strain needs a life)", hose->name),
                     "give it a strain_life_table, or name it in sleeve");
  if (!dresspack.sleeve) return;
  check_wear(*dresspack.sleeve, "sleeve", dresspack);
  check_thickness(*dresspack.sleeve, "the sleeve", "dresspack", dresspack.diameter / 2);
}

void check_routing_of(const Routing& routing, const Dresspack& dresspack, const Robot& robot, const Motion& motion) {
  check_routing(routing, dresspack.diameter, robot, !motion.clamp_poses.empty());
}

/// Checks one dresspack. path: prefix of its keys, "" or "dresspacks[2].". Returns the number of levels of its parts;
/// std::nullopt: unknown.
std::optional<int> check_mounted(const Job& job, const MountedDresspack& mounted, const std::string& path,
                                 Problems& problems) {
  const std::string dresspack = path + "dresspack", routing = path + "routing";
  const auto judge = [&](const std::string& key, const Where& where, const auto& check) {
    return !problems.touch(key) && problems.attempt(key, where, check);
  };
  if (!job.motion.is_prescribed() && !problems.touch("motion")) {
    if (!problems.touch("robot") && !problems.touch(dresspack + ".diameter_mm"))
      judge(routing, mounted.routing.where,
            [&] { check_routing_of(mounted.routing, mounted.dresspack, job.robot, job.motion); });
    judge(dresspack, mounted.dresspack.where, [&] { check_simulated(mounted.dresspack); });
  }
  std::optional<int> depth;
  if (!problems.touch("strain"))
    judge(dresspack + ".components", mounted.dresspack.where,
          [&] { depth = check_dresspack(mounted.dresspack, job.strain.slip); });
  judge(dresspack + ".materials", mounted.dresspack.where, [&] {
    check_materials(mounted.dresspack.materials);
    check_uses(mounted.dresspack);
  });
  judge(dresspack + ".components", mounted.dresspack.where,
        [&] { refuse_gross_overlap(mounted.dresspack); });  // dresslife-strain warns of smaller overlaps
  return depth;
}

void check_dresspacks(const Job& job, const Where& strain, Problems& problems) {
  const JobForms forms = forms_of(job);
  if (!forms.one) problems.attempt("dresspacks", job.dresspacks.front().where, [&] { check_names(job.dresspacks); });
  if (job.dresspacks.size() > 1 && !job.motion.clamp_poses.empty())
    problems.add(
        job.motion.where,
        fmt::format("motion.clamp_poses brings the clamps of one dresspack (there are {})", job.dresspacks.size()),
        "describe the motion by a robot, or keep one dresspack", "motion");
  int depth = 0;
  bool known = true;  // whether the depth of every dresspack is known
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const std::string path = forms.one ? "" : fmt::format("dresspacks[{}].", d + 1);
    const std::optional<int> levels = check_mounted(job, job.dresspacks[d], path, problems);
    known = known && levels;
    depth = std::max(depth, levels.value_or(0));
  }
  if (known) problems.attempt("", job.motion.where, [&] { check_shared(job.dresspacks); });
  if (known && job.strain.slip.size() > 1 && static_cast<int>(job.strain.slip.size()) != depth)
    problems.add(strain,
                 fmt::format("strain.slip lists {} levels (the dresspack has {})", job.strain.slip.size(), depth),
                 "give one word, or one per level, outermost first");
}

/// Checks that lives increase with decreasing strain.
void check_slopes(const Job& job, const Where& where) {
  for (const MountedDresspack& mounted : job.dresspacks)
    for (const Material& material : mounted.dresspack.materials)
      if (material.strain_life_table.empty() && material.has_strain_life() &&
          !(material.fatigue_strength_exponent + job.fatigue.slope_change <= -0.02))
        throw InputError(
            job.fatigue.slope_change > 0 && material.fatigue_strength_exponent <= -0.02 ? where : material.where,
            fmt::format("fatigue.slope_change {} leaves '{}' a slope b of {} (must be -0.02 or less)",
                        job.fatigue.slope_change, material.name,
                        material.fatigue_strength_exponent + job.fatigue.slope_change),
            "give a smaller fatigue.slope_change, or fatigue_strength_exponent: -0.05 to -0.15, as metals have");
}

}  // namespace

void check_between_pieces(const Motion& motion, const Robot& robot, const Routing& routing, const Job& rest) {
  check_motion(motion, robot);
  check_routing_of(routing, rest.dresspacks.front().dresspack, robot, motion);
}

void check_job(const Job& job, const Node& document, Problems& problems) {
  const auto where = [&](const char* key) { return document.find(key) ? document.find(key)->where : document.where; };
  const auto judge = [&](std::initializer_list<const char*> keys, const auto& check) {
    if (std::ranges::none_of(keys, [&](const char* key) { return problems.touch(key); }))
      problems.attempt(*keys.begin(), where(*keys.begin()), check);
  };
  if (job.motion.is_prescribed() && !job.dresspacks.empty())
    judge({"motion", "routing"}, [&] { check_prescribed(job, document); });
  if (job.motion.needs_robot()) judge({"robot"}, [&] { check_robot(job.robot, where("robot")); });
  constexpr double longest_on_link = 10;  // [m]: more than the longest arm and its gripper
  judge({"robot"}, [&] {
    for (const Link& link : job.robot.links) check_boxes(link.boxes, where("robot"), longest_on_link);
  });
  judge({"cell"}, [&] { check_boxes(surroundings(job).boxes, where("cell"), INFINITY); });  // plausible_job.cpp warns
  judge({"motion", "robot"}, [&] { check_motion(job.motion, job.robot); });
  if (!job.dresspacks.empty()) check_dresspacks(job, where("strain"), problems);
  judge({"simulation"}, [&] { check_simulation(job.simulation, where("simulation")); });
  judge({"fatigue", "dresspack", "dresspacks"}, [&] { check_slopes(job, where("fatigue")); });
}

}  // namespace dresslife::pipeline
