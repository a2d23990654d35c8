#include "pipeline/job/learned_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "pipeline/base/digest.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {
namespace {

constexpr std::string_view separator = ", ";
constexpr std::string_view any = "any";
constexpr std::string_view slip_key = "strain.slip";

std::string listed(const std::vector<std::string>& parts, std::string_view by = separator) { return joined(parts, by); }

template <class T>
void add_once(std::vector<T>& all, T one) {
  if (std::ranges::find(all, one) == all.end()) all.push_back(std::move(one));
}

std::size_t levels_of(const std::vector<Component>& parts) {
  return largest_of(parts, std::size_t{0}, [](const Component& part) { return 1 + levels_of(part.components); });
}

/// Returns one word per level, outermost first. The first word is "any" if the dresspack is a single cable.
std::string slip_of(const Job& job, const Dresspack& dresspack) {
  const std::vector<Slip>& slip = job.strain.slip;
  std::vector<std::string> words;
  for (std::size_t level = 0; level < levels_of(dresspack.components); ++level)
    words.emplace_back(level == 0 && dresspack.cable_alone ? any : word(slip[std::min(level, slip.size() - 1)]));
  return listed(words);
}

/// Returns whether two slip settings agree. Levels are counted from the wires, because the cable may be in a hose in only one of
/// the jobs.
bool slips_agree(const std::string& one, const std::string& other) {
  const std::vector<std::string> a = parts_between(one, separator), b = parts_between(other, separator);
  for (std::size_t level = 1; level <= std::min(a.size(), b.size()); ++level) {
    const std::string &of_a = a[a.size() - level], &of_b = b[b.size() - level];
    if (of_a != of_b && of_a != any && of_b != any) return false;
  }
  return true;
}

/// Returns one word if all levels have the same.
std::string slip_words(const std::string& slip) {
  std::vector<std::string> words = parts_between(slip, separator);
  if (words.size() > 1 && words.front() == any) words.erase(words.begin());
  const bool alike = std::ranges::all_of(words, [&](const auto& one) { return one == words.front(); });
  return alike ? words.front() : "[" + listed(words) + "]";
}

std::vector<LearnedSetting> settings_of(const Job& job) {
  std::vector<LearnedSetting> settings;
  for (const MountedDresspack& mounted : job.dresspacks)
    if (std::string slip = slip_of(job, mounted.dresspack); !slip.empty())  // empty: nothing in the dresspack can slip
      add_once(settings, LearnedSetting{std::string(slip_key), std::move(slip)});
  const auto add = [&](const Node& section, const std::string& name, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (const Node* value = section.find(key)) settings.push_back({name + "." + key, value->text});
  };
  add(echo_fields(job.strain), "strain", {"deformation", "kinematics", "equivalent", "surface_fibres"});
  add(echo_fields(job.fatigue), "fatigue",
      {"stress", "mean_stress", "mean_stress_relaxation", "counting", "endurance_strain", "scatter_log10",
       "scatter_shared", "load_sharing"});
  return settings;
}

bool is_friction(const std::string& key) {
  return key == "friction_coefficient" || key == "radial_line_load_N_per_m" ||
         key == "measured_bending_stiffness_Nm2" || key == "measured_at_curvature_1_per_m";
}

/// Removes the friction keys of a part and of all parts in it from their tree and adds them to `words`. Removes names and
/// ratings.
void take_friction(Node& part, std::vector<std::string>& words) {
  const Node* const name = part.find("name");
  const bool measured = part.find("measured_bending_stiffness_Nm2");
  std::string of_part;
  for (const Entry& entry : part.entries)
    if (is_friction(entry.key) && (measured || entry.key != "measured_at_curvature_1_per_m"))
      of_part += (of_part.empty() ? "" : " and ") + entry.key + " " + entry.value.text;
  if (!of_part.empty()) add_once(words, fmt::format("{} ({})", of_part, name ? name->text : ""));
  std::erase_if(part.entries, [](const Entry& entry) {
    return is_friction(entry.key) || entry.key == "name" || entry.key == "layer" || entry.key == "ratings";
  });
  if (Node* const parts = part.find("components"))
    for (Node& inner : parts->items) take_friction(inner, words);
}

LearnedCable cable_of(const std::string& name, const std::string& hose, const std::vector<Component>& parts) {
  LearnedCable cable{name, hose, "", ""};
  std::vector<std::string> friction;
  std::string construction;
  for (const Component& part : parts) {
    Node tree = echo_fields(part);
    take_friction(tree, friction);
    construction += to_yaml(tree);
  }
  cable.friction = listed(friction);
  cable.construction = xxh3(construction);
  return cable;
}

bool holds_wires(const Component& part) { return is_wire(part) || std::ranges::any_of(part.components, holds_wires); }

/// Returns the cables with evaluated wires. A dresspack without a hose is a cable, or has one on its axis.
std::vector<LearnedCable> cables_of(const Dresspack& dresspack) {
  const std::vector<Component>& parts = dresspack.components;
  const bool hose = inner_radius(dresspack) || !dresspack.hose_material.empty();
  if (!hose && has_wires(dresspack)) {
    const bool on_axis = parts.size() == 1 && parts.front().helix_radius == 0 && !parts.front().components.empty();
    return {cable_of(dresspack.name, "", on_axis ? parts.front().components : parts)};
  }
  std::vector<LearnedCable> cables;
  for (const Component& part : parts)
    if (!part.components.empty() && holds_wires(part))
      add_once(cables, cable_of(part.name, dresspack.name, part.components));
  return cables;
}

/// Returns the constants of a material as "key value, key value". No law that is learned depends on its density.
std::string constants_of(const Material& material) {
  std::vector<std::string> words;
  for (const Entry& entry : echo_fields(material).entries)
    if (entry.key != "name" && entry.key != "source" && entry.key != "density_kg_per_m3")
      words.push_back(entry.key + " " + (entry.value.is_scalar() ? entry.value.text : xxh3(to_yaml(entry.value))));
  return listed(words);
}

void add_materials(const std::vector<Component>& parts, const Job& job, const Dresspack& dresspack,
                   std::vector<LearnedMaterial>& materials) {
  for (const Component& part : parts) {
    add_materials(part.components, job, dresspack, materials);
    if (!is_wire(part)) continue;
    const std::string& name = job.fatigue.material.empty() ? part.material : job.fatigue.material;
    if (const Material* const material = find_material(dresspack, name))
      add_once(materials, LearnedMaterial{name, constants_of(*material)});
  }
}

void add_job(const Job& job, LearnedUnder& under) {
  for (LearnedSetting& setting : settings_of(job)) add_once(under.settings, std::move(setting));
  for (const MountedDresspack& mounted : job.dresspacks) {
    for (LearnedCable& cable : cables_of(mounted.dresspack)) add_once(under.cables, std::move(cable));
    add_materials(mounted.dresspack.components, job, mounted.dresspack, under.materials);
  }
}

/// Returns the words of `of` that are not in `beside`.
std::string different(const std::string& of, const std::string& beside) {
  const std::vector<std::string> all = parts_between(of, separator), others = parts_between(beside, separator);
  const auto left =
      filtered(all, [&](const std::string& one) { return std::ranges::find(others, one) == others.end(); });
  return left.empty() ? "none" : listed(left);
}

void compare_settings(const Calibration& calibration, const LearnedUnder& own, std::vector<OtherSetting>& others) {
  for (const LearnedSetting& setting : own.settings) {
    const bool slip = setting.key == slip_key;
    const auto words = [slip](const std::string& value) { return slip ? slip_words(value) : value; };
    std::vector<std::string> learned;
    bool agree = false;
    for (const LearnedSetting& other : calibration.under.settings) {
      if (other.key != setting.key) continue;
      add_once(learned, words(other.value));
      agree |= slip ? slips_agree(other.value, setting.value) : other.value == setting.value;
    }
    if (agree || learned.empty()) continue;  // `learned` is empty for a key that is newer than the calibration
    others.push_back(
        {fmt::format("{}: {} (this job has {})", setting.key, listed(learned, " or "), words(setting.value)),
         fmt::format("set {} as the tests had it, calibrate again with --set '{}={}', or leave out the key "
                     "calibration",
                     setting.key, setting.key, words(setting.value))});
  }
}

void compare_friction(const Calibration& calibration, const LearnedUnder& own, std::vector<OtherSetting>& others) {
  for (const LearnedCable& cable : own.cables) {
    const LearnedCable* same = nullptr;
    bool agree = false;
    for (const LearnedCable& other : calibration.under.cables) {
      if (other.construction != cable.construction) continue;
      same = &other;
      agree |= other.friction == cable.friction;
    }
    if (same && !agree)
      others.push_back(
          {fmt::format("{} in '{}' (this job has {})", different(same->friction, cable.friction), same->name,
                       different(cable.friction, same->friction)),
           "give the cable the friction keys that it had in the tests, calibrate again with those of the job, or "
           "leave out the key calibration"});
  }
}

void compare_constants(const Calibration& calibration, const LearnedUnder& own, std::vector<OtherSetting>& others) {
  for (const LearnedMaterial& material : own.materials)
    for (const LearnedMaterial& other : calibration.under.materials)
      if (other.name == material.name && other.constants != material.constants)
        others.push_back(
            {fmt::format("{} of material '{}' (this job has {})", different(other.constants, material.constants),
                         material.name, different(material.constants, other.constants)),
             "use the material of the tests, calibrate again with this one, or leave out the key calibration"});
}

/// Returns the names of the items that no test had.
template <class T, class Known>
std::vector<std::string> foreign(const std::vector<T>& own, const Known& is_known) {
  std::vector<std::string> names;
  for (const T& one : own)
    if (!is_known(one)) add_once(names, one.name);
  return names;
}

}  // namespace

