#include "fatigue/verdict.h"

#include <algorithm>
#include <atomic>
#include <cassert>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {
namespace {

void add_layer_names(const std::vector<pipeline::Component>& components, std::vector<std::string>& names) {
  for (const pipeline::Component& c : components) {
    if (!c.layer.empty()) names.push_back(c.layer);
    add_layer_names(c.components, names);
  }
}

/// "wire 17" -> "wire"
std::string without_number(const std::string& part) {
  const std::size_t space = part.find_last_of(' ');
  const bool numbered = space != std::string::npos && space + 1 < part.size() &&
                        part.find_first_not_of("0123456789", space + 1) == std::string::npos;
  return numbered ? part.substr(0, space) : part;
}

float range_of(std::span<const float> strains) {
  constexpr std::size_t side_by_side = 8;  // extremes in wide registers
  float low[side_by_side], high[side_by_side];
  for (std::size_t j = 0; j < side_by_side; ++j) low[j] = high[j] = strains.empty() ? 0 : strains[0];
  const auto take = [&](std::size_t lane, float strain) {
    low[lane] = strain < low[lane] ? strain : low[lane];
    high[lane] = strain > high[lane] ? strain : high[lane];
  };
  std::size_t k = 0;
  for (; k + side_by_side <= strains.size(); k += side_by_side)
    for (std::size_t j = 0; j < side_by_side; ++j) take(j, strains[k + j]);
  for (; k < strains.size(); ++k) take(0, strains[k]);
  return *std::max_element(high, high + side_by_side) - *std::min_element(low, low + side_by_side);
}

}  // namespace

bool SiteDamage::worse(std::size_t a, std::size_t b) const {
  if (damage[a] != damage[b]) return damage[a] > damage[b];
  if (range[a] != range[b]) return range[a] > range[b];
  return a < b;
}

std::size_t SiteDamage::worst_wire() const {
  return worst_by_group(*this, 1, [&](std::size_t site) { return is_wire(site) ? 0 : no_site; }).front();
}

std::size_t SiteDamage::worst_wall() const {
  return worst_by_group(*this, 1, [&](std::size_t site) { return is_wire(site) ? no_site : 0; }).front();
}

SiteCounters::SiteCounters(const SiteSet& sites, const TextColumn& component, const pipeline::Job& job, double longest,
                           Compression compression)
    : component_(component.index), material_(sites.material().index) {
  sites.check_materials(job);
  std::vector<int> wall_of_dresspack;
  for (const pipeline::MountedDresspack& mounted : job.dresspacks) {
    const bool walled = !mounted.dresspack.hose_material.empty();
    wall_of_dresspack.push_back(walled ? static_cast<int>(wall_.size()) : -1);
    if (walled)
      wall_.emplace_back(pipeline::hose_material_of(job, mounted.dresspack), job.fatigue, pipeline::instruction_set(),
                         longest, compression);
  }
  for (const std::string& path : component.values) {
    const PathInJob place = path_in_job(job, path);
    const bool wall = pipeline::is_hose_wall(job.dresspacks[place.dresspack].dresspack, place.inside);
    wall_of_component_.push_back(wall ? wall_of_dresspack[place.dresspack] : -1);
  }
  for (const std::string& name : sites.material().values)
    by_material_.emplace_back(pipeline::material_of(job, name), job.fatigue, pipeline::instruction_set(), longest,
                              compression);
}

const DamageCounter& SiteCounters::of(std::size_t site) const {
  const int wall = wall_of_component_[component_[site]];
  return wall >= 0 ? wall_[wall] : by_material_[material_[site]];
}

bool SiteCounters::settle() const {
  return std::ranges::any_of(by_material_, [](const DamageCounter& counter) { return counter.settles(); });
}

namespace {

/// Computes the damage of the sites [begin, end), in one call for each sequence of sites with one material.
void add_damage_of(const SiteSet& sites, const SiteSet::Block& block, std::size_t begin, std::size_t end,
                   const SiteCounters& counters, DamageCounter::Workspace& workspace, SiteDamage& all) {
  std::vector<StrainList> lists;
  for (std::size_t first = begin; first < end; first += lists.size()) {
    const DamageCounter& counter = counters.of(first);
    lists.clear();
    for (std::size_t site = first; site < end && &counters.of(site) == &counter; ++site) {
      const std::span<const float> strains = block.strains_of(site);
      if (counter.must_alternate()) sites.check_alternating(site, strains);
      lists.push_back({strains.data(), strains.size()});
      all.range[site] = range_of(strains);
    }
    counter(lists, std::span(all.damage).subspan(first, lists.size()), workspace);
  }
}

}  // namespace

