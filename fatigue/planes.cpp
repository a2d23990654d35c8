#include "fatigue/planes.h"

#include <algorithm>
#include <cassert>

#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {
namespace {

constexpr std::size_t rows_at_once = 64;  // number of histories in memory, each with strain and shear

std::vector<double> row_of_floats(const std::vector<float>& rows, std::size_t row, std::size_t samples) {
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(row * samples);
  return {first, first + static_cast<std::ptrdiff_t>(samples)};
}

}  // namespace

JudgedPlanes::JudgedPlanes(const pipeline::FileReader& file, const SiteSet& sites, const SiteCounters& counters,
                           const pipeline::Job& job, std::size_t threads)
    : file_(file), sites_(sites), job_(job) {
  if (!file.has("/plane/site")) return;
  for (const std::uint32_t site : file.read<std::uint32_t>("/plane/site")) site_.push_back(site);
  for (const std::size_t site : site_)
    if (site >= sites.size())
      throw pipeline::InputError(file.where(),
                                 fmt::format("/plane/site names site {} (there are {})", site, sites.size()),
                                 "make the file again with dresslife-strain");
  plane_.resize(site_.size());
  const std::size_t samples = file.length("sample");
  std::vector<float> strain, shear;
  std::vector<DamageCounter::Workspace> workspaces(threads);
  for (std::size_t first = 0; first < site_.size(); first += rows_at_once) {
    const std::size_t count = std::min(rows_at_once, site_.size() - first);
    file.read_rows("/plane/strain", first, count, strain);
    file.read_rows("/plane/shear", first, count, shear);
    pipeline::in_parallel(threads, [&](std::size_t part) {
      for (std::size_t row = part; row < count; row += threads) {
        const std::size_t site = site_[first + row];
        plane_[first + row] = critical_plane(row_of_floats(strain, row, samples), row_of_floats(shear, row, samples),
                                             poisson_ratio_of(site), counters.of(site), workspaces[part]);
      }
    });
  }
}

double JudgedPlanes::poisson_ratio_of(std::size_t site) const {
  return pipeline::material_of(job_, sites_.material()[site]).poisson_ratio;
}

std::size_t JudgedPlanes::row_of(std::size_t site) const { return std::ranges::find(site_, site) - site_.begin(); }

const CriticalPlane* JudgedPlanes::of(std::size_t site) const {
  const std::size_t row = row_of(site);
  return row < plane_.size() ? &plane_[row] : nullptr;
}

std::vector<double> JudgedPlanes::strain_of(std::size_t site) const {
  const std::size_t row = row_of(site);
  assert(row < plane_.size());
  std::vector<float> strain, shear;
  file_.read_rows("/plane/strain", row, 1, strain);
  file_.read_rows("/plane/shear", row, 1, shear);
  return plane_strain(std::vector<double>(strain.begin(), strain.end()),
                      std::vector<double>(shear.begin(), shear.end()), poisson_ratio_of(site), plane_[row].theta);
}

void JudgedPlanes::apply(SiteDamage& all, std::size_t groups,
                         const std::function<std::size_t(std::size_t)>& group_of) const {
  std::vector<std::size_t> leader(groups, no_site);  // (group) row of its worst evaluated wire
  for (std::size_t row = 0; row < site_.size(); ++row) {
    std::size_t& best = leader[group_of(site_[row])];
    if (best == no_site || plane_[row].damage > plane_[best].damage) best = row;
  }
  std::vector<double> judged(all.damage.size(), -1);
  for (std::size_t row = 0; row < site_.size(); ++row) judged[site_[row]] = plane_[row].damage;
  const std::vector<double> equivalent = all.damage;
  for (std::size_t site = 0; site < all.damage.size(); ++site) {
    const std::size_t group = group_of(site);
    if (group == no_site || leader[group] == no_site) continue;
    const std::size_t best = leader[group];
    const double of_best = equivalent[site_[best]];
    if (judged[site] >= 0)
      all.damage[site] = judged[site];
    else if (of_best > 0)
      all.damage[site] = equivalent[site] * (plane_[best].damage / of_best);
  }
}

}  // namespace dresslife::fatigue
