#include "fatigue/cable_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "fatigue/cable_cures.h"
#include "fatigue/strain_relief.h"
#include "fatigue/varied_forces.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/cable_pulls.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::fatigue {
namespace {

using pipeline::PulledCable;

/// The cables of the file, in its order, and the span of each.
struct Cables {
  std::vector<PulledCable> all;
  std::vector<std::int32_t> span;
  std::size_t samples, spans;
};

/// Moves some cables out of `cables`; their strains there are empty afterwards.
std::vector<PulledCable> taken(Cables& cables, const std::vector<std::size_t>& which) {
  return pipeline::mapped(which, [&](std::size_t k) { return std::move(cables.all[k]); });
}

Cables cables_of(const pipeline::FileReader& strain, const pipeline::Job& job) {
  const auto dresspack = strain.read<std::int32_t>("/cable/dresspack");
  const auto component = strain.read<std::int32_t>("/cable/component");
  const auto place = strain.read<double>("/cable/clamp_place");
  const auto strains = strain.read<double>("/cable/strain");
  const std::size_t count = dresspack.size();
  Cables cables{{}, strain.read<std::int32_t>("/cable/span"), strain.length("sample"), strain.length("cable_span")};
  for (std::size_t k = 0; k < count; ++k) {
    if (cables.span[k] < 0 || static_cast<std::size_t>(cables.span[k]) >= cables.spans)
      throw pipeline::InputError(
          strain.where(), fmt::format("has a cable of span {} of {}", std::int64_t{cables.span[k]} + 1, cables.spans),
          "make the file again with dresslife-strain");
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

/// tension: of the cable with the largest share of its strength. moment: "at 1.2 s, program step 3 'text'".
pipeline::Warning force_warning(const CableFacts& facts, const pipeline::CableForce& cable, double tension,
                                const std::string& moment, const std::string& cause, const pipeline::Remedy& remedy) {
  return pipeline::warning_of(
      pipeline::WarningKind::force, "",
      fmt::format(
          "'{}' is {}{} with {:.0f} % of its breaking force: {} of {} N (limit {:.0f} %) {}; that is unrealistic: "
          "do not plan with the hours",
          facts.name, tension < 0 ? "compressed" : "pulled", facts.between, 100 * std::abs(tension) / cable.strength(),
          pipeline::readable(std::abs(tension)), pipeline::readable(cable.strength()), 100 * pipeline::believable_share,
          moment),
      cause, remedy);
}

void write_tensions(pipeline::FileWriter& life, const std::vector<std::string>& names,
                    const std::vector<std::vector<double>>& tension, std::size_t samples) {
  life.set_axis("cable", names.size());
  const auto shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
  life.set_text_width("/cable/name", std::ranges::max_element(names, shorter)->size());
  life.append("/cable/name", names);
  std::vector<double> rows;
  for (std::size_t t = 0; t < samples; ++t)
    for (const std::vector<double>& of : tension) rows.push_back(of[t]);
  life.append("/cable/tension", rows);
}

}  // namespace

CableForces write_cable_forces(const pipeline::FileReader& strain, const pipeline::Job& job,
                               pipeline::FileWriter& life) {
  if (!strain.has("/cable/strain")) {
    for (const char* name : {"largest_force_share", "clamp_moment_share"})
      if (strain.has_attribute(name)) life.attribute(name, strain.number_attribute(name));
    return {};
  }
  Cables cables = cables_of(strain, job);
  const std::vector<CableFacts> facts = facts_of(strain, job);
  const auto carried = strain.read<double>("/cable_span/hose_moment");
  std::vector<std::vector<double>> tension(cables.all.size());
  std::vector<double> cable_moment,
      hose_moment;  // of the span with the largest moment of cables over the moment of the hose
  const auto force = pipeline::mapped(cables.all, &PulledCable::force);
  double force_share = 0, moment_share = 0, relief_share = 0;
  std::size_t strained = 0, at_sample = 0;  // cable with the largest share of its strength, and the sample
  std::size_t bender = 0, bent_sample = 0;  // cable with the largest pull at the most bent clamp, and the sample
  for (std::size_t span = 0; span < cables.spans; ++span) {
    std::vector<std::size_t> in_span;
    for (std::size_t k = 0; k < cables.all.size(); ++k)
      if (cables.span[k] == static_cast<std::int32_t>(span)) in_span.push_back(k);
    if (in_span.empty()) continue;
    pipeline::CablePulls pulls = pipeline::pulls_of(taken(cables, in_span), cables.samples);
    for (std::size_t i = 0; i < in_span.size(); ++i) tension[in_span[i]] = std::move(pulls.tension[i]);
    for (std::size_t i = 0; i < in_span.size(); ++i) {
      const double held = held_by_strain_relief(2 * facts[in_span[i]].component->radius);
      if (held > 0) relief_share = std::max(relief_share, std::max(pulls.end_pull[i][0], pulls.end_pull[i][1]) / held);
    }
    if (pulls.force_share > force_share)
      force_share = pulls.force_share, strained = in_span[pulls.of_cable], at_sample = pulls.at_sample;
    std::vector<double> of_hose(cables.samples);
    for (std::size_t t = 0; t < cables.samples; ++t) of_hose[t] = carried[t * cables.spans + span];
    const double share = pipeline::moment_share(pulls, of_hose);
    if (!cable_moment.empty() && share <= moment_share) continue;
    moment_share = share;
    bent_sample = static_cast<std::size_t>(std::ranges::max_element(pulls.moment) - pulls.moment.begin());
    bender = *std::ranges::max_element(in_span, [&](std::size_t a, std::size_t b) {
      return std::abs(tension[a][bent_sample]) < std::abs(tension[b][bent_sample]);
    });
    cable_moment = pulls.moment;
    hose_moment = of_hose;
  }
  write_tensions(life, strain.read<std::string>("/cable/name"), tension, cables.samples);
  life.append("/clamp/cable_moment", cable_moment);
  life.append("/clamp/hose_moment", hose_moment);
  life.attribute("largest_force_share", force_share);
  life.attribute("clamp_moment_share", moment_share);
  life.attribute("strain_relief_share", relief_share);
  const bool sticks = !slides(job.strain.slip.front());
  const FileCables of_file{facts, force, cables.span};
  const ForceShares own{force_share, moment_share};
  const std::optional<pipeline::Remedy> together = slack_remedy(strain, job, of_file, own);
  const auto remedy_of = [&](const CableFacts& of, const Cure& cure) {
    return together && pipeline::lies_loose(*of.dresspack, *of.component) ? *together
                                                                          : pipeline::Remedy{{}, cure.remedy};
  };
  std::vector<pipeline::Warning> warnings;
  if (force_share > pipeline::believable_share) {
    const Cure cure = cure_of(facts[strained], force[strained], sticks, tension[strained][at_sample] < 0,
                              job.motion.acceleration_percent);
    warnings.push_back(force_warning(facts[strained], force[strained], tension[strained][at_sample],
                                     moment_of(strain, at_sample), cure.cause, remedy_of(facts[strained], cure)));
  }
  if (moment_share > pipeline::believable_share) {
    const Cure cure = cure_of(facts[bender], force[bender], sticks, tension[bender][bent_sample] < 0,
                              job.motion.acceleration_percent);
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::force, "",
        fmt::format(
            "the cables{} bend a clamp with {:.2g} times the moment of the hose ({} of {} N m, limit {:g} times) {}; "
            "'{}' {} most, with {} N",
            facts[bender].between, moment_share, pipeline::readable(cable_moment[bent_sample]),
            pipeline::readable(*std::ranges::max_element(hose_moment)), pipeline::believable_share,
            moment_of(strain, bent_sample), facts[bender].name, tension[bender][bent_sample] < 0 ? "presses" : "pulls",
            pipeline::readable(std::abs(tension[bender][bent_sample]))),
        cure.cause, remedy_of(facts[bender], cure)));
  }
  warnings = pipeline::joined(std::move(warnings), varied_force_warnings(strain, job, of_file, own, together));
  return {std::move(warnings), std::move(tension)};
}

}  // namespace dresslife::fatigue
