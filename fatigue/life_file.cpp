#include "fatigue/life_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "fatigue/attribution.h"
#include "fatigue/cable_forces.h"
#include "fatigue/conductors.h"
#include "fatigue/failure_modes.h"
#include "fatigue/planes.h"
#include "fatigue/strain_life.h"
#include "fatigue/stress_path.h"
#include "fatigue/unvalidated.h"
#include "fatigue/verdict.h"
#include "fatigue/wall_life.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/threads.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/life/planning.h"

namespace dresslife::fatigue {
namespace {

using pipeline::FileReader;
using pipeline::FileWriter;

std::vector<float> as_floats(const std::vector<Reversal>& reversals) {
  return pipeline::mapped(reversals, [](const Reversal& reversal) { return static_cast<float>(reversal.strain); });
}

/// Data that several parts of the output need.
struct Context {
  const FileReader& strain;
  const pipeline::Job& job;
  FileWriter& life;
  SiteSet sites;
  std::size_t threads;
  TextColumn component;
  std::vector<double> time, segment_length, wires_at;
  std::vector<std::size_t> dresspack;  // (segment)
  std::vector<std::int32_t> step;
  std::vector<std::string> step_text;
  SiteCounters counters;
  SiteDamage damage;
  std::optional<JudgedPlanes> planes;
  std::size_t worst = no_site;       // worst wire
  std::size_t worst_wall = no_site;  // worst place of the hose's wall

  Context(const FileReader& strain_file, const pipeline::Job& the_job, FileWriter& life_file, std::size_t thread_count)
      : strain(strain_file),
        job(the_job),
        life(life_file),
        sites(strain, ""),
        threads(thread_count),
        component(read_column(strain, "/site/component")),
        time(strain.read<double>("/time")),
        segment_length(strain.read<double>("/segment/length")),
        wires_at(strain.read<double>("/segment/wires_at")),
        dresspack(pipeline::dresspack_of_segments(strain)),
        step(strain.read<std::int32_t>("/program/step")),
        step_text(strain.read<std::string>("/program/text")),
        counters(sites, component, job) {}

  /// Segments [first, end) of a dresspack.
  struct Range {
    std::size_t first, end;
  };
  Range segments_of(std::size_t of) const {
    const auto [first, end] = std::equal_range(dresspack.begin(), dresspack.end(), of);
    return {static_cast<std::size_t>(first - dresspack.begin()), static_cast<std::size_t>(end - dresspack.begin())};
  }
  std::size_t dresspack_of(std::size_t site) const {
    return site == no_site ? 0 : dresspack[static_cast<std::size_t>(sites.segment(site))];
  }

