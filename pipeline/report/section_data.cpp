#include "pipeline/report/section_data.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "pipeline/base/order.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/report/json.h"
#include "pipeline/resolve/job_text.h"

namespace dresslife::pipeline {
namespace {

constexpr int steps = 15;                    // four bits: 15 steps and zero
constexpr double least_share = 1e-4;         // share of the largest damage
constexpr std::size_t most_bytes = 260'000;  // base64 adds a third
constexpr std::size_t listed_wires = 5;      // per segment
constexpr std::size_t no_wire = static_cast<std::size_t>(-1);

Json parts_json(const std::vector<Component>& components) {
  std::vector<Json> list;
  for (const Component& part : components)
    list.push_back({{"name", part.name},
                    {"layer", part.layer},
                    {"count", part.count},
                    {"radius", part.radius},
                    {"at", part.helix_radius},
                    {"phase", part.phase},
                    {"plain", part.plain.has_value()},
                    {"parts", parts_json(part.components)}});
  return list;
}

Json dresspack_json(const Setup& setup, std::size_t d) {
  const Dresspack& dresspack = setup.dresspacks[d].dresspack;
  const double outer = dresspack.diameter / 2;
  return {{"name", name_among(setup, d)},
          {"radius", outer},
          {"inner", inner_radius(dresspack).value_or(outer)},
          {"core", dresspack.core_diameter / 2},
          {"parts", parts_json(dresspack.components)}};
}

/// Map from sites to wires. The sites of a segment are consecutive, and all segments of one dresspack have the same sites.
struct Wires {
  std::vector<std::size_t> of_site;  ///< (site of a segment) index of the wire; no_wire: a site of the hose's wall
  std::size_t count = 0;
};

/// Returns the map from the sites of one segment; without wires if the sites do not belong to the dresspack.
Wires wires_of(const FileReader& life, const Setup& setup, std::size_t d, std::size_t first_site, std::size_t sites) {
  const std::string name = name_among(setup, d), before = name.empty() ? "" : name + "/";
  std::unordered_map<std::string, std::size_t> number;
  for (const std::string& path : wire_paths(setup.dresspacks[d].dresspack))
    number.emplace(before + path, number.size());
  std::vector<std::string> paths;
  life.read_rows("/site/component", first_site, sites, paths);
  Wires wires{std::vector<std::size_t>(sites, no_wire), number.size()};
  std::size_t known = 0;
  for (std::size_t k = 0; k < sites; ++k)
    if (const auto found = number.find(paths[k]); found != number.end()) {
      wires.of_site[k] = found->second;
      ++known;
    }
  return known < number.size() ? Wires{} : wires;  // every wire must have at least one fibre
}

/// Returns, (wire), the damage of its most damaged fibre.
std::vector<double> damage_of_wires(const Wires& wires, const double* damage) {
  std::vector<double> most(wires.count, 0.0);
  for (std::size_t k = 0; k < wires.of_site.size(); ++k)
    if (wires.of_site[k] != no_wire) most[wires.of_site[k]] = std::max(most[wires.of_site[k]], damage[k]);
  return most;
}

std::string levels_of(const std::vector<double>& damage, double most) {
  std::string bytes((damage.size() + 1) / 2, '\0');
  for (std::size_t k = 0; k < damage.size(); ++k) {
    const double share = damage[k] / most;
    if (!(share >= least_share)) continue;
    const int level = 1 + static_cast<int>(std::lround((steps - 1) * (1 - std::log(share) / std::log(least_share))));
    bytes[k / 2] = static_cast<char>(bytes[k / 2] | std::min(level, steps) << (k % 2 * 4));
  }
  return bytes;
}

/// Returns the worst wires and their damages.
Json worst_json(const std::vector<double>& damage) {
  std::vector<std::size_t> order = indices_of(damage.size());
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(listed_wires, order.size()));
  std::partial_sort(order.begin(), end, order.end(), [&](auto a, auto b) { return damage[a] > damage[b]; });
  std::vector<std::vector<double>> list;
  for (auto wire = order.begin(); wire != end && damage[*wire] > 0; ++wire)
    list.push_back({static_cast<double>(*wire), damage[*wire]});
  return list;
}

}  // namespace

std::optional<Json> section_data(const FileReader& life, const Setup& setup) {
  const auto segment = life.read<std::int32_t>("/site/segment");
  const auto damage = life.read<double>("/damage"), of_segment = life.read<double>("/segment/damage");
  const double most = life.number_attribute("damage_per_repeat");
  const std::vector<std::size_t> dresspack = dresspack_of_segments(life);
  if (!(most > 0) || dresspack.size() != of_segment.size() || !std::ranges::is_sorted(segment)) return {};
  std::vector<Wires> wires(setup.dresspacks.size());
  std::vector<Json> rows, dresspacks;
  std::size_t bytes = 0;
  for (const std::size_t at : largest_first(of_segment)) {
    const std::size_t d = dresspack[at];
    if (!(of_segment[at] > 0) || d >= wires.size()) break;
    const auto [first, end] = std::equal_range(segment.begin(), segment.end(), static_cast<std::int32_t>(at));
    const auto first_site = static_cast<std::size_t>(first - segment.begin()),
               sites = static_cast<std::size_t>(end - first);
    if (wires[d].count == 0) wires[d] = wires_of(life, setup, d, first_site, sites);
    if (wires[d].count == 0 || wires[d].of_site.size() != sites) return {};
    if ((bytes += wires[d].count / 2) > most_bytes) break;
    const std::vector<double> here = damage_of_wires(wires[d], &damage[first_site]);
    rows.push_back(
        {{"segment", at}, {"dresspack", d}, {"worst", worst_json(here)}, {"levels", base64(levels_of(here, most))}});
  }
  for (std::size_t d = 0; d < setup.dresspacks.size(); ++d) dresspacks.push_back(dresspack_json(setup, d));
  return Json{
      {"steps", steps}, {"low", least_share * most}, {"high", most}, {"dresspacks", dresspacks}, {"rows", rows}};
}

}  // namespace dresslife::pipeline
