#include "fatigue/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/base/order.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {
namespace {

using pipeline::LifeResponse;

constexpr std::size_t likely_wires =
    24;  // at each point, selected by the job's material and evaluated for all its constants
constexpr std::size_t settled_wires = 2;  // of them, with exact relaxation of mean stress
const std::vector<double> strength_nodes{-2, -1, 0, 1, 2}, slope_nodes{-1.5, 0, 1.5};

const double longest = 2 * std::pow(10, LifeResponse::undamaged);  // reversals of one cycle

/// Counters of the points of a response: those of a glued cable have (F38).
struct PointCounters {
  PointCounters(const SiteSet& sites, const TextColumn& component, const pipeline::Job& job)
      : own(sites, component, job, longest), glued(sites, component, job, longest, Compression::without_effect) {}
  const SiteCounters& at(const VariedStrains& point) const {
    return point.inside == pipeline::Inside::glued ? glued : own;
  }
  SiteCounters own, glued;
};

double log10_of_life(double damage) {
  return damage > 0 ? std::min(-std::log10(damage), LifeResponse::undamaged) : LifeResponse::undamaged;
}

/// Returns the damage of each wire with the rough share of the loop (F24).
std::vector<double> damage_of(const VariedStrains& at, const std::vector<std::size_t>& wires,
                              const SiteCounters& counters, DamageCounter::Workspace& workspace) {
  std::vector<double> damage(wires.size());
  std::vector<StrainList> lists;
  for (std::size_t first = 0; first < wires.size(); first += lists.size()) {
    const DamageCounter& counter = counters.of(at.site[wires[first]]);
    lists.clear();
    for (std::size_t k = first; k < wires.size() && &counters.of(at.site[wires[k]]) == &counter; ++k)
      lists.push_back({at.strains[wires[k]].data(), at.strains[wires[k]].size()});
    counter(lists, std::span(damage).subspan(first, lists.size()), workspace);
  }
  return damage;
}

/// Returns the `count` wires with the largest damage.
std::vector<std::size_t> worst_of(const std::vector<std::size_t>& wires, const std::vector<double>& damage,
                                  std::size_t count) {
  std::vector<std::size_t> worst;
  const std::vector<std::size_t> order = pipeline::largest_first(damage);
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) worst.push_back(wires[order[k]]);
  std::ranges::sort(worst);
  return worst;
}

/// Returns log10 of the shortest life, with exact relaxation of mean stress (F23) for the likely worst wires.
double worst_life(const VariedStrains& at, const std::vector<std::size_t>& wires, const SiteCounters& counters,
                  DamageCounter::Workspace& workspace) {
  const std::vector<double> rough = damage_of(at, wires, counters, workspace);
  double worst = 0;
  for (const std::size_t wire : worst_of(wires, rough, settled_wires))
    worst = std::max(worst, counters.of(at.site[wire]).settled_damage(at.strains[wire], workspace));
  // Relaxation is followed for 2^50 repeats. For longer lives the rough share is used.
  if (worst == 0 && !rough.empty()) worst = *std::ranges::max_element(rough);
  return log10_of_life(worst);
}

/// Returns the number of the job's own strength and slope among those of a point.
std::size_t own_node(const LifeResponse& response) {
  const auto zero_of = [](const std::vector<double>& z) {
    return static_cast<std::size_t>(std::ranges::find(z, 0.0) - z.begin());
  };
  return zero_of(response.strength) * response.slope.size() + zero_of(response.slope);
}

constexpr std::size_t of_rest = index_of(pipeline::Uncertain::rest), of_slack = index_of(pipeline::Uncertain::slack);

/// Returns whether a variation differs from the job only by the rest.
bool is_rest(const VariedStrains& at) {
  return at.rest > 0 && at.inside == pipeline::Inside::as_is &&
         std::ranges::all_of(at.z, [](double z) { return z == 0; });
}

}  // namespace

std::vector<VariedStrains> read_variation_points(const pipeline::FileReader& strain) {
  if (!strain.has("/variation/z")) return {};
  const auto z = strain.read<double>("/variation/z");
  constexpr std::size_t in_row = pipeline::index_of(pipeline::Uncertain::rest);  // rest has its own list
  std::vector<VariedStrains> all(z.size() / in_row);
  for (std::size_t v = 0; v < all.size(); ++v)
    std::copy_n(z.begin() + static_cast<std::ptrdiff_t>(v * in_row), in_row, all[v].z.begin());
  const auto inside = strain.read<std::int32_t>("/variation/inside"),
             rest = strain.read<std::int32_t>("/variation/rest");
  const auto rests = static_cast<std::int32_t>(read_rests(strain).size());
  const auto stiffness = strain.read<double>("/variation/stiffness");
  const auto refuse = [&](const std::string& what) {
    throw pipeline::InputError(strain.where(), what, "make the file again with dresslife-strain");
  };
  for (std::size_t v = 0; v < all.size(); ++v) {
    if (inside[v] < 0 || inside[v] >= std::int32_t(pipeline::inside_count))
      refuse(fmt::format("/variation/inside is {} (must be 0, 1 or 2)", inside[v]));
    if (rest[v] < 0 || rest[v] >= std::max(1, rests))
      refuse(fmt::format("/variation/rest is {}, which no start came to", rest[v]));
    all[v].inside = static_cast<pipeline::Inside>(inside[v]);
    all[v].rest = static_cast<std::size_t>(rest[v]);
    all[v].z[index_of(pipeline::Uncertain::hose_stiffness)] = stiffness[v];
  }
  return all;
}