SiteDamage damage_of(const SiteSet& sites, const SiteCounters& counters, std::size_t threads,
                     const std::function<void(double)>& progress) {
  SiteDamage all;
  all.damage.resize(sites.size());
  all.range.resize(sites.size());
  for (std::size_t site = 0; site < sites.size(); ++site) all.wall.push_back(counters.is_wall(site));
  std::vector<DamageCounter::Workspace> workspaces(threads);
  sites.for_each_block([&](const SiteSet::Block& block, const std::function<void()>& read_ahead) {
    constexpr std::size_t pieces = 16;  // per thread, so that all threads end at about the same time
    const std::vector<std::size_t> cuts = block.cuts(pieces * threads);
    std::atomic<std::size_t> next = 0;
    pipeline::in_parallel(threads, [&](std::size_t part) {
      if (part == 0) read_ahead();
      for (std::size_t piece = next++; piece + 1 < cuts.size(); piece = next++)
        add_damage_of(sites, block, cuts[piece], cuts[piece + 1], counters, workspaces[part], all);
    });
    progress(double(block.end) / sites.size());
  });
  return all;
}

std::vector<std::size_t> worst_by_group(const SiteDamage& all, std::size_t groups,
                                        const std::function<std::size_t(std::size_t)>& group_of) {
  std::vector<std::size_t> worst(groups, no_site);
  for (std::size_t site = 0; site < all.damage.size(); ++site) {
    const std::size_t group = group_of(site);
    if (group == no_site) continue;
    std::size_t& leader = worst[group];
    if (leader == no_site || all.worse(site, leader)) leader = site;
  }
  return worst;
}

void settle(SiteDamage& all, const SiteCounters& counters, std::size_t groups,
            const std::function<std::size_t(std::size_t)>& group_of,
            const std::function<std::vector<float>(std::size_t)>& strains_of, std::size_t threads) {
  if (!counters.settle()) return;
  const std::vector<std::size_t> worst = worst_by_group(all, groups, group_of);
  std::vector<std::vector<float>> strains;  // read on one thread, because the file must not be shared
  for (const std::size_t site : worst) strains.push_back(site == no_site ? std::vector<float>() : strains_of(site));
  std::vector<double> settled(groups, 0.0);
  std::vector<DamageCounter::Workspace> workspaces(threads);
  pipeline::in_parallel(threads, [&](std::size_t part) {
    for (std::size_t group = part; group < groups; group += threads)
      if (worst[group] != no_site)
        settled[group] = counters.of(worst[group]).settled_damage(strains[group], workspaces[part]);
  });
  std::vector<double> factor(groups, 1.0);
  for (std::size_t group = 0; group < groups; ++group)
    if (worst[group] != no_site && all.damage[worst[group]] > 0)
      factor[group] = settled[group] / all.damage[worst[group]];
  for (std::size_t site = 0; site < all.damage.size(); ++site) {
    const std::size_t group = group_of(site);
    if (group == no_site) continue;
    all.damage[site] = site == worst[group] ? settled[group] : all.damage[site] * factor[group];
  }
}

std::vector<std::size_t> worst_wires(const SiteDamage& all, std::size_t count) {
  std::vector<std::size_t> sites;
  for (std::size_t site = 0; site < all.damage.size(); ++site) {
    if (all.damage[site] > 0 && all.is_wire(site)) sites.push_back(site);
  }
  const std::size_t kept = std::min(count, sites.size());
  std::partial_sort(sites.begin(), sites.begin() + kept, sites.end(),
                    [&](std::size_t a, std::size_t b) { return all.worse(a, b); });
  sites.resize(kept);
  return sites;
}

PathInJob path_in_job(const pipeline::Job& job, const std::string& component) {
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const std::string name = pipeline::name_among(job, d);
    if (name.empty()) return {d, component};
    if (component == name) return {d, ""};  // its wires form one conductor
    if (component.starts_with(name + "/")) return {d, component.substr(name.size() + 1)};
  }
  throw pipeline::InputError({}, fmt::format("component '{}' lies in none of the job's dresspacks", component),
                             "make the strain file again with dresslife-strain");
}

std::string path_in_words(const pipeline::Job& job, const std::string& component) {
  const PathInJob at = path_in_job(job, component);
  for (const pipeline::Component& part : job.dresspacks[at.dresspack].dresspack.components)
    if (const std::string only = part.name + " 1"; part.count == 1 && (at.inside + "/").starts_with(only + "/"))
      return component.substr(0, component.size() - at.inside.size()) + part.name + at.inside.substr(only.size());
  return component;
}

std::vector<std::string> layer_names(const pipeline::Dresspack& dresspack) {
  std::vector<std::string> names;
  add_layer_names(dresspack.components, names);
  return names;
}

std::string layer_of(const std::string& component, const std::vector<std::string>& layer_names) {
  const auto layer_of_part = [&](const std::string& part) {
    return std::ranges::find(layer_names, part) != layer_names.end() ? part : without_number(part);
  };
  return pipeline::joined(pipeline::mapped(pipeline::parts_between(component, "/"), layer_of_part), "/");
}

std::vector<double> strain_between_reversals(const std::vector<Reversal>& reversals, std::size_t samples) {
  assert(!reversals.empty());
  std::vector<double> strain(samples, reversals.back().strain);
  for (std::size_t i = 0; i + 1 < reversals.size(); ++i) {
    const Reversal &a = reversals[i], &b = reversals[i + 1];
    for (std::int64_t t = a.sample; t < b.sample; ++t) {
      strain[t] = a.strain + (b.strain - a.strain) * double(t - a.sample) / double(b.sample - a.sample);
    }
  }
  return strain;
}

}  // namespace dresslife::fatigue