LearnedUnder learned_under(const std::vector<const Job*>& jobs) {
  LearnedUnder under;
  for (const Job* job : jobs) add_job(*job, under);
  return under;
}

std::vector<OtherSetting> other_settings(const Job& job) {
  const LearnedUnder own = learned_under({&job});
  std::vector<OtherSetting> others;
  compare_settings(*job.calibration, own, others);
  compare_friction(*job.calibration, own, others);
  compare_constants(*job.calibration, own, others);
  return others;
}

void check_learned_settings(const Job& job) {
  const Calibration& calibration = *job.calibration;
  if (calibration.under.settings.empty())
    throw InputError(calibration.where, "does not say under which settings it was learned (strain.slip and others)",
                     "run dresslife calibrate again with the same observations");
  Problems problems;
  for (const OtherSetting& other : other_settings(job))
    problems.add(calibration.where, "was learned with " + other.what, other.remedy);
  problems.finish();
}

std::string service_text(std::size_t failed, std::size_t all) { return fmt::format("{} of {} failed", failed, all); }

bool counts_survivors(const Calibration& calibration) {
  return std::ranges::any_of(calibration.observations, [](const LearnedFrom& from) {
    const std::size_t end = from.observed.find(" failed"), of = from.observed.find(" of ");
    return end != std::string::npos && of != std::string::npos;
  });
}

