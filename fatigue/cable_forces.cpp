#include "fatigue/cable_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "pipeline/cable/believable.h"
#include "pipeline/cable/cable_pulls.h"

namespace dresslife::fatigue {
namespace {

using pipeline::PulledCable;

/// The cables of the file, in its order, and the span of each.
struct Cables {
  std::vector<PulledCable> all;
  std::vector<std::int32_t> span;
  std::size_t samples, spans;
};

const pipeline::Component& component_of(const pipeline::FileReader& strain, const pipeline::Job& job,
                                        std::size_t dresspack, std::size_t component) {
  if (dresspack < job.dresspacks.size()) {
    const auto& components = job.dresspacks[dresspack].dresspack.components;
    if (component < components.size()) return components[component];
  }
  throw pipeline::InputError(
      strain.where(),
      fmt::format("has a cable of component {} of dresspack {}, which its job does not have", component + 1,
                  dresspack + 1),
      "make the file anew with dresslife-strain");
}

/// Its strains leave what they are taken from.
std::vector<PulledCable> taken(Cables& cables, const std::vector<std::size_t>& which) {
  std::vector<PulledCable> of_span;
  for (const std::size_t k : which) of_span.push_back(std::move(cables.all[k]));
  return of_span;
}

Cables cables_of(const pipeline::FileReader& strain, const pipeline::Job& job) {
  const auto dresspack = strain.read<std::int32_t>("/cable/dresspack");
  const auto component = strain.read<std::int32_t>("/cable/component");
  const auto place = strain.read<double>("/cable/clamp_place");
  const auto strains = strain.read<double>("/cable/strain");
  const std::size_t count = dresspack.size();
  Cables cables{
      {}, strain.read<std::int32_t>("/cable/span"), strain.length("sample"), strain.length("cable_span")};
  for (std::size_t k = 0; k < count; ++k) {
    if (cables.span[k] < 0 || static_cast<std::size_t>(cables.span[k]) >= cables.spans)
      throw pipeline::InputError(
          strain.where(),
          fmt::format("has a cable of span {} of {}", std::int64_t{cables.span[k]} + 1, cables.spans),
          "make the file anew with dresslife-strain");
    const auto in = static_cast<std::size_t>(dresspack[k]);
    const pipeline::Component& of = component_of(strain, job, in, static_cast<std::size_t>(component[k]));
    cables.all.push_back({pipeline::CableForce(job.dresspacks[in].dresspack, of)});
    PulledCable& cable = cables.all.back();
    const double* const at = place.data() + 4 * k;
    cable.place = {{{at[0], at[1]}, {at[2], at[3]}}};
    for (std::size_t which = 0; which < 3; ++which)
      for (std::size_t t = 0; t < cables.samples; ++t)
        cable.strain[which].push_back(strains[(t * count + k) * 3 + which]);
  }
  return cables;
}

std::vector<pipeline::Warning> force_warnings(double force_share, double moment_share) {
  std::vector<pipeline::Warning> warnings;
  const auto warn = [&](double share, const char* what) {
    if (share > pipeline::believable_share)
      warnings.push_back(
          {pipeline::WarningKind::force, "",
           fmt::format("{:.2g} times {} (more than {:g}: strains rest on forces that nobody sees in a "
                       "dresspack); check slack, play, grips and position of its cables",
                       share, what, pipeline::believable_share)});
  };
  warn(force_share, "what tears a cable pulls at one");
  warn(moment_share, "the hose's own moment is what all cables put on a clamp");
  return warnings;
}

void write_tensions(pipeline::FileWriter& life, const std::vector<std::string>& names,
                    const std::vector<std::vector<double>>& tension, std::size_t samples) {
  life.set_axis("cable", names.size());
  const auto shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
  life.set_text_width("/cable/name", std::max_element(names.begin(), names.end(), shorter)->size());
  life.append("/cable/name", names);
  std::vector<double> rows;
  for (std::size_t t = 0; t < samples; ++t)
    for (const std::vector<double>& of : tension) rows.push_back(of[t]);
  life.append("/cable/tension", rows);
}

}  // namespace

std::vector<pipeline::Warning> write_cable_forces(const pipeline::FileReader& strain,
                                                  const pipeline::Job& job, pipeline::FileWriter& life) {
  if (!strain.has("/cable/strain")) {
    for (const char* name : {"largest_force_share", "clamp_moment_share"})
      if (strain.has_attribute(name)) life.attribute(name, strain.number_attribute(name));
    return {};
  }
  Cables cables = cables_of(strain, job);
  const auto carried = strain.read<double>("/cable_span/hose_moment");
  std::vector<std::vector<double>> tension(cables.all.size());
  std::vector<double> cable_moment, hose_moment;  // of the span whose cables ask most of their hose
  double force_share = 0, moment_share = 0;
  for (std::size_t span = 0; span < cables.spans; ++span) {
    std::vector<std::size_t> in_span;
    for (std::size_t k = 0; k < cables.all.size(); ++k)
      if (cables.span[k] == static_cast<std::int32_t>(span)) in_span.push_back(k);
    pipeline::CablePulls pulls = pipeline::pulls_of(taken(cables, in_span), cables.samples);
    for (std::size_t i = 0; i < in_span.size(); ++i) tension[in_span[i]] = std::move(pulls.tension[i]);
    force_share = std::max(force_share, pulls.force_share);
    std::vector<double> of_hose(cables.samples);
    for (std::size_t t = 0; t < cables.samples; ++t) of_hose[t] = carried[t * cables.spans + span];
    const double share = pipeline::moment_share(pulls, of_hose);
    if (!cable_moment.empty() && share <= moment_share) continue;
    moment_share = share;
    cable_moment = pulls.moment;
    hose_moment = of_hose;
  }
  write_tensions(life, strain.read<std::string>("/cable/name"), tension, cables.samples);
  life.append("/clamp/cable_moment", cable_moment);
  life.append("/clamp/hose_moment", hose_moment);
  life.attribute("largest_force_share", force_share);
  life.attribute("clamp_moment_share", moment_share);
  return force_warnings(force_share, moment_share);
}

}  // namespace dresslife::fatigue