  /// Returns the number of a segment in its dresspack, counted from 1 at the tool.
  std::size_t number_from_tool(std::size_t segment) const { return segments_of(dresspack[segment]).end - segment; }
  /// Returns the distance along the dresspack from the place where a segment's wires are evaluated to the tool clamp [m].
  double from_tool(std::size_t segment) const {
    const auto [first, end] = segments_of(dresspack[segment]);
    const double length = std::accumulate(segment_length.begin() + static_cast<std::ptrdiff_t>(first),
                                          segment_length.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
    return std::max(0.0, length - wires_at[segment]);  // rounding of the sum
  }
  double repeat_seconds() const { return time.empty() ? 0 : time.back() - time.front(); }
  const std::string* step_at(std::size_t sample) const { return step[sample] < 0 ? nullptr : &step_text[step[sample]]; }
  /// Returns the cycles of a site. They add up to the site's damage, also if this was scaled by another site's ratio (F21).
  /// If mean stress relaxes, their stress is that of the mean share over the life.
  std::vector<DamagingCycle> cycles_of(std::size_t site) const {
    if (site == no_site) return {};
    const double share = offset_share(site);
    std::vector<DamagingCycle> cycles = counters.of(site).cycles(reversals_of(site), share);
    if (share < 1 || (planes && !planes->empty() && !planes->of(site)))
      if (const double counted = sum_of_damage(cycles); counted > 0)
        for (DamagingCycle& cycle : cycles) cycle.damage *= damage.damage[site] / counted;
    return cycles;
  }
  double offset_share(std::size_t site) const {
    return counters.of(site).share_over(life_in_repeats(damage.damage[site]), strains_of(site));
  }
  std::vector<float> strains_of(std::size_t site) const { return as_floats(reversals_of(site)); }
  /// Returns the reversals of the strain with which the site was evaluated.
  std::vector<Reversal> reversals_of(std::size_t site) const {
    if (!planes || !planes->of(site)) return sites.reversals_of(site);
    std::vector<Reversal> reversals = find_reversals(planes->strain_of(site));
    for (Reversal& reversal : reversals) reversal.strain = static_cast<float>(reversal.strain);
    return reversals;
  }
};

constexpr std::array<const char*, percentiles.size()> ends{"p10", "p50", "p90"};

void check_steps(const Context& c) {
  for (const std::int32_t step : c.step) {
    if (step < -1 || step >= static_cast<std::int32_t>(c.step_text.size())) {
      throw pipeline::InputError(
          c.strain.where(), fmt::format("/program/step names line {} (/program/text has {})", step, c.step_text.size()),
          "make the file again with dresslife-strain");
    }
  }
}

std::vector<std::uint32_t> as_index(const std::vector<std::size_t>& sites) { return {sites.begin(), sites.end()}; }

std::vector<double> damage_at(const Context& c, const std::vector<std::size_t>& sites) {
  return pipeline::mapped(sites, [&](std::size_t site) { return site == no_site ? 0 : c.damage.damage[site]; });
}

void write_sites(const Context& c) {
  std::vector<double> values;
  in_blocks(c.sites.size(), [&](std::size_t first, std::size_t count) {  // throws for values that are not finite
    for (const char* table : {"/site/helix", "/site/fibre"}) c.strain.read_rows(table, first, count, values);
  });
  for (const char* table : {"/site/segment", "/site/component", "/site/helix", "/site/fibre", "/site/material"})
    c.life.copy(c.strain, table);
  c.life.append("/damage", c.damage.damage);
  c.life.append("/life", pipeline::mapped(c.damage.damage, life_in_repeats));
}

void write_listed_cycles(const Context& c) {
  std::vector<std::size_t> site;
  std::vector<DamagingCycle> cycles;
  for (const std::size_t listed : worst_wires(c.damage, c.job.fatigue.listed_sites)) {
    const std::vector<DamagingCycle> own = c.cycles_of(listed);
    site.insert(site.end(), own.size(), listed);
    cycles.insert(cycles.end(), own.begin(), own.end());
  }
  const auto put_column = [&](const char* name, auto value) { c.life.append(name, pipeline::mapped(cycles, value)); };
  c.life.append("/cycles/site", as_index(site));
  put_column("/cycles/begin", [](const DamagingCycle& d) { return static_cast<std::uint32_t>(d.cycle.begin.sample); });
  put_column("/cycles/end", [](const DamagingCycle& d) { return static_cast<std::uint32_t>(d.cycle.end.sample); });
  put_column("/cycles/range", [](const DamagingCycle& d) { return d.cycle.range(); });
  put_column("/cycles/mean", [](const DamagingCycle& d) { return d.cycle.mean(); });
  put_column("/cycles/count", [](const DamagingCycle& d) { return d.cycle.count; });
  put_column("/cycles/damage", [](const DamagingCycle& d) { return d.damage; });
}

/// Returns the worst wire, or place of the hose's wall, of each segment.
std::vector<std::size_t> worst_by_segment(const Context& c, bool wires) {
  return worst_by_group(c.damage, c.segment_length.size(), [&](std::size_t site) {
    return c.damage.is_wire(site) == wires ? static_cast<std::size_t>(c.sites.segment(site)) : no_site;
  });
}

void write_segments(const Context& c) {
  const auto worst = worst_by_segment(c, true);
  c.life.append("/segment/length", c.segment_length);
  c.life.append("/segment/dresspack", std::vector<std::int32_t>(c.dresspack.begin(), c.dresspack.end()));
  c.life.append("/segment/worst_site", as_index(worst));
  c.life.append("/segment/damage", damage_at(c, worst));
  c.life.set_axis("sample", c.time.size());
  for (const std::size_t site : worst) {
    const auto cycles = c.cycles_of(site);
    c.life.append("/damage_rate", damage_over_time(cycles, c.time.size(), Moment::closes));
    c.life.append("/damage_rate_opened", damage_over_time(cycles, c.time.size(), Moment::opens));
  }
}

/// Writes the worst wire of each dresspack.
void write_dresspacks(const Context& c) {
  const auto names = pipeline::mapped(c.job.dresspacks, &pipeline::MountedDresspack::name);
  const auto worst = worst_by_group(c.damage, names.size(), [&](std::size_t site) {
    return c.damage.is_wire(site) ? c.dresspack_of(site) : no_site;
  });
  c.life.append("/dresspack/name", names);
  c.life.append("/dresspack/worst_site", as_index(worst));
  c.life.append("/dresspack/damage", damage_at(c, worst));
  c.life.attribute("worst_dresspack", pipeline::name_among(c.job, c.dresspack_of(c.worst)));
}

/// The layers of wires, and the layer of each component; no_site: the hose's wall.
struct Layers {
  std::vector<std::string> name;
  std::vector<std::size_t> of_component;
};

Layers layers_of(const Context& c, const TextColumn& components) {
  Layers result;
  auto& [layers, layer_of_component] = result;
  for (const std::string& component : components.values) {
    const PathInJob place = path_in_job(c.job, component);
    const pipeline::Dresspack& dresspack = c.job.dresspacks[place.dresspack].dresspack;
    if (pipeline::is_hose_wall(dresspack, place.inside)) {
      layer_of_component.push_back(no_site);
      continue;
    }
    const std::string before = component.substr(0, component.size() - place.inside.size());
    const std::string layer = before + layer_of(place.inside, layer_names(dresspack));
    const auto found = std::ranges::find(layers, layer);
    layer_of_component.push_back(found - layers.begin());
    if (found == layers.end()) layers.push_back(layer);
  }
  return result;
}

void write_layers(const Context& c) {
  const Layers layers = layers_of(c, c.component);
  const auto worst = worst_by_group(c.damage, layers.name.size(),
                                    [&](std::size_t site) { return layers.of_component[c.component.index[site]]; });
  c.life.append("/layer/component", layers.name);
  c.life.append("/layer/worst_site", as_index(worst));
  c.life.append("/layer/damage", damage_at(c, worst));
}

/// Groups for settle(): one layer of wires in one segment is a group. The relaxation of its worst wire is used for the others
/// (F24).
struct SettledGroups {
  Layers layers;
  std::size_t count;
  const SiteSet& sites;
  const TextColumn& component;