std::vector<VariedStrains> read_variations(const pipeline::FileReader& strain, std::size_t sites) {
  std::vector<VariedStrains> all = read_variation_points(strain);
  if (all.empty()) return all;
  const auto of_row = strain.read<std::uint32_t>("/variation/row/variation");
  const auto site = strain.read<std::uint32_t>("/variation/row/site");
  const auto turning = strain.read<std::uint32_t>("/variation/row/turning");
  const auto strains = strain.read<float>("/variation/strain");
  std::size_t next = 0;
  for (std::size_t row = 0; row < of_row.size(); ++row) {
    if (of_row[row] >= all.size() || site[row] >= sites || turning[row] > strains.size() - next)
      throw pipeline::InputError(strain.where(), "/variation/row names what the file does not hold",
                                 "make the file again with dresslife-strain");
    VariedStrains& at = all[of_row[row]];
    at.site.push_back(site[row]);
    at.strains.emplace_back(strains.begin() + static_cast<std::ptrdiff_t>(next),
                            strains.begin() + static_cast<std::ptrdiff_t>(next + turning[row]));
    next += turning[row];
  }
  return all;
}

std::vector<std::size_t> read_rests(const pipeline::FileReader& strain) {
  std::vector<std::size_t> starts;
  if (!strain.has("/start/rest")) return starts;
  for (const std::int32_t rest : strain.read<std::int32_t>("/start/rest")) {
    if (rest < 0 || static_cast<std::size_t>(rest) >= strain.rows("/start/rest"))
      throw pipeline::InputError(
          strain.where(), fmt::format("/start/rest is {} (there are {} starts)", rest, strain.rows("/start/rest")),
          "make the file again with dresslife-strain");
    starts.resize(std::max(starts.size(), static_cast<std::size_t>(rest) + 1));
    ++starts[static_cast<std::size_t>(rest)];
  }
  return starts;
}

std::vector<VariedStrains> only(const std::vector<VariedStrains>& varied, const std::vector<bool>& counts) {
  std::vector<VariedStrains> some;
  for (const VariedStrains& all : varied) {
    VariedStrains& kept = some.emplace_back();
    kept.z = all.z, kept.inside = all.inside, kept.rest = all.rest;
    for (std::size_t k = 0; k < all.site.size(); ++k)
      if (counts[all.site[k]]) kept.site.push_back(all.site[k]), kept.strains.push_back(all.strains[k]);
  }
  return some;
}

void put_rests(pipeline::LifeResponse& response, std::span<const VariedStrains> varied,
               const std::vector<std::size_t>& starts) {
  const std::size_t nodes = response.strength.size() * response.slope.size(), middle = own_node(response);
  std::vector<std::size_t> point(starts.size(), 0), order;  // (rest)
  for (std::size_t v = 0; v < varied.size(); ++v)
    if (is_rest(varied[v])) point[varied[v].rest] = v + 1;
  const auto life = [&](std::size_t at, std::size_t node) -> double& { return response.worst_life[at * nodes + node]; };
  for (std::size_t rest = 0; rest < starts.size(); ++rest)
    if (rest == 0 || point[rest] > 0) order.push_back(rest);
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return life(point[a], middle) < life(point[b], middle); });
  double all = 0, before = 0;
  for (const std::size_t rest : order) all += static_cast<double>(starts[rest]);
  std::vector<double> score(starts.size());
  for (const std::size_t rest : order) {
    const auto count = static_cast<double>(starts[rest]);
    score[rest] = pipeline::normal_quantile((before + count / 2) / all);
    before += count;
  }
  for (const std::size_t rest : order) response.points[point[rest]][of_rest] = score[rest] - score[0];
  response.knowledge.mean(static_cast<Eigen::Index>(of_rest)) -= score[0];
  for (std::size_t v = 0; v < varied.size(); ++v) {
    if (varied[v].rest == 0 || varied[v].z[of_slack] != 0 || is_rest(varied[v])) continue;
    for (std::size_t node = 0; node < nodes; ++node) {
      double& of = life(v + 1, node);
      const double there = life(point[varied[v].rest], node), here = life(0, node);
      of = std::min(LifeResponse::undamaged, pipeline::together(there, std::array{of, here}));
    }
  }
}

