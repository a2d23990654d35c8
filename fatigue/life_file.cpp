#include "fatigue/life_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "fatigue/conductors.h"
#include "fatigue/stress_path.h"
#include "fatigue/verdict.h"
#include "pipeline/readable.h"

namespace dresslife::fatigue {
namespace {

using pipeline::FileReader;
using pipeline::FileWriter;

/// Everything about the file that several parts of the output need.
struct Context {
  const FileReader& strain;
  const pipeline::Job& job;
  FileWriter& life;
  SiteSet sites;
  std::size_t threads;
  TextColumn component;
  std::vector<double> time, segment_length;
  std::vector<std::int32_t> step;
  std::vector<std::string> step_text;
  std::vector<DamageCounter> counters;
  SiteDamage damage;
  std::size_t worst = no_site;

  Context(const FileReader& strain_file, const pipeline::Job& the_job, FileWriter& life_file,
          std::size_t thread_count)
      : strain(strain_file),
        job(the_job),
        life(life_file),
        sites(strain, ""),
        threads(thread_count),
        component(read_column(strain, "/site/component")),
        time(strain.read<double>("/time")),
        segment_length(strain.read<double>("/segment/length")),
        step(strain.read<std::int32_t>("/program/step")),
        step_text(strain.read<std::string>("/program/text")),
        counters(counters_for(sites, job)) {}