  SettledGroups(const Context& c, const SiteSet& of_sites, const TextColumn& components)
      : layers(layers_of(c, components)),
        count(layers.name.size() * c.segment_length.size()),
        sites(of_sites),
        component(components) {}
  std::size_t operator()(std::size_t site) const {
    const std::size_t layer = layers.of_component[component.index[site]];
    return layer == no_site ? no_site : static_cast<std::size_t>(sites.segment(site)) * layers.name.size() + layer;
  }
};

/// Returns the rates of load sharing, from the conductor's worst wire.
std::vector<double> sharing_rates_of(const Context& c, std::size_t worst, std::size_t wires) {
  const DamageCounter& counter = c.counters.of(worst);
  DamageCounter::Workspace workspace;
  const std::vector<float> strains = c.strains_of(worst);
  std::vector<float> scaled;
  return sharing_rates(wires, [&](double factor) {
    scaled.clear();
    for (const float strain : strains) scaled.push_back(static_cast<float>(factor * strain));
    return counter.settled_damage(scaled, workspace);
  });
}

Conductors loaded_conductors(const Context& c) {
  std::vector<std::string> layers;
  for (const pipeline::MountedDresspack& mounted : c.job.dresspacks)
    for (const std::string& layer : layer_names(mounted.dresspack)) layers.push_back(layer);
  Conductors conductors = conductors_of(c.damage, c.component, layers);
  for (std::size_t k = 0; k < conductors.path.size(); ++k) {
    ConductorWires& bundle = conductors.bundle[k];
    bundle.dresspack = c.dresspack_of(conductors.worst[k]);
    if (c.job.fatigue.load_sharing) bundle.rate = sharing_rates_of(c, conductors.worst[k], bundle.damage.size());
  }
  return conductors;
}

/// uncertain: lives over all uncertain parameters; null: only the scatter of wires is uncertain.
void write_scatter(const Context& c, const Conductors& conductors, const LifeScatter& scatter,
                   const pipeline::FirstFailures* uncertain) {
  std::vector<std::uint32_t> wires;
  std::vector<double> lives;
  for (const ConductorWires& bundle : conductors.bundle)
    wires.push_back(static_cast<std::uint32_t>(bundle.damage.size()));
  for (const FailureLives& conductor : scatter.conductor) {
    for (const Percentiles& failure : conductor) lives.insert(lives.end(), failure.begin(), failure.end());
  }
  c.life.append("/conductor/component", conductors.path);
  c.life.append("/conductor/wires", wires);
  c.life.append("/conductor/worst_site", as_index(conductors.worst));
  c.life.append("/conductor/life", lives);
  c.life.append("/conductor/place_life", scatter.place);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double by_scatter = hours(scatter.first_place.lives[i], c.repeat_seconds());
    c.life.attribute(fmt::format("life_hours_{}", ends[i]),
                     uncertain ? hours(uncertain->percentiles[i], c.repeat_seconds()) : by_scatter);
    if (uncertain) c.life.attribute(fmt::format("scatter_life_hours_{}", ends[i]), by_scatter);
    c.life.attribute(fmt::format("first_wire_life_hours_{}", ends[i]),
                     hours(scatter.first_wire[i], c.repeat_seconds()));
    c.life.attribute(fmt::format("conductor_life_hours_{}", ends[i]),
                     hours(scatter.first_conductor[i], c.repeat_seconds()));
  }
}

/// Results of a worst site: of the wires, or of the hose's wall.
struct Worst {
  double damage = 0, repeats = life_in_repeats(0), life_hours = repeats, life_months = repeats;
  double segment_from_tool = 0, position_from_tool = 0, time = 0;
  std::string component, step;
};

Worst worst_of(const Context& c, std::size_t site, const std::vector<DamagingCycle>& cycles) {
  Worst worst;
  if (site == no_site) return worst;
  worst.damage = c.damage.damage[site];
  worst.repeats = life_in_repeats(worst.damage);
  worst.life_hours = hours(worst.repeats, c.repeat_seconds());
  worst.life_months = pipeline::months(worst.life_hours, c.job.fatigue.operating_hours_per_week);
  const std::size_t segment = c.sites.segment(site);
  worst.segment_from_tool = double(c.number_from_tool(segment));
  worst.position_from_tool = c.from_tool(segment);
  worst.component = c.component[site];
  const auto most = std::ranges::max_element(cycles, [](const auto& a, const auto& b) { return a.damage < b.damage; });
  const std::size_t sample = most == cycles.end() ? 0 : most->cycle.end.sample;
  worst.time = c.time.empty() ? 0 : c.time[sample];
  if (const std::string* const step = c.step_at(sample)) worst.step = *step;
  return worst;
}

/// Returns the site of the most damaged wire of a conductor in a segment; no_site: none.
std::size_t worst_of_conductor(const Context& c, const Conductors& conductors, std::size_t conductor,
                               std::size_t segment) {
  std::size_t worst = no_site;
  for (std::size_t site = 0; site < c.sites.size(); ++site)
    if (static_cast<std::size_t>(c.sites.segment(site)) == segment &&
        conductors.of_component[c.component.index[site]] == conductor &&
        (worst == no_site || c.damage.damage[site] > c.damage.damage[worst]))
      worst = site;
  return worst;
}

/// Writes the planner's place: that of the conductor that fails soonest in the mode that most often fails first, with the moment of
/// the most damaging cycle of its wires there. The name is empty if no conductor can fail. p10_repeats: [repeats].
void write_first_place(const Context& c, const Conductors& conductors, const FirstPlace& first, const ModeList& modes,
                       std::size_t failing_mode, double p10_repeats) {
  const double p10 = hours(p10_repeats, c.repeat_seconds());
  c.life.attribute("life_months_p10", pipeline::months(p10, c.job.fatigue.operating_hours_per_week));
  if (!c.job.robot.joints.empty()) c.life.attribute("robot_life_hours", c.job.fatigue.robot_life_hours);
  auto place = std::ranges::find_if(first.soonest, [&](const FirstPlace::Soonest& of) {
    return modes.of(c.component[conductors.worst[of.conductor]]) == failing_mode;
  });
  if (place == first.soonest.end()) place = first.soonest.begin();
  const bool known = place != first.soonest.end();
  c.life.attribute("failing_conductor", known ? path_in_words(c.job, conductors.path[place->conductor]) : "");
  c.life.attribute("failing_position_from_tool", known ? c.from_tool(place->segment) : 0.0);
  const std::size_t site = known ? worst_of_conductor(c, conductors, place->conductor, place->segment) : no_site;
  const Worst wire = worst_of(c, site, c.cycles_of(site));
  c.life.attribute("failing_segment_from_tool", wire.segment_from_tool);
  c.life.attribute("failing_time", wire.time);
  c.life.attribute("failing_dresspack", pipeline::name_among(c.job, c.dresspack_of(site)));
}

/// Returns the whole strain history of the worst wire; empty if only its turning points are known.
std::vector<double> worst_history(const Context& c) {
  if (c.worst == no_site) return {};
  if (c.planes && c.planes->of(c.worst)) return c.planes->strain_of(c.worst);
  const auto probed = c.strain.read<std::uint32_t>("/probe/site");
  const auto probe = std::ranges::find(probed, c.worst);
  std::vector<double> strain;
  if (probe != probed.end()) c.strain.read_rows("/probe/strain", probe - probed.begin(), 1, strain);
  return strain;
}

/// Writes the strain of the worst wire, and its stress if a wire was evaluated.
void put_worst(const Context& c, const std::vector<double>& strain) {
  c.life.append("/worst/strain", strain);
  if (c.worst != no_site)
    c.life.append("/worst/stress", stress_along(strain, pipeline::material_of(c.job, c.sites.material()[c.worst]),
                                                c.job.fatigue, c.offset_share(c.worst)));
}

/// Writes the strain of the worst wire; linear between the turning points if the history is unknown. Returns the known strains.
std::vector<Reversal> write_worst_strain(const Context& c) {
  const std::vector<double> history = worst_history(c);
  if (history.empty()) {
    std::vector<Reversal> turns;
    if (c.worst != no_site) turns = c.reversals_of(c.worst);
    if (turns.empty()) {
      put_worst(c, std::vector<double>(c.time.size(), 0.0));
      return {};
    }
    put_worst(c, strain_between_reversals(turns, c.time.size()));
    return turns;
  }
  put_worst(c, history);
  std::vector<Reversal> known;
  for (const double strain : history) known.push_back({strain, static_cast<std::int64_t>(known.size())});
  return known;
}

void write_program(const Context& c, const std::vector<DamagingCycle>& cycles) {
  c.life.append("/time", c.time);
  c.life.append("/program/step", c.step);
  c.life.append("/program/text", c.step_text);
  const auto by_step = [&](Moment moment) {
    return damage_by_step(damage_over_time(cycles, c.time.size(), moment), c.step, c.step_text.size());
  };
  c.life.append("/program/damage", by_step(Moment::closes));
  c.life.append("/program/damage_opened", by_step(Moment::opens));
}

/// Writes the damage near each clamp of each dresspack.
void write_clamps(const Context& c) {
  const std::vector<double> damage = damage_at(c, worst_by_segment(c, true));
  std::vector<std::string> names;
  std::vector<double> near;
  for (std::size_t d = 0; d < c.job.dresspacks.size(); ++d) {
    const std::string name = pipeline::name_among(c.job, d);
    const auto [first, end] = c.segments_of(d);
    const auto lengths = std::span(c.segment_length).subspan(first, end - first);
    std::vector<double> at;
    for (const ClampPlace& clamp :
         clamps_of(c.job.dresspacks[d].routing, std::accumulate(lengths.begin(), lengths.end(), 0.0))) {
      names.push_back(name.empty() ? clamp.name : fmt::format("{}, {}", name, clamp.name));
      at.push_back(clamp.at);
    }
    const auto each = damage_by_clamp(std::span(damage).subspan(first, end - first), lengths, at);
    near.insert(near.end(), each.begin(), each.end());
  }
  c.life.append("/clamp/name", names);
  c.life.append("/clamp/damage", near);
}

/// Writes the damage by joint and clamp. Writes nothing about joints if the motion is given by its clamps.
void write_causes(const Context& c, const std::vector<DamagingCycle>& cycles, const std::vector<Reversal>& known) {
  write_clamps(c);
  const char* const joints = "/robot/joint_position";
  const std::vector<bool> between = joints_between_clamps(c.job, c.dresspack_of(c.worst));
  if (!c.strain.has(joints) || c.strain.row_size(joints) != between.size() || known.empty()) return;
  const auto position = c.strain.read<double>(joints);
  const StrainOfJoints surface(position, known, between);
  const JointDamage by_joint = damage_by_joint(cycles, surface, c.step, c.step_text.size());
  std::vector<std::string> names = c.job.robot.axis_names();
  names.push_back("carrying");
  c.life.set_axis("cause", names.size());
  c.life.append("/joint/name", names);
  c.life.append("/joint/damage", by_joint.damage);
  c.life.append("/program/joint_damage", by_joint.by_line);
  c.life.attribute("joint_explained", surface.explained());
  const auto most = std::ranges::max_element(by_joint.damage) - by_joint.damage.begin();
  const double total = sum_of_damage(cycles);
  c.life.attribute("worst_joint", total > 0 ? names[most] : "");
  c.life.attribute("worst_joint_share", total > 0 ? by_joint.damage[most] / total : 0);
}

/// before, place: prefixes of the names of the attributes.
void put_attributes(FileWriter& life, const Worst& worst, const std::string& before, const std::string& place) {
  life.attribute(before + "life_repeats", worst.repeats);
  life.attribute(before + "life_hours", worst.life_hours);
  life.attribute(before + "life_months", worst.life_months);
  life.attribute(before + "damage_per_repeat", worst.damage);
  life.attribute(place + "segment_from_tool", worst.segment_from_tool);
  life.attribute(place + "position_from_tool", worst.position_from_tool);
  life.attribute(place + "component", worst.component);
  life.attribute(place + "time", worst.time);
  life.attribute(place + "step", worst.step);
}

/// Copies the numerical errors of loose cables.
void copy_loose_errors(const Context& c) {
  for (const char* name : {"loose_mesh_error", "moving_places"})
    if (c.strain.has_attribute(name)) c.life.attribute(name, c.strain.number_attribute(name));
}

/// Returns "uncertainty.ratings typical (strength x 1.2, model x 1.3)"; empty: no typical ratings.
std::string ratings_words(const pipeline::Job& job) {
  if (!job.calibration || !job.calibration->typical) return "";
  std::vector<std::string> words;
  for (const pipeline::LearnedParameter& learned : job.calibration->parameters) {
    if (pipeline::is_wall_strength(learned.name)) continue;
    const pipeline::UncertainParameter& parameter = pipeline::uncertain_parameters()[pipeline::index_of(learned.name)];
    words.push_back(fmt::format("{} {}{:.3g}", parameter.name, parameter.logarithmic ? "x " : "+ ",
                                parameter.value(learned.median)));
  }
  return fmt::format("uncertainty.ratings typical ({})", fmt::join(words, ", "));
}

/// Writes the estimates of the dresspacks, which a reader of the hours must know.
void write_estimates(const Context& c) {
  std::string words;
  for (std::size_t d = 0; d < c.job.dresspacks.size(); ++d) {
    const std::string& of_one = c.job.dresspacks[d].dresspack.estimates;
    const std::string name = pipeline::name_among(c.job, d);
    if (!of_one.empty()) words += (words.empty() ? "" : "; ") + (name.empty() ? "" : name + ": ") + of_one;
  }
  if (const std::string ratings = ratings_words(c.job); !ratings.empty())
    words += (words.empty() ? "" : "; ") + ratings;
  c.life.attribute("estimates", words);
}

/// Writes the effect of mean stress on the worst wire's life: with all of the mean stress, and without it.
void write_mean_stress(const Context& c) {
  if (c.worst == no_site) return;
  const pipeline::Material& material = pipeline::material_of(c.job, c.sites.material()[c.worst]);
  pipeline::Fatigue without = c.job.fatigue;
  without.mean_stress = pipeline::MeanStress::none;
  const std::vector<Reversal> reversals = c.reversals_of(c.worst);
  const auto hours_with = [&](const pipeline::Fatigue& settings) {
    const double damage = sum_of_damage(evaluate_cycles(reversals, material, settings));
    return hours(life_in_repeats(damage), c.repeat_seconds());
  };
  c.life.attribute("life_hours_mean_stress_kept", hours_with(c.job.fatigue));
  c.life.attribute("life_hours_without_mean_stress", hours_with(without));
  c.life.attribute("mean_stress_left", c.offset_share(c.worst));
}

/// Writes the worst wire's life, place and time. Returns the summary for the terminal.
std::string write_worst(const Context& c, const std::vector<DamagingCycle>& cycles, double p10_repeats) {
  const Worst worst = worst_of(c, c.worst, cycles);
  put_attributes(c.life, worst, "", "worst_");
  c.life.attribute("repeat_seconds", c.repeat_seconds());
  c.life.attribute("worst_site", c.worst == no_site ? -1 : double(c.worst));
  write_mean_stress(c);
  copy_loose_errors(c);
  write_estimates(c);
  if (c.worst == no_site) return "no wire was evaluated";
  if (worst.damage == 0) return "no wire is damaged";
  const double p10 = hours(p10_repeats, c.repeat_seconds());
  return fmt::format(
      "{} ({} months) until 10 % of such dresspacks have a conductor {} at one place; worst wire: {} h ({} "
      "repeats) until {} breaks, {:.2f} m from the tool{}",
      std::isinf(p10) ? "no failure" : pipeline::readable(p10) + " h",
      pipeline::readable(pipeline::months(p10, c.job.fatigue.operating_hours_per_week)),
      c.job.fatigue.failed_wires_percent > 0
          ? fmt::format("without {:g} % of its wires", c.job.fatigue.failed_wires_percent)
          : "with a broken wire",
      pipeline::readable(worst.life_hours), pipeline::readable(worst.repeats), worst.component,
      worst.position_from_tool, worst.step.empty() ? "" : ", worst during '" + worst.step + "'");
}

/// Writes the life of the hose's wall (F37); nothing without a wall. lives: (sample) log10 repeats of the validated modes.
std::vector<pipeline::UnvalidatedMode> write_hose(const Context& c, const std::vector<double>& lives) {
  if (c.worst_wall == no_site) return {};
  const auto worst_sites = worst_by_segment(c, false);
  c.life.append("/hose/worst_site", as_index(worst_sites));
  c.life.append("/hose/damage", damage_at(c, worst_sites));
  const Worst worst = worst_of(c, c.worst_wall, c.cycles_of(c.worst_wall));
  put_attributes(c.life, worst, "hose_", "hose_");
  std::vector<pipeline::UnvalidatedMode> modes;
  pipeline::FailureModes responses;
  for (const std::size_t site : worst_by_group(c.damage, c.job.dresspacks.size(), [&](std::size_t of) {
         return c.damage.is_wire(of) ? no_site : c.dresspack_of(of);
       })) {
    if (site == no_site) continue;
    const Worst wall = worst_of(c, site, c.cycles_of(site));
    pipeline::UnvalidatedMode& mode = modes.emplace_back();
    mode.mode = pipeline::UnvalidatedMode::wall;
    mode.dresspack = pipeline::name_among(c.job, c.dresspack_of(site));
    const pipeline::LifeResponse& response =
        responses.emplace_back(wall_response(c.reversals_of(site), c.job, c.dresspack_of(site)));
    mode.bends_at_limit = wall_bends_at_limit(response, c.job, c.dresspack_of(site));
    set_lives(mode, pipeline::first_failures({response}, "", lives.size()), lives, c.repeat_seconds());
    if (!is_credible(mode)) mode.first_share = mode.together_p10 = pipeline::UnvalidatedMode::unknown;
    mode.segment_from_tool = static_cast<int>(wall.segment_from_tool);
    mode.position_from_tool = wall.position_from_tool;
    mode.place = wall.component;
    mode.time = wall.time;
    mode.step = wall.step;
  }
  c.life.attribute("wall_response", pipeline::modes_text(responses));
  return modes;
}

/// Writes the modes that are not in the planner's hours. Returns notes for the terminal. lives: (sample) log10 repeats of the
/// validated modes. tension: see corkscrew.h. Adds to the warnings.
std::string write_unvalidated(const Context& c, const std::vector<double>& lives,
                              const std::vector<std::vector<double>>& tension,
                              std::vector<pipeline::Warning>& warnings) {
  auto [modes, left_out, doubts] = unvalidated_modes(c.strain, c.job, lives, tension);
  warnings = pipeline::joined(std::move(warnings), std::move(doubts));
  const auto wall = write_hose(c, lives);
  modes.insert(modes.end(), wall.begin(), wall.end());
  c.life.attribute("unvalidated_modes", pipeline::unvalidated_text(modes));
  c.life.attribute("not_evaluated", left_out);
  std::string summary;
  for (const pipeline::UnvalidatedMode& mode : modes)
    if (!is_credible(mode))
      summary += "; the life of the hose's wall is not predicted";
    else if (mode.mode != pipeline::UnvalidatedMode::rating && mode.mode != pipeline::UnvalidatedMode::corkscrew &&
             mode.mode != pipeline::UnvalidatedMode::kink)
      summary += fmt::format(
          "; the {} {}",
          mode.mode == pipeline::UnvalidatedMode::wall     ? "hose's wall"
          : mode.mode == pipeline::UnvalidatedMode::jacket ? "worst jacket"
                                                           : "surface",
          std::isinf(mode.hours[1]) ? "is not damaged" : "lasts " + pipeline::readable(mode.hours[1]) + " h");
  return summary;
}

/// Returns whether every level of the job slips in this manner. Cables are excepted, because in a bound they slide as in the job.
/// Then the job's own sites are the bound; they are all wires, not only the likely worst ones.
bool is_own_slip(const pipeline::Job& job, pipeline::Slip slip) {
  const auto holds_wires = [](const pipeline::MountedDresspack& mounted) {
    return std::ranges::any_of(mounted.dresspack.components,
                               [](const pipeline::Component& part) { return is_wire(part); });
  };
  const bool cables_only = pipeline::slides(job.strain.slip.front()) && job.strain.slip.size() > 1 &&
                           std::ranges::none_of(job.dresspacks, holds_wires);
  return std::all_of(job.strain.slip.begin() + (cables_only ? 1 : 0), job.strain.slip.end(),
                     [&](pipeline::Slip own) { return own == slip; });
}

SiteDamage damage_of_bound(const Context& c, const SiteSet& sites, const TextColumn& component, pipeline::Slip slip,
                           const std::function<void(double)>& progress) {
  const SiteCounters counters(sites, component, c.job, most_reversals,
                              slip == pipeline::Slip::stick ? Compression::without_effect : Compression::by_rule);
  SiteDamage damage = damage_of(sites, counters, c.threads, progress);
  const SettledGroups group_of(c, sites, component);
  settle(
      damage, counters, group_of.count, group_of, [&](std::size_t site) { return as_floats(sites.reversals_of(site)); },
      c.threads);
  return damage;
}

/// Writes a bound. Returns the worst wire's life of each mode [repeats].
std::vector<double> write_bound(const Context& c, const ModeList& modes, const std::string& name, pipeline::Slip slip,
                                const std::function<void(double)>& progress) {
  const SiteSet sites(c.strain, "/bound_" + name);
  if (sites.size() == 0 && c.sites.size() > 0) {
    throw pipeline::InputError(c.strain.where(), fmt::format("/bound_{} holds no sites", name),
                               "make the file again with dresslife-strain");
  }
  const TextColumn component = read_column(c.strain, "/bound_" + name + "/site/component");
  const SiteDamage damage = is_own_slip(c.job, slip) ? c.damage : damage_of_bound(c, sites, component, slip, progress);
  const std::size_t worst = damage.worst_wire();
  const double repeats = life_in_repeats(worst == no_site ? 0 : damage.damage[worst]);
  c.life.attribute("life_repeats_all_" + name, repeats);
  c.life.attribute("life_hours_all_" + name, hours(repeats, c.repeat_seconds()));
  const TextColumn& of_sites = is_own_slip(c.job, slip) ? c.component : component;
  const std::vector<std::size_t> mode = modes.of(of_sites);
  std::vector<double> lives;
  for (const std::size_t site : worst_by_group(damage, modes.size(), [&](std::size_t of) {
         return damage.is_wire(of) ? mode[of_sites.index[of]] : no_site;
       }))
    lives.push_back(life_in_repeats(site == no_site ? 0 : damage.damage[site]));
  return lives;
}

/// Writes the shear of the worst wire, and the evaluated planes.
void write_shear(const Context& c) {
  if (c.planes && !c.planes->empty()) {
    std::vector<double> angle, damage;
    for (const CriticalPlane& plane : c.planes->planes()) {
      angle.push_back(plane.theta);
      damage.push_back(plane.damage);
    }
    c.life.append("/plane/site", as_index(c.planes->sites()));
    c.life.append("/plane/angle", angle);
    c.life.append("/plane/damage", damage);
    if (const CriticalPlane* plane = c.planes->of(c.worst)) c.life.attribute("worst_plane_angle", plane->theta);
  }
  if (!c.strain.has("/probe/shear")) return;
  const auto probed = c.strain.read<std::uint32_t>("/probe/site");
  const auto probe = std::ranges::find(probed, c.worst);
  if (probe == probed.end()) return;
  std::vector<double> shear;
  c.strain.read_rows("/probe/shear", probe - probed.begin(), 1, shear);
  const auto [low, high] = std::ranges::minmax_element(shear);
  c.life.attribute("worst_shear_range", *high - *low);
}

/// Writes the lives over all uncertain parameters (F27), with bounds, causes, and the best measurement.
pipeline::FirstFailures write_first_failures(const Context& c, const pipeline::FailureModes& modes) {
  pipeline::FirstFailures lives = pipeline::summary_of(modes, "");
  const auto put_hours = [&](const std::string& name, double repeats) {
    c.life.attribute(name, hours(repeats, c.repeat_seconds()));
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    put_hours(fmt::format("life_hours_{}_all_glued", ends[i]), lives.glued[i]);
    put_hours(fmt::format("life_hours_{}_all_free", ends[i]), lives.free[i]);
  }
  const auto most = std::ranges::max_element(lives.first);
  c.life.attribute("failing_mode",
                   *most > 0 ? modes[static_cast<std::size_t>(most - lives.first.begin())].mode : std::string());
  c.life.attribute("failing_mode_share", *most);
  if (!c.job.uncertainty.enabled) return lives;
  const std::size_t cause = pipeline::largest_share(lives.share);
  c.life.attribute("life_response", pipeline::modes_text(modes));
  c.life.attribute("life_shares", pipeline::share_words(lives.share));
  c.life.attribute("measure_next",
                   cause < pipeline::uncertain_count ? std::string(pipeline::uncertain_parameters()[cause].name) : "");
  c.life.attribute("measure_next_share", lives.share[cause]);
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (std::isfinite(lives.error_factor[i]))
      c.life.attribute(fmt::format("life_error_{}", ends[i]), lives.error_factor[i]);
  c.life.attribute("best_test",
                   lives.best_test ? std::string(pipeline::uncertain_parameters()[*lives.best_test].name) : "");
  put_hours("best_test_life_hours_p10", lives.best_test ? lives.after_test[0] : lives.percentiles[0]);
  put_hours("best_test_life_hours_p90", lives.best_test ? lives.after_test[2] : lives.percentiles[2]);
  return lives;
}

pipeline::FirstFailures first_failures_of(const Context& c, const ModeList& modes, const Conductors& conductors,
                                          const std::vector<PlacesOfConductor>& places, const LifeScatter& scatter,
                                          const std::vector<double>& glued, const std::vector<double>& free) {
  std::vector<std::size_t> starts;
  std::vector<VariedStrains> varied;
  std::vector<double> taut;
  if (c.job.uncertainty.enabled)
    varied = read_variations(c.strain, c.sites.size()), starts = read_rests(c.strain),
    taut = read_taut_stiffnesses(c.strain);
  std::function<std::vector<float>(std::size_t)> strains_of = [&](std::size_t site) { return c.strains_of(site); },
                                                 equivalent_of;
  if (!c.planes->empty()) {
    strains_of = [&](std::size_t site) { return c.planes->of(site) ? c.strains_of(site) : std::vector<float>(); };
    equivalent_of = [&](std::size_t site) { return as_floats(c.sites.reversals_of(site)); };
  }
  const ModeInputs inputs{c.job,
                          c.sites,
                          c.component,
                          c.damage,
                          conductors,
                          places,
                          c.segment_length.size(),
                          c.threads,
                          std::move(strains_of),
                          std::move(equivalent_of),
                          std::move(starts),
                          std::move(varied),
                          std::move(taut),
                          glued,
                          free,
                          scatter.first_place.lives};
  return write_first_failures(c, failure_modes(modes, inputs));
}

/// Evaluates the planes if the strain file contains them, and replaces the damage of the equivalent strain. Then applies the
/// relaxation of mean stress over each site's life.
void judge(Context& c) {
  c.planes.emplace(c.strain, c.sites, c.counters, c.job, c.threads);
  const SettledGroups group_of(c, c.sites, c.component);
  if (!c.planes->empty()) c.planes->apply(c.damage, group_of.count, group_of);
  settle(
      c.damage, c.counters, group_of.count, group_of, [&](std::size_t site) { return c.strains_of(site); }, c.threads);
}

/// Returns warnings where the job exceeds the tests from which its calibration was learned.
std::vector<pipeline::Warning> beyond_calibration(const Context& c) {
  if (!c.job.calibration || c.job.calibration->typical || c.worst == no_site) return {};
  std::vector<pipeline::Warning> warnings;
  pipeline::Experience experience;
  experience.strain_range = c.damage.range[c.worst];
  const auto curvature = c.strain.read<double>("/deformation/curvature");
  for (std::size_t k = 0; k + 1 < curvature.size(); k += 2)
    experience.curvature = std::max(experience.curvature, std::hypot(curvature[k], curvature[k + 1]));
  for (const double twist : c.strain.read<double>("/deformation/twist"))
    experience.twist = std::max(experience.twist, std::abs(twist));
  if (c.job.calibration->own_spread != 1 && c.job.calibration->residual_spread == 1)
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::calibration, "",
        "the records of the calibration have no dresspack with the motion and routing of this job, so the error of its computed "
        "life counts in full",
        "another program or routing than in the records",
        "if its dresspacks have run, this job in the column Job of the maintenance system's table"));
  for (const std::string& words : pipeline::beyond(c.job.calibration->within, experience))
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::calibration, "", "the job goes beyond the tests of its calibration: " + words,
        "no observation of the calibration strains a cable like this job",
        "add such an observation to the list of dresslife calibrate, or this job to the column Job of a maintenance system's "
        "table; or leave out the key calibration"));
  return warnings;
}

