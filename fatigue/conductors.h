// The conductors of a dresspack as bundles of wires, and how much longer than its first wire each of them lasts.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fatigue/places.h"
#include "fatigue/scatter.h"
#include "fatigue/strain_file.h"
#include "fatigue/verdict.h"
#include "pipeline/job/fatigue.h"

namespace dresslife::fatigue {

/// Returns the path of the part that contains this wire: "cable 3/conductor 2/layer 1/wire 17" lies in "cable 3/conductor
/// 2", "wire 5" in the dresspack, "". Layers are not parts.
std::string conductor_of(const std::string& wire, const std::vector<std::string>& layer_names);

struct Conductors {
  std::vector<std::string> path;       ///< (conductor) in order of appearance
  std::vector<ConductorWires> bundle;  ///< (conductor)
  std::vector<std::size_t> worst;      ///< (conductor) its site with the largest damage
  /// (component) the conductor that contains a wire, no_site for the hose's wall; and the wire's number in it.
  std::vector<std::size_t> of_component, wire_of_component;
};

/// Returns the conductors of all wires of a set of sites. component (site): names its wire. A wire's damage is that of its worst
/// site.
Conductors conductors_of(const SiteDamage& all, const TextColumn& component,
                         const std::vector<std::string>& layer_names);

/// Returns the damage of all wires in all segments, (conductor). segment_of(site) < segments.
std::vector<PlacesOfConductor> places_of(const SiteDamage& all, const TextColumn& component,
                                         const Conductors& conductors, std::size_t segments,
                                         const std::function<std::size_t(std::size_t)>& segment_of);

/// Returns the rates of load sharing (F16). With k of n wires broken the remaining ones strain n/(n-k) times as much. rate[k] is
/// the damage of the conductor's worst wire then, over its damage before. scaled_damage(factor): damage of this wire under its
/// scaled history. The rates are an upper bound: bending imposes its strain on every wire alone, only a pull is shared.
std::vector<double> sharing_rates(std::size_t wires, const std::function<double(double)>& scaled_damage);

/// Number of samples for load sharing. A percentile's share of the distribution is then known to 1.6 % or better.
inline constexpr int sharing_draws = 1000;

/// Percentiles of the life for one definition of failure.
struct LifeScatter {
  Percentiles first_wire, first_conductor;  ///< of the whole dresspack
  FirstPlace first_place;  ///< the planner's life: the first conductor that lost its share of wires at one place
  std::vector<FailureLives> conductor;  ///< (conductor)
  std::vector<double> place;            ///< (conductor) median_place_lives()
};
/// Returns lives in repeats. Precondition for load_sharing: bundles with rates.
LifeScatter life_scatter(const Conductors& conductors, const std::vector<PlacesOfConductor>& places,
                         std::size_t segments, const pipeline::Fatigue& settings);

}  // namespace dresslife::fatigue