  double repeat_seconds() const { return time.empty() ? 0 : time.back() - time.front(); }
  const std::string* step_at(std::size_t sample) const {
    return step[sample] < 0 ? nullptr : &step_text[step[sample]];
  }
  std::vector<DamagingCycle> cycles_of(std::size_t site) const {
    return counters[sites.material().index[site]].cycles(sites.reversals_of(site));
  }
};

void check_steps(const Context& c) {
  for (const std::int32_t step : c.step) {
    if (step < -1 || step >= static_cast<std::int32_t>(c.step_text.size())) {
      throw pipeline::InputError(
          c.strain.where(),
          fmt::format("/program/step names line {} (/program/text has {})", step, c.step_text.size()),
          "make the file anew with dresslife-strain");
    }
  }
}

template <class T>
void put(FileWriter& file, const std::string& dataset, const std::vector<T>& values) {
  file.append(dataset, std::span<const T>(values));
}

std::vector<std::uint32_t> as_index(const std::vector<std::size_t>& sites) {
  return {sites.begin(), sites.end()};
}

std::vector<double> damage_at(const Context& c, const std::vector<std::size_t>& sites) {
  std::vector<double> damage;
  for (const std::size_t site : sites) damage.push_back(site == no_site ? 0 : c.damage.damage[site]);
  return damage;
}

void write_sites(const Context& c) {
  c.life.set_axis("level", c.strain.row_size("/site/helix") / 3);
  c.life.set_text_width("/site/component", c.component.longest());
  c.life.set_text_width("/site/material", c.sites.material().longest());
  std::vector<std::int32_t> segment;
  std::vector<double> values;
  const auto copy = [&](std::size_t first, std::size_t count) {
    c.strain.read_rows("/site/segment", first, count, segment);
    put(c.life, "/site/segment", segment);
    put(c.life, "/site/component", c.component.rows(first, count));
    for (const char* dataset : {"/site/helix", "/site/fibre"}) {
      c.strain.read_rows(dataset, first, count, values);
      put(c.life, dataset, values);
    }
    put(c.life, "/site/material", c.sites.material().rows(first, count));
  };
  copy(0, 0);  // a file without sites has the tables too
  in_blocks(c.sites.size(), copy);
  put(c.life, "/damage", c.damage.damage);
  std::vector<double> life;
  for (const double damage : c.damage.damage) life.push_back(life_in_repeats(damage));
  put(c.life, "/life", life);
}

void write_listed_cycles(const Context& c) {
  std::vector<std::uint32_t> site, begin, end;
  std::vector<double> range, mean, count, damage;
  for (const std::size_t listed : worst_sites(c.damage, c.job.fatigue.listed_sites)) {
    for (const DamagingCycle& d : c.cycles_of(listed)) {
      site.push_back(static_cast<std::uint32_t>(listed));
      begin.push_back(static_cast<std::uint32_t>(d.cycle.begin.sample));
      end.push_back(static_cast<std::uint32_t>(d.cycle.end.sample));
      range.push_back(d.cycle.range());
      mean.push_back(d.cycle.mean());
      count.push_back(d.cycle.count);
      damage.push_back(d.damage);
    }
  }
  put(c.life, "/cycles/site", site);
  put(c.life, "/cycles/begin", begin);
  put(c.life, "/cycles/end", end);
  put(c.life, "/cycles/range", range);
  put(c.life, "/cycles/mean", mean);
  put(c.life, "/cycles/count", count);
  put(c.life, "/cycles/damage", damage);
}

void write_segments(const Context& c) {
  const auto worst = worst_by_group(c.damage, c.segment_length.size(), [&](std::size_t site) {
    return static_cast<std::size_t>(c.sites.segment(site));
  });
  put(c.life, "/segment/length", c.segment_length);
  put(c.life, "/segment/worst_site", as_index(worst));
  put(c.life, "/segment/damage", damage_at(c, worst));
  c.life.set_axis("sample", c.time.size());
  for (const std::size_t site : worst) {
    const auto cycles = site == no_site ? std::vector<DamagingCycle>{} : c.cycles_of(site);
    put(c.life, "/damage_rate", damage_over_time(cycles, c.time.size(), Moment::closes));
    put(c.life, "/damage_rate_opened", damage_over_time(cycles, c.time.size(), Moment::opens));
  }
}

void write_layers(const Context& c) {
  const auto known_layers = layer_names(c.job.dresspack);
  std::vector<std::string> layers;
  std::vector<std::size_t> layer_of_component;
  for (const std::string& component : c.component.values) {
    const std::string layer = layer_of(component, known_layers);
    const auto found = std::find(layers.begin(), layers.end(), layer);
    layer_of_component.push_back(found - layers.begin());
    if (found == layers.end()) layers.push_back(layer);
  }
  const auto worst = worst_by_group(
      c.damage, layers.size(), [&](std::size_t site) { return layer_of_component[c.component.index[site]]; });
  put(c.life, "/layer/component", layers);
  put(c.life, "/layer/worst_site", as_index(worst));
  put(c.life, "/layer/damage", damage_at(c, worst));
}

/// The worst wire of a conductor, when its neighbours have left it their load.
std::vector<double> sharing_rates_of(const Context& c, std::size_t worst, std::size_t wires) {
  const DamageCounter& counter = c.counters[c.sites.material().index[worst]];
  DamageCounter::Workspace workspace;
  std::vector<float> strains, scaled;
  for (const Reversal& r : c.sites.reversals_of(worst)) strains.push_back(static_cast<float>(r.strain));
  return sharing_rates(wires, [&](double factor) {
    scaled.clear();
    for (const float strain : strains) scaled.push_back(static_cast<float>(factor * strain));
    return counter(scaled, workspace);
  });
}

void write_scatter(const Context& c) {
  Conductors conductors = conductors_of(c.damage, c.component, layer_names(c.job.dresspack));
  std::vector<std::uint32_t> wires;
  std::vector<double> lives;
  for (std::size_t k = 0; k < conductors.path.size(); ++k) {
    Bundle& bundle = conductors.bundle[k];
    wires.push_back(static_cast<std::uint32_t>(bundle.damage.size()));
    if (c.job.fatigue.load_sharing)
      bundle.rate = sharing_rates_of(c, conductors.worst[k], bundle.damage.size());
  }
  const LifeScatter scatter = life_scatter(conductors, c.job.fatigue);
  for (const FailureLives& conductor : scatter.conductor) {
    for (const Percentiles& failure : conductor) lives.insert(lives.end(), failure.begin(), failure.end());
  }
  put(c.life, "/conductor/component", conductors.path);
  put(c.life, "/conductor/wires", wires);
  put(c.life, "/conductor/worst_site", as_index(conductors.worst));
  put(c.life, "/conductor/life", lives);
  const std::array<const char*, percentiles.size()> ends{"p10", "p50", "p90"};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    c.life.attribute(fmt::format("life_hours_{}", ends[i]), hours(scatter.first_wire[i], c.repeat_seconds()));
    c.life.attribute(fmt::format("conductor_life_hours_{}", ends[i]),
                     hours(scatter.first_conductor[i], c.repeat_seconds()));
  }
}

std::vector<double> worst_strain(const Context& c) {
  if (c.worst == no_site) return std::vector<double>(c.time.size(), 0.0);
  const auto probed = c.strain.read<std::uint32_t>("/probe/site");
  const auto probe = std::find(probed.begin(), probed.end(), c.worst);
  if (probe == probed.end()) return strain_between_reversals(c.sites.reversals_of(c.worst), c.time.size());
  std::vector<double> strain;
  c.strain.read_rows("/probe/strain", probe - probed.begin(), 1, strain);
  return strain;
}

void write_program(const Context& c, const std::vector<DamagingCycle>& cycles) {
  put(c.life, "/time", c.time);
  put(c.life, "/program/step", c.step);
  put(c.life, "/program/text", c.step_text);
  const auto by_step = [&](Moment moment) {
    return damage_by_step(damage_over_time(cycles, c.time.size(), moment), c.step, c.step_text.size());
  };
  put(c.life, "/program/damage", by_step(Moment::closes));
  put(c.life, "/program/damage_opened", by_step(Moment::opens));
}

/// The worst site's life, place and moment. Returns the summary for the terminal.
std::string write_worst(const Context& c, const std::vector<DamagingCycle>& cycles) {
  const bool any = c.worst != no_site;
  const double damage = any ? c.damage.damage[c.worst] : 0, repeats = life_in_repeats(damage);
  const double life_hours = hours(repeats, c.repeat_seconds());
  const double life_months = months(life_hours, c.job.fatigue.operating_hours_per_week);
  const std::size_t segment = any ? c.sites.segment(c.worst) : 0;
  const std::size_t from_tool = any ? c.segment_length.size() - segment : 0;
  const double position = any ? position_from_tool(c.segment_length, segment) : 0;
  c.life.attribute("life_repeats", repeats);
  c.life.attribute("life_hours", life_hours);
  c.life.attribute("life_months", life_months);
  c.life.attribute("damage_per_repeat", damage);
  c.life.attribute("repeat_seconds", c.repeat_seconds());
  c.life.attribute("worst_site", any ? double(c.worst) : -1);
  c.life.attribute("worst_segment_from_tool", double(from_tool));
  c.life.attribute("worst_position_from_tool", position);
  const auto most = std::max_element(cycles.begin(), cycles.end(),
                                     [](const auto& a, const auto& b) { return a.damage < b.damage; });
  const std::size_t sample = most == cycles.end() ? 0 : most->cycle.end.sample;
  c.life.attribute("worst_time", c.time.empty() ? 0 : c.time[sample]);
  const std::string* const step = any ? c.step_at(sample) : nullptr;
  c.life.attribute("worst_component", any ? c.component[c.worst] : "");
  c.life.attribute("worst_step", step ? *step : "");
  if (!any) return "no wire was evaluated";
  if (damage == 0) return "no wire is damaged";
  return fmt::format("{} h ({} repeats, {} months) until {} breaks, {:.2f} m from the tool{}",
                     pipeline::readable(life_hours), pipeline::readable(repeats),
                     pipeline::readable(life_months), c.component[c.worst], position,
                     step ? ", worst during '" + *step + "'" : "");
}

/// Whether the job itself lets every level slip this way: then its own sites, which are all wires and not only the
/// likely worst ones, are the bound.
bool is_own_slip(const pipeline::Job& job, pipeline::Slip slip) {
  return std::all_of(job.strain.slip.begin(), job.strain.slip.end(), [&](pipeline::Slip own) { return own == slip; });
}

void write_bound(const Context& c, const std::string& name, pipeline::Slip slip, const std::function<void(double)>& progress) {
  const SiteSet sites(c.strain, "/bound_" + name);
  if (sites.size() == 0 && c.sites.size() > 0) {
    throw pipeline::InputError(c.strain.where(), fmt::format("/bound_{} holds no sites", name),
                               "make the file anew with dresslife-strain");
  }
  const SiteDamage damage =
      is_own_slip(c.job, slip) ? c.damage : damage_of(sites, counters_for(sites, c.job), c.threads, progress);
  const double repeats = life_in_repeats(sites.size() == 0 ? 0 : damage.damage[damage.worst()]);
  c.life.attribute("life_repeats_all_" + name, repeats);
  c.life.attribute("life_hours_all_" + name, hours(repeats, c.repeat_seconds()));
}

std::vector<std::string> warnings_of(const Context& c, const std::vector<DamagingCycle>& worst_cycles) {
  std::set<std::string> warnings;  // sorted and once each
  for (const std::string& name : c.sites.material().values) {
    const pipeline::Material& material = pipeline::material_of(c.job, name);
    if (c.job.fatigue.stress != pipeline::Stress::cyclic || !material.strain_life_table.empty()) continue;
    const std::string warning = compatibility_warning(material);
    if (!warning.empty()) warnings.insert("warning: " + warning);
  }
  const auto torn = std::count_if(worst_cycles.begin(), worst_cycles.end(), [](const DamagingCycle& d) {
    return d.damage >= d.cycle.count * 2 / fewest_reversals;
  });
  if (torn > 0) {
    warnings.insert(
        fmt::format("warning: {} of the worst wire's cycles tear it on their first reversal (strain up to "
                    "{:.3g}); check slip, lay angles and bend radii, no wire is meant for this",
                    torn, *std::max_element(c.damage.range.begin(), c.damage.range.end())));
  }
  return {warnings.begin(), warnings.end()};
}

}  // namespace

Notes write_life(const FileReader& strain, const pipeline::Job& job, FileWriter& life, std::size_t threads,
                 const std::function<void(double)>& progress) {
  Context c(strain, job, life, threads);
  check_steps(c);
  // The three sets are about equally large.
  c.damage = damage_of(c.sites, c.counters, threads, [&](double share) { progress(share / 3); });
  c.worst = c.damage.worst();
  write_bound(c, "stick", pipeline::Slip::stick, [&](double share) { progress((1 + share) / 3); });
  write_bound(c, "free", pipeline::Slip::free, [&](double share) { progress((2 + share) / 3); });
  const auto cycles = c.worst == no_site ? std::vector<DamagingCycle>{} : c.cycles_of(c.worst);
  write_sites(c);
  write_listed_cycles(c);
  write_segments(c);
  write_layers(c);
  write_scatter(c);
  write_program(c, cycles);
  put(life, "/worst/strain", worst_strain(c));
  const std::string summary = write_worst(c, cycles);
  return {warnings_of(c, cycles), summary};
}

}  // namespace dresslife::fatigue