void fill_response(pipeline::LifeResponse& response, const VariedStrains& own, std::span<const VariedStrains> varied,
                   const SiteSet& sites, const TextColumn& component, const pipeline::Job& job, std::size_t threads) {
  response.strength = strength_nodes, response.slope = slope_nodes;
  std::vector<const VariedStrains*> points{&own};
  response.points = {{}}, response.inside = {pipeline::Inside::as_is};
  for (const VariedStrains& at : varied) {
    points.push_back(&at);
    response.points.push_back(at.z), response.inside.push_back(at.inside);
  }
  const std::size_t slopes = slope_nodes.size(), nodes = strength_nodes.size() * slopes;
  response.worst_life.assign(points.size() * nodes, LifeResponse::undamaged);
  std::vector<std::vector<std::size_t>> likely;  // (point)
  {
    const PointCounters counters(sites, component, job);
    DamageCounter::Workspace workspace;
    for (const VariedStrains* at : points) {
      const std::vector<std::size_t> all = pipeline::indices_of(at->strains.size());
      likely.push_back(worst_of(all, damage_of(*at, all, counters.at(*at), workspace), likely_wires));
    }
  }
  const auto& parameters = pipeline::uncertain_parameters();
  pipeline::in_parallel(threads, [&](std::size_t part) {
    DamageCounter::Workspace workspace;
    for (std::size_t node = part; node < nodes; node += threads) {
      pipeline::Job moved = job;
      moved.fatigue.strength_factor *=
          parameters[index_of(pipeline::Uncertain::strength)].value(strength_nodes[node / slopes]);
      moved.fatigue.slope_change += parameters[index_of(pipeline::Uncertain::slope)].value(slope_nodes[node % slopes]);
      const PointCounters counters(sites, component, moved);
      for (std::size_t k = 0; k < points.size(); ++k)
        response.worst_life[k * nodes + node] = worst_life(*points[k], likely[k], counters.at(*points[k]), workspace);
    }
  });
}

double put_planes(pipeline::LifeResponse& response) {
  const std::size_t nodes = response.strength.size() * response.slope.size(), last = response.points.size() - 1;
  std::vector<double>& lives = response.worst_life;
  double own = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    const double by_plane = lives[node], equivalent = lives[last * nodes + node];
    if (std::max(by_plane, equivalent) >= LifeResponse::undamaged) continue;
    if (node == own_node(response)) own = by_plane - equivalent;
    for (std::size_t point = 1; point < last; ++point) {
      double& life = lives[point * nodes + node];
      life = std::min(LifeResponse::undamaged, life + by_plane - equivalent);
    }
  }
  response.points.pop_back(), response.inside.pop_back();
  lives.resize(last * nodes);
  return own;
}

std::vector<double> read_taut_stiffnesses(const pipeline::FileReader& strain) {
  std::vector<double> stiffnesses;
  for (const char* name : {"softer_taut_z", "stiffer_taut_z"})
    if (strain.has_attribute(name)) stiffnesses.push_back(strain.number_attribute(name));
  return stiffnesses;
}

void put_taut(pipeline::LifeResponse& response, const std::vector<double>& stiffnesses) {
  constexpr double one_repeat = 0;  // log10
  const std::size_t nodes = response.strength.size() * response.slope.size();
  for (const double z : stiffnesses) {
    std::vector<double> places{z};
    if (std::abs(z) < LifeResponse::farthest) places.push_back(std::copysign(LifeResponse::farthest, z));
    for (const double place : places)
      for (const pipeline::Inside inside : {pipeline::Inside::as_is, pipeline::Inside::glued, pipeline::Inside::free}) {
        response.points.push_back({});
        response.points.back()[index_of(pipeline::Uncertain::hose_stiffness)] = place;
        response.inside.push_back(inside);
        response.worst_life.insert(response.worst_life.end(), nodes, one_repeat);
      }
  }
  // Without a node on the other side, the fall to one repeat would be extrapolated to it as a rise.
  for (const double z : stiffnesses) {
    constexpr std::size_t stiffness = index_of(pipeline::Uncertain::hose_stiffness);
    if (std::ranges::any_of(response.points, [&](const auto& point) { return point[stiffness] * z < 0; })) continue;
    response.points.push_back({});
    response.points.back()[stiffness] = std::copysign(LifeResponse::farthest, -z);
    response.inside.push_back(pipeline::Inside::as_is);
    const std::vector<double> own(response.worst_life.begin(),
                                  response.worst_life.begin() + static_cast<std::ptrdiff_t>(nodes));
    response.worst_life.insert(response.worst_life.end(), own.begin(), own.end());
  }
}

}  // namespace dresslife::fatigue