void leave_out(Calibration& calibration, const std::set<std::string>& names) {
  const std::vector<LearnedParameter> all = std::move(calibration.parameters);
  const auto is_out = [&](std::size_t i) { return names.count(all[i].name) > 0; };
  calibration.parameters.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_out(i)) continue;
    LearnedParameter kept = all[i];
    kept.covariance.clear();
    for (std::size_t j = 0; j < all.size(); ++j)
      if (!is_out(j)) kept.covariance.push_back(all[i].covariance[j]);
    calibration.parameters.push_back(std::move(kept));
  }
}

void leave_out_foreign_parameters(Job& job) {
  Calibration& calibration = *job.calibration;
  const LearnedUnder &under = calibration.under, own = learned_under({&job});
  const auto has = [](const auto& all, const auto& is_same) { return std::ranges::any_of(all, is_same); };
  const std::vector<std::string> cables = foreign(own.cables, [&](const LearnedCable& cable) {
    return has(under.cables, [&](const LearnedCable& other) { return other.construction == cable.construction; });
  });
  std::vector<std::string> hoses;
  for (const LearnedCable& cable : own.cables)
    if (!has(under.cables, [&](const LearnedCable& other) { return other.hose == cable.hose; }))
      add_once(hoses, cable.hose);
  const std::vector<std::string> materials = foreign(own.materials, [&](const LearnedMaterial& material) {
    return has(under.materials, [&](const LearnedMaterial& other) { return other.name == material.name; });
  });
  std::set<std::string> out;
  std::vector<std::string> words;
  const auto leave = [&](const std::vector<std::string>& strangers, const char* kind, const auto& concerns) {
    std::vector<std::string> names;
    for (const LearnedParameter& parameter : calibration.parameters)
      if (!strangers.empty() && concerns(index_of(parameter.name)) && out.insert(parameter.name).second)
        names.push_back(parameter.name);
    if (!names.empty())
      words.push_back(fmt::format("no test has {} {}, for which {} {} not used", kind, listed(strangers), listed(names),
                                  names.size() == 1 ? "is" : "are"));
  };
  const auto shared_by = [](SharedBy what) {
    return [what](std::size_t p) { return p < uncertain_count && uncertain_parameters()[p].shared == what; };
  };
  leave(cables, "the cable", shared_by(SharedBy::construction));
  leave(hoses, "the hose",
        [](std::size_t p) { return p == index_of(Uncertain::friction_hose) || p == index_of(Uncertain::play); });
  leave(materials, "wires of", shared_by(SharedBy::material));
  leave_out(calibration, out);
  calibration.within.left_out = listed(words, "; ");
}

}  // namespace dresslife::pipeline
