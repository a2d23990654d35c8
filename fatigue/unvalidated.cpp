#include "fatigue/unvalidated.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fatigue/damage.h"
#include "fatigue/life_distribution.h"
#include "fatigue/wear.h"
#include "pipeline/base/statistics.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/life/first_failure.h"

namespace dresslife::fatigue {
namespace {

using pipeline::FileReader;
using pipeline::LifeResponse;
using pipeline::UnvalidatedMode;

constexpr const char* table_of_work = "/rubbing/work";

/// (dresspack) the patches of each.
std::vector<std::vector<RubbedPatch>> patches_of(const FileReader& strain, std::size_t dresspacks) {
  const auto dresspack = strain.read<std::int32_t>("/rubbing/dresspack");
  const auto place = strain.read<double>("/rubbing/place"), work = strain.read<double>(table_of_work),
             time = strain.read<double>("/rubbing/time");
  const auto obstacle = strain.read<std::string>("/rubbing/obstacle");
  std::vector<std::vector<RubbedPatch>> patches(dresspacks);
  const double turn = 2 * std::numbers::pi;
  constexpr double most = 1e3;          // [m] of a dresspack
  constexpr double most_patches = 5e7;  // 0.4 GB
  const auto refuse = [&](const std::string& what) {
    throw pipeline::InputError(strain.where(), "/rubbing: " + what,
                               "make the file again with dresslife-strain");
  };
  const auto is_length = [](double value, double longest) { return value > 0 && value <= longest; };
  double shortest = most, end = 0;
  for (std::size_t k = 0; k < work.size(); ++k) {
    const double* const p = &place[4 * k];
    if (dresspack[k] < 0 || static_cast<std::size_t>(dresspack[k]) >= dresspacks || !(work[k] >= 0) ||
        !is_length(p[0], most) || !is_length(p[1], most) || !(p[2] >= 0 && p[2] <= turn) ||
        !is_length(p[3], turn) || p[3] != place[3])
      refuse(fmt::format("row {} is no patch of a dresspack", k + 1));
    shortest = std::min(shortest, p[1]), end = std::max(end, p[0] + p[1]);
    patches[static_cast<std::size_t>(dresspack[k])].push_back(
        {p[0], p[1], p[2], p[3], obstacle[k], work[k], time[k]});
  }
  if (!place.empty() && end / shortest * turn / place[3] > most_patches)
    refuse("its patches are too small to hold");
  return patches;
}

/// Over the samples that the validated modes have; its rate and thickness are of its own.
LifeResponse response_of(const Abrasion& worn, const pipeline::Job& job, const std::string& dresspack) {
  LifeResponse response;
  response.mode = UnvalidatedMode::abrasion;
  response.dresspack = dresspack;
  response.knowledge = pipeline::prior_of(job.uncertainty);
  if (!job.uncertainty.enabled) response.knowledge.covariance.setZero();
  const double median = std::min(std::log10(worn.repeats), LifeResponse::undamaged);
  response.worst_life = {median};
  response.bound = {median, median, median};
  response.planned.resize(1);
  for (std::size_t i = 0; i < percentiles.size(); ++i)
    response.planned[0][i] = median + pipeline::normal_quantile(percentiles[i]) * worn.log10_spread;
  response.scatter_shared = 0;
  return response;
}

/// Segments and length of a dresspack's piece from a place to its tool clamp.
void put_place(UnvalidatedMode& mode, const FileReader& strain, std::size_t dresspack, double position) {
  const auto length = strain.read<double>("/segment/length");
  const auto of = pipeline::dresspack_of_segments(strain);
  double whole = 0;
  for (std::size_t k = 0; k < length.size(); ++k)
    if (of[k] == dresspack) whole += length[k];
  mode.position_from_tool = std::max(0.0, whole - position);
  double end = 0;
  for (std::size_t k = 0; k < length.size(); ++k)
    if (of[k] == dresspack && (end += length[k]) > position) ++mode.segment_from_tool;
}

bool is_hose(const pipeline::Dresspack& dresspack) {
  return dresspack.hose_corrugation || dresspack.inner_diameter || !dresspack.hose_material.empty();
}

}  // namespace

std::vector<UnvalidatedMode> abrasion_modes(const FileReader& strain, const pipeline::Job& job,
                                            const std::vector<double>& lives) {
  std::vector<UnvalidatedMode> modes;
  if (!strain.has(table_of_work)) return modes;
  const auto patches = patches_of(strain, job.dresspacks.size());
  const auto time = strain.read<double>("/time");
  const auto step = strain.read<std::int32_t>("/program/step");
  const auto text = strain.read<std::string>("/program/text");
  const double repeat = time.empty() ? 0 : time.back() - time.front();
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const std::optional<WornMaterial> material = worn_of(job.dresspacks[d].dresspack);
    if (!material) continue;
    const Abrasion worn = abrasion(*material, patches[d]);
    UnvalidatedMode& mode = modes.emplace_back();
    mode.mode = UnvalidatedMode::abrasion;
    mode.dresspack = pipeline::name_among(job, d);
    mode.place = worn.obstacle;
    mode.time = worn.time;
    std::vector<double> own(lives.size(), std::numeric_limits<double>::infinity());
    if (std::isfinite(worn.repeats)) {
      own = pipeline::first_failures({response_of(worn, job, mode.dresspack)}, "", lives.size());
      put_place(mode, strain, d, worn.position);
      const auto sample =
          static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), worn.time) - time.begin());
      if (sample < step.size() && step[sample] >= 0) mode.step = text[static_cast<std::size_t>(step[sample])];
    }
    std::vector<double> together(lives.size());
    std::size_t first = 0;
    for (std::size_t s = 0; s < lives.size(); ++s)
      first += own[s] < lives[s], together[s] = std::min(own[s], lives[s]);
    mode.first_share = static_cast<double>(first) / static_cast<double>(lives.size());
    const auto repeats = pipeline::percentiles_of(std::move(own));
    for (std::size_t i = 0; i < repeats.size(); ++i) mode.hours[i] = hours(repeats[i], repeat);
    mode.together_p10 = hours(pipeline::percentiles_of(std::move(together))[0], repeat);
  }
  return modes;
}

std::string not_evaluated(const FileReader& strain, const pipeline::Job& job) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  bool cables = false;
  for (const pipeline::MountedDresspack& mounted : job.dresspacks) {
    const pipeline::Dresspack& dresspack = mounted.dresspack;
    for (const pipeline::Component& part : dresspack.components)
      if (part.plain) add(part.name);
    if (!dresspack.core_parts.empty())
      add(dresspack.core_parts);
    else if (dresspack.core_diameter > 0)
      add(fmt::format("the core of {:.4g} mm", 1e3 * dresspack.core_diameter));
    if (is_hose(dresspack) && dresspack.hose_material.empty()) add(UnvalidatedMode::wall);
    cables = cables || std::any_of(dresspack.components.begin(), dresspack.components.end(),
                                   [](const pipeline::Component& part) { return !part.components.empty(); });
  }
  const bool worn = strain.has(table_of_work) &&
                    std::all_of(job.dresspacks.begin(), job.dresspacks.end(),
                                [](const auto& mounted) { return worn_of(mounted.dresspack).has_value(); });
  if (!worn) add(UnvalidatedMode::abrasion);
  if (cables) add("jackets of the cables");
  for (const char* always : {"kinks", "clamps", "connectors"}) add(always);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace dresslife::fatigue
