#include "pipeline/report/known_history.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/readable.h"

namespace dresslife::pipeline {
namespace {

template <typename T>
T one(const FileReader& file, const char* dataset, std::size_t row) {
  std::vector<T> values;
  file.read_rows(dataset, row, 1, values);
  return values.front();
}

}  // namespace

bool known_whole(const FileReader& strain, std::uint32_t site) {
  for (const char* whole : {"/probe/site", "/plane/site"}) {
    if (!strain.has(whole)) continue;
    const auto sites = strain.read<std::uint32_t>(whole);
    if (std::ranges::find(sites, site) != sites.end()) return true;
  }
  return false;
}

std::string KnownHistory::words() const {
  if (!whole) return component + ", straight between its turning points";
  return share < 1 ? fmt::format("{} ({} % of the worst wire's damage)", component, readable(100 * share, 3))
                   : component;
}

KnownHistory known_history(const FileReader& life, const FileReader* strain) {
  KnownHistory worst{life.text_attribute("worst_component"), 1, false, life.read<double>("/worst/strain")};
  const double site = life.number_attribute("worst_site");
  if (site < 0 || !strain || strain->rows("/time") != worst.strain.size()) return worst;
  worst.whole = known_whole(*strain, static_cast<std::uint32_t>(site));
  if (worst.whole) return worst;
  const auto segment = one<std::int32_t>(life, "/site/segment", static_cast<std::size_t>(site));
  const auto probes = strain->read<std::uint32_t>("/probe/site");
  KnownHistory best;
  for (std::size_t k = 0; k < probes.size(); ++k) {
    if (one<std::int32_t>(life, "/site/segment", probes[k]) != segment) continue;
    const double share = one<double>(life, "/damage", probes[k]) / life.number_attribute("damage_per_repeat");
    if (best.whole && share <= best.share) continue;
    best = {one<std::string>(life, "/site/component", probes[k]), share, true, {}};
    strain->read_rows("/probe/strain", k, 1, best.strain);
  }
  return best.whole ? best : worst;
}

}  // namespace dresslife::pipeline
