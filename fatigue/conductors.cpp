#include "fatigue/conductors.h"

#include <algorithm>
#include <unordered_map>

namespace dresslife::fatigue {
namespace {

std::string parent_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// Returns the worst site of each wire: (component); no_site for places of the hose's wall.
std::vector<std::size_t> worst_site_of_wires(const SiteDamage& all, const TextColumn& component) {
  return worst_by_group(all, component.values.size(), [&](std::size_t site) {
    return all.is_wire(site) ? static_cast<std::size_t>(component.index[site]) : no_site;
  });
}

}  // namespace

std::string conductor_of(const std::string& wire, const std::vector<std::string>& layer_names) {
  const std::string parent = parent_of(wire);
  const std::string last = parent.substr(parent.rfind('/') + 1);  // npos + 1 is 0
  const bool layer = std::ranges::find(layer_names, last) != layer_names.end();
  return layer ? parent_of(parent) : parent;
}

Conductors conductors_of(const SiteDamage& all, const TextColumn& component,
                         const std::vector<std::string>& layer_names) {
  Conductors result;
  std::unordered_map<std::string, std::size_t> known;
  const std::vector<std::size_t> worst = worst_site_of_wires(all, component);
  result.of_component.assign(worst.size(), no_site);
  result.wire_of_component.assign(worst.size(), 0);
  for (std::size_t wire = 0; wire < worst.size(); ++wire) {
    if (worst[wire] == no_site) continue;  // the hose's wall
    const std::string path = conductor_of(component.values[wire], layer_names);
    const auto [entry, fresh] = known.emplace(path, result.path.size());
    if (fresh) {
      result.path.push_back(path);
      result.bundle.emplace_back();
      result.worst.push_back(worst[wire]);
    }
    result.of_component[wire] = entry->second;
    result.wire_of_component[wire] = result.bundle[entry->second].damage.size();
    result.bundle[entry->second].damage.push_back(all.damage[worst[wire]]);
    std::size_t& leader = result.worst[entry->second];
    if (all.worse(worst[wire], leader)) leader = worst[wire];
  }
  return result;
}

std::vector<PlacesOfConductor> places_of(const SiteDamage& all, const TextColumn& component,
                                         const Conductors& conductors, std::size_t segments,
                                         const std::function<std::size_t(std::size_t)>& segment_of) {
  std::vector<PlacesOfConductor> places;
  for (const ConductorWires& bundle : conductors.bundle)
    places.push_back({std::vector<double>(bundle.damage.size() * segments, 0.0)});
  for (std::size_t site = 0; site < all.damage.size(); ++site) {
    const auto wire = static_cast<std::size_t>(component.index[site]);
    const std::size_t conductor = conductors.of_component[wire];
    if (conductor == no_site || !all.is_wire(site)) continue;
    const std::size_t wires = conductors.bundle[conductor].damage.size();
    double& damage = places[conductor].damage[segment_of(site) * wires + conductors.wire_of_component[wire]];
    damage = std::max(damage, all.damage[site]);
  }
  return places;
}

std::vector<double> sharing_rates(std::size_t wires, const std::function<double(double)>& scaled_damage) {
  std::vector<double> rates(wires, 1.0);
  const double alone = scaled_damage(1);
  if (!(alone > 0)) return rates;
  for (std::size_t broken = 1; broken < wires; ++broken)
    rates[broken] = scaled_damage(double(wires) / double(wires - broken)) / alone;
  return rates;
}

LifeScatter life_scatter(const Conductors& conductors, const std::vector<PlacesOfConductor>& places,
                         std::size_t segments, const pipeline::Fatigue& settings) {
  LifeScatter result;
  const Scatter scatter{settings.scatter_log10 * settings.scatter_factor, settings.scatter_shared};
  std::vector<std::vector<double>> wires;  // (dresspack)
  for (const ConductorWires& bundle : conductors.bundle) {
    if (bundle.dresspack >= wires.size()) wires.resize(bundle.dresspack + 1);
    std::vector<double>& its = wires[bundle.dresspack];
    its.insert(its.end(), bundle.damage.begin(), bundle.damage.end());
  }
  result.first_wire = first_wire_lives(wires, scatter);
  result.first_place =
      first_place_lives(places, conductors.bundle, segments, settings.failed_wires_percent, scatter, sharing_draws);
  result.place = median_place_lives(places, conductors.bundle, segments, settings.failed_wires_percent);
  if (settings.load_sharing) {
    SharedLives shared = shared_lives(conductors.bundle, settings.failed_wires_percent, scatter, sharing_draws);
    result.conductor = std::move(shared.conductor);
    result.first_conductor = shared.first_conductor;
    return result;
  }
  for (const ConductorWires& bundle : conductors.bundle)
    result.conductor.push_back(conductor_lives(bundle, settings.failed_wires_percent, scatter));
  result.first_conductor = first_conductor_lives(conductors.bundle, settings.failed_wires_percent, scatter);
  return result;
}

}  // namespace dresslife::fatigue
