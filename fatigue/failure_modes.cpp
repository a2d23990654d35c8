#include "fatigue/failure_modes.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {
namespace {

using pipeline::LifeResponse;

constexpr std::size_t likely_anywhere =
    32;  // number of worst wires of a mode, in addition to the worst wire of each segment

/// Returns "signal cable" for "signal cable 3/conductor 2/layer 1/wire 17"; empty: the wire lies directly in the dresspack.
std::string cable_of(const std::string& wire, const std::vector<std::string>& layer_names) {
  if (conductor_of(wire, layer_names).empty()) return "";
  const std::string kinds = layer_of(wire, layer_names);
  return kinds.substr(0, kinds.find('/'));
}

/// Returns the name of the mode of the wire at this place of a job.
std::string name_of_mode(const pipeline::Job& job, const PathInJob& place,
                         const std::vector<std::vector<std::string>>& layers) {
  const std::string dresspack = pipeline::name_among(job, place.dresspack);
  const std::string cable = cable_of(place.inside, layers[place.dresspack]);
  const std::string in = dresspack + (dresspack.empty() || cable.empty() ? "" : "/") + cable;
  return in.empty() ? "wires" : "wires of " + in;
}

double log10_life(double repeats) {
  return std::isfinite(repeats) ? std::min(std::log10(repeats), LifeResponse::undamaged) : LifeResponse::undamaged;
}

std::array<double, percentiles.size()> logs_of(const Percentiles& lives) {
  std::array<double, percentiles.size()> logs;
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] = log10_life(lives[i]);
  return logs;
}

class Modes {
 public:
  Modes(const ModeList& list, const ModeInputs& in) : list_(list), in_(in), of_component_(list.of(in.component)) {}

  LifeResponse response(std::size_t mode) const {
    LifeResponse response;
    response.mode = list_.name(mode);
    response.dresspack = pipeline::name_among(in_.job, list_.dresspack(mode));
    response.construction = in_.job.dresspacks[list_.dresspack(mode)].dresspack.name;
    response.scatter_shared = neighbours(mode) > 1 ? in_.job.fatigue.scatter_shared : 1;
    response.knowledge = knowledge_of_job(in_.job);
    if (in_.job.calibration) response.residual_spread = in_.job.calibration->residual_spread;
    const VariedStrains own = likely_worst(mode);
    if (!own.site.empty())
      response.material = pipeline::material_of(in_.job, in_.sites.material()[worst_of(mode)]).name;
    std::vector<bool> counts(in_.sites.size());
    for (std::size_t site = 0; site < counts.size(); ++site) counts[site] = mode_of(site) == mode;
    std::vector<VariedStrains> varied = only(in_.varied, counts);
    const std::size_t variations = varied.size();
    if (in_.equivalent_of) {
      VariedStrains& equivalent = varied.emplace_back();
      equivalent.site = own.site;
      for (const std::size_t site : own.site) equivalent.strains.push_back(in_.equivalent_of(site));
    }
    fill_response(response, own, varied, in_.sites, in_.component, in_.job, in_.threads);
    const double by_planes = in_.equivalent_of ? put_planes(response) : 0;
    if (in_.starts.size() > 1) put_rests(response, std::span(varied).first(variations), in_.starts);
    put_taut(response, in_.taut);
    set_bound(response, pipeline::Inside::glued, in_.glued[mode], by_planes);
    set_bound(response, pipeline::Inside::free, in_.free[mode], by_planes);
    add_planned(mode, response);
    return response;
  }

 private:
  std::size_t mode_of(std::size_t site) const {
    return in_.damage.is_wire(site) ? of_component_[in_.component.index[site]] : no_site;
  }
  /// Returns the number of modes of the same dresspack, including this one.
  std::size_t neighbours(std::size_t mode) const {
    std::size_t count = 0;
    for (std::size_t other = 0; other < list_.size(); ++other) count += list_.dresspack(other) == list_.dresspack(mode);
    return count;
  }

  std::size_t worst_of(std::size_t mode) const {
    return worst_by_group(in_.damage, 1, [&](std::size_t site) { return mode_of(site) == mode ? 0 : no_site; }).front();
  }

  /// Returns the job's own wires of which one can be the worst with other parameters.
  VariedStrains likely_worst(std::size_t mode) const {
    std::vector<std::size_t> sites = worst_by_group(in_.damage, in_.segments, [&](std::size_t site) {
      return mode_of(site) == mode ? static_cast<std::size_t>(in_.sites.segment(site)) : no_site;
    });
    std::vector<std::size_t> damaged;
    for (std::size_t site = 0; site < in_.damage.damage.size(); ++site)
      if (mode_of(site) == mode && in_.damage.damage[site] > 0) damaged.push_back(site);
    const std::size_t kept = std::min(likely_anywhere, damaged.size());
    std::partial_sort(damaged.begin(), damaged.begin() + static_cast<std::ptrdiff_t>(kept), damaged.end(),
                      [&](std::size_t a, std::size_t b) { return in_.damage.worse(a, b); });
    sites.insert(sites.end(), damaged.begin(), damaged.begin() + static_cast<std::ptrdiff_t>(kept));
    std::ranges::sort(sites);
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    if (!sites.empty() && sites.back() == no_site) sites.pop_back();
    VariedStrains own;
    for (const std::size_t site : sites) own.site.push_back(site), own.strains.push_back(in_.strains_of(site));
    return own;
  }