std::vector<pipeline::Warning> warnings_of(const Context& c, const std::vector<DamagingCycle>& worst_cycles) {
  std::map<std::string, pipeline::Warning> contradictions;  // sorted, without duplicates
  for (const std::string& name : c.sites.material().values) {
    const auto& packs = c.job.dresspacks;
    if (std::ranges::any_of(
            packs, [&](const pipeline::MountedDresspack& mounted) { return mounted.dresspack.hose_material == name; }))
      continue;
    const pipeline::Material& material = pipeline::material_of(c.job, name);
    if (!yields(c.job.fatigue.stress) || !material.strain_life_table.empty()) continue;
    if (const auto warning = compatibility_warning(material)) contradictions.emplace(warning->words, *warning);
  }
  const auto torn = std::ranges::count_if(
      worst_cycles, [](const DamagingCycle& d) { return d.damage >= d.cycle.count * 2 / fewest_reversals; });
  std::vector<pipeline::Warning> warnings;
  for (const auto& [words, warning] : contradictions) warnings.push_back(warning);
  if (torn > 0) {
    const bool sticks = std::ranges::any_of(c.job.strain.slip, [](pipeline::Slip slip) { return !slides(slip); });
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::strain, "",
        fmt::format(
            "{} of the cycles of {} tear it on their first reversal (strain range up to {:.3g}), in segment {} from the tool",
            torn, c.component[c.worst], c.damage.range[c.worst],
            c.number_from_tool(static_cast<std::size_t>(c.sites.segment(c.worst)))),
        sticks ? "its parts stick to each other (strain.slip is stick)"
               : "the dresspack bends too tightly, or a lay is too long or missing",
        sticks
            ? "strain.slip: friction"
            : "a larger bend radius (see its warnings, or dresslife improve), or lay_angle_deg of its layers as measured"));
  }
  return pipeline::joined(warnings, beyond_calibration(c));
}

}  // namespace

Notes write_life(const FileReader& strain, const pipeline::Job& job, FileWriter& life, std::size_t threads,
                 const std::function<void(double)>& progress) {
  Context c(strain, job, life, threads);
  check_steps(c);
  pipeline::check_lengths(c.strain, free_lengths(c.job));
  // The three sets have about equal sizes.
  c.damage = damage_of(c.sites, c.counters, threads, [&](double share) { progress(share / 3); });
  judge(c);
  c.worst = c.damage.worst_wire();
  c.worst_wall = c.damage.worst_wall();
  const Conductors conductors = loaded_conductors(c);
  const std::size_t segments = c.segment_length.size();
  const std::vector<PlacesOfConductor> places =
      places_of(c.damage, c.component, conductors, segments,
                [&](std::size_t site) { return static_cast<std::size_t>(c.sites.segment(site)); });
  std::future<LifeScatter> scatter =
      pipeline::beside<LifeScatter>([&] { return life_scatter(conductors, places, segments, c.job.fatigue); });
  const ModeList modes(job, c.component);
  const auto glued =
      write_bound(c, modes, "stick", pipeline::Slip::stick, [&](double share) { progress((1 + share) / 3); });
  const auto free =
      write_bound(c, modes, "free", pipeline::Slip::free, [&](double share) { progress((2 + share) / 3); });
  const auto cycles = c.cycles_of(c.worst);
  write_sites(c);
  write_listed_cycles(c);
  write_segments(c);
  write_dresspacks(c);
  write_layers(c);
  LifeScatter lives = scatter.get();
  const pipeline::FirstFailures first = first_failures_of(c, modes, conductors, places, lives, glued, free);
  lives.first_place.lives =
      near_first_wire(lives.first_place.lives, c.worst == no_site ? std::numeric_limits<double>::infinity()
                                                                  : life_in_repeats(c.damage.damage[c.worst]));
  const double p10_repeats = job.uncertainty.enabled ? first.percentiles[0] : lives.first_place.lives[0];
  write_scatter(c, conductors, lives, job.uncertainty.enabled ? &first : nullptr);
  const auto most = std::ranges::max_element(first.first);
  write_first_place(c, conductors, lives.first_place, modes, static_cast<std::size_t>(most - first.first.begin()),
                    p10_repeats);
  write_shear(c);
  write_program(c, cycles);
  write_causes(c, cycles, write_worst_strain(c));
  const std::string summary = write_worst(c, cycles, p10_repeats);
  const CableForces forces = write_cable_forces(strain, job, life);
  std::vector<pipeline::Warning> warnings = pipeline::joined(forces.warnings, warnings_of(c, cycles));
  const std::string unvalidated = write_unvalidated(c, first.log10_life, forces.tension, warnings);
  return {std::move(warnings), summary + unvalidated};
}

}  // namespace dresslife::fatigue