  /// Adds the lives over the scatter of the mode's wires, also with other values of the scatter.
  void add_planned(std::size_t mode, LifeResponse& response) const {
    std::vector<PlacesOfConductor> places;
    std::vector<ConductorWires> bundles;
    for (std::size_t k = 0; k < in_.conductors.path.size(); ++k) {
      if (mode_of(in_.conductors.worst[k]) != mode) continue;
      places.push_back(in_.places[k]);
      bundles.push_back(in_.conductors.bundle[k]);
    }
    const pipeline::Fatigue& settings = in_.job.fatigue;
    const auto with = [&](double z) {
      const double factor = pipeline::uncertain_parameters()[index_of(pipeline::Uncertain::scatter)].value(z);
      const Scatter scatter{settings.scatter_log10 * settings.scatter_factor * factor, settings.scatter_shared};
      return logs_of(
          first_place_lives(places, bundles, in_.segments, settings.failed_wires_percent, scatter, sharing_draws)
              .lives);
    };
    const auto here = list_.size() == 1 ? logs_of(in_.planned) : with(0);
    response.planned = {here};
    if (in_.job.uncertainty.enabled && !settings.load_sharing && here[0] < LifeResponse::undamaged) {
      constexpr double reach = 1.5;
      response.scatter = {-reach, 0, reach};
      response.planned = {with(-reach), here, with(reach)};
    }
    const double excess = here[1] - (first_wire_life(response) + most_after_first_wire);
    for (auto& lives : response.planned)
      for (double& life : lives) life -= std::max(0.0, excess);
  }

  /// Returns log10 of the worst wire's median life at a point of the strain parameters; at 0: W(0).
  static double first_wire_life(const LifeResponse& response, std::size_t point = 0) {
    const auto zero = [](const std::vector<double>& nodes) {
      return static_cast<std::size_t>(std::ranges::find(nodes, 0.0) - nodes.begin());
    };
    const std::size_t slopes = response.slope.size();
    return response.worst_life.at((point * response.strength.size() + zero(response.strength)) * slopes +
                                  zero(response.slope));
  }

  /// Sets a bound, which has only equivalent strains. Without damage it is W at this point, which includes damage at longer lives.
  /// by_planes: see put_planes() [decades].
  static void set_bound(LifeResponse& response, pipeline::Inside inside, double repeats, double by_planes) {
    double& bound = response.bound[static_cast<std::size_t>(inside)];
    bound = std::min(LifeResponse::undamaged, log10_life(repeats) + (std::isinf(repeats) ? 0 : by_planes));
    for (std::size_t point = 0; point < response.points.size() && std::isinf(repeats); ++point)
      if (response.inside[point] == inside &&
          std::ranges::all_of(response.points[point], [](double z) { return z == 0; }))
        bound = first_wire_life(response, point);
  }

  const ModeList& list_;
  const ModeInputs& in_;
  std::vector<std::size_t> of_component_;  ///< (component)
};

}  // namespace

ModeList::ModeList(const pipeline::Job& job, const TextColumn& component) : job_(job) {
  for (const pipeline::MountedDresspack& mounted : job.dresspacks) layers_.push_back(layer_names(mounted.dresspack));
  for (const std::string& path : component.values) {
    const PathInJob place = path_in_job(job, path);
    if (pipeline::is_hose_wall(job.dresspacks[place.dresspack].dresspack, place.inside) || of(path) != no_site)
      continue;
    name_.push_back(name_of_mode(job, place, layers_));
    dresspack_.push_back(place.dresspack);
  }
}

std::size_t ModeList::of(const std::string& wire) const {
  const PathInJob place = path_in_job(job_, wire);
  if (pipeline::is_hose_wall(job_.dresspacks[place.dresspack].dresspack, place.inside)) return no_site;
  const auto found = std::ranges::find(name_, name_of_mode(job_, place, layers_));
  return found == name_.end() ? no_site : static_cast<std::size_t>(found - name_.begin());
}

std::vector<std::size_t> ModeList::of(const TextColumn& component) const {
  return pipeline::mapped(component.values, [&](const std::string& path) { return of(path); });
}

pipeline::ParameterKnowledge knowledge_of_job(const pipeline::Job& job) {
  pipeline::ParameterKnowledge known = pipeline::knowledge_of(job);
  if (job.calibration)  // z counts from the job itself, whose keys contain the calibration's medians
    for (const pipeline::LearnedParameter& learned : job.calibration->parameters)
      for (std::size_t p = 0; p < pipeline::uncertain_count; ++p)
        if (pipeline::uncertain_parameters()[p].name == learned.name &&
            p != index_of(pipeline::Uncertain::rest))  // see fill_response()
          known.mean(static_cast<Eigen::Index>(p)) -= learned.median;
  if (!job.uncertainty.enabled) known.mean.setZero(), known.covariance.setZero();
  return known;
}

Percentiles near_first_wire(Percentiles lives, double first_wire) {
  if (!std::isfinite(first_wire)) return lives;
  const auto logs = logs_of(lives);
  const double excess = std::max(0.0, logs[1] - (std::log10(first_wire) + most_after_first_wire));
  if (excess > 0)
    for (std::size_t i = 0; i < lives.size(); ++i)
      lives[i] = std::max(std::pow(10, logs[i] - excess),
                          std::min(lives[i], first_wire / std::pow(10, most_after_first_wire)));
  return lives;
}

pipeline::FailureModes failure_modes(const ModeList& modes, const ModeInputs& inputs) {
  const Modes each(modes, inputs);
  pipeline::FailureModes responses;
  if (modes.size() == 0) {  // nothing can fail
    LifeResponse& none = responses.emplace_back();
    none.knowledge = pipeline::prior_of(inputs.job.uncertainty);
    none.planned.resize(1);
    none.planned[0].fill(LifeResponse::undamaged);
  }
  for (std::size_t mode = 0; mode < modes.size(); ++mode) responses.push_back(each.response(mode));
  return responses;
}

}  // namespace dresslife::fatigue
