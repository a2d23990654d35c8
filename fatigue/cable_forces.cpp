#include "fatigue/cable_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "fatigue/strain_relief.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/cable_pulls.h"
#include "pipeline/cable/excess.h"
#include "pipeline/job/line_key.h"
#include "pipeline/job/parts_room.h"

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
      "make the file again with dresslife-strain");
}

/// Moves some cables out of `cables`; their strains there are empty afterwards.
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

struct Cure {
  std::string cause, remedy;
};

/// Data of a cable besides its force.
struct CableFacts {
  std::string name;
  std::string key;            ///< its dresspack as a line of the job: "dresspack"
  std::size_t number = 0;     ///< number of its component in this dresspack, from 1
  const pipeline::Component* component = nullptr;
  const pipeline::Dresspack* dresspack = nullptr;
  double room = 0, least_gain = 0, most_gain = 0;  ///< /cable/room, /cable/path_gain
  bool has_room = false;                           ///< the file contains these
  double winding_slack = 0;                        ///< see pipeline/cable/excess.h; 0: unknown, or not needed
};

/// Returns a key of the component, which all its `count` cables share, as a line of the job:
/// "dresspack.components.2.slack_percent".
std::string cable_key(const CableFacts& facts, const char* key) {
  return fmt::format("{}.components.{}.{}", facts.key, facts.number, key);
}

/// Returns the slack nearest to the present one within the fitting range, as a line of the job.
std::string slack_line(const CableFacts& facts, double least, double most) {
  const std::string low = pipeline::percent_above(least), high = pipeline::percent_below(most);
  return fmt::format("{}: {} ({} .. {} fit; now {:.3g})", cable_key(facts, "slack_percent"),
                     facts.component->laying.slack < 100 * least ? low : high, low, high, facts.component->laying.slack);
}

/// Returns the cause of the pull in a cable that is held at its place and at both clamps, and the remedy.
Cure held_cure(const CableFacts& facts, bool known_bore, double least, double most) {
  const std::string path = fmt::format("its place in the dresspack and both clamps hold it, while its path changes by {:.2g} "
                                       ".. {:.2g} %",
                                       100 * facts.least_gain, 100 * facts.most_gain);
  if (known_bore)
    return {path, fmt::format("{}: loose, or {}", cable_key(facts, "position"),
                              least <= most ? slack_line(facts, least, most)
                                            : fmt::format("{} and tool_grip_N as measured", cable_key(facts, "base_grip_N")))};
  return {path, fmt::format("{}.inner_diameter_mm: {:.3g} (ESTIMATE) if it lies in a hose, else {} and tool_grip_N as measured",
                            facts.key, 1e3 * pipeline::usual_bore_share * facts.dresspack->diameter,
                            cable_key(facts, "base_grip_N"))};
}

/// Returns the room per wound excess. Excess s in a room c makes a helix of curvature 2 s/c (excess.h), which must keep
/// the bend radius that the usual rule demands for the cable itself.
double room_per_excess(const CableFacts& facts) {
  return 2 * pipeline::least_bend_diameters * 2 * facts.component->radius;
}

/// Returns the cause and the remedy of a large force: a slack whose force is within the limit, by the gains of the path and by
/// the excess that a helix in its room can take. acceleration: motion.acceleration_percent.
Cure cure_of(const CableFacts& facts, const pipeline::CableForce& cable, bool sticks, bool compressed, double acceleration) {
  const double limit = pipeline::believable_share * cable.strength(), slack = facts.component->laying.slack / 100;
  if (sticks)
    return {"it sticks to the hose (strain.slip of its level is stick)", "strain.slip: friction"};
  if (!facts.has_room)
    return {"slack, play, grips or position of the cable", cable_key(facts, "slack_percent") + " (run dresslife-strain again for its value)"};
  const double least = std::max(0.0, facts.most_gain - cable.strain_at(limit));
  // Includes the straight hose, for which pipeline::slack_warnings() warns.
  const double most = std::min(0.0, facts.least_gain) + pipeline::excess_at_force(cable, limit, facts.room);
  if (!pipeline::lies_loose(*facts.dresspack, *facts.component))
    return held_cure(facts, pipeline::inner_radius(*facts.dresspack).has_value(), least, most);
  const std::string room = fmt::format("it has {:.2g} mm of room and {:.3g} % of slack", 1e3 * facts.room, 100 * slack);
  const double highest = std::min(most, pipeline::largest_slack);
  if (const double laid = pipeline::slack_to_lay(facts.winding_slack);
      !compressed && facts.winding_slack > 0 && slack < laid && slack < least && laid <= highest)
    return {fmt::format("it has {:.3g} % of slack, too little to wind around the hose's axis, so that it stays on one side of the "
                        "hose and a bend of the hose pulls it",
                        100 * slack),
            slack_line(facts, laid, highest)};
  const std::string cause =
      compressed ? fmt::format("{}, where its path and its room take {} % at most", room, pipeline::percent_below(most))
                 : fmt::format("{}, and its path gets {} % longer if no cable beside it gives way", room, pipeline::percent_above(least));
  if (least <= slack && slack <= most)
    return {room + ", which fit its path; friction, its weight and the hose's motion pull it",
            fmt::format("motion.acceleration_percent: {:.0f} (now {:.0f}), or {} as measured", std::max(1.0, acceleration / 2),
                        acceleration, cable_key(facts, "friction_coefficient"))};
  const double proposed = std::min(highest, facts.least_gain + facts.room / room_per_excess(facts));
  if (least <= proposed)
    return {cause, slack_line(facts, least, proposed)};
  if (least > pipeline::largest_slack)
    return {cause, fmt::format("no slack up to {:g} % cures it: a hose that bends less, or a place nearer to its axis ({})",
                               100 * pipeline::largest_slack, cable_key(facts, "helix_radius_mm"))};
  const double excess = least - facts.least_gain;
  const double needed =
      std::max(pipeline::room_of_excess(cable, excess, limit), excess * room_per_excess(facts));
  return {cause, fmt::format("no slack fits this room. It needs {:.2g} mm: {}: {:.2g} if it has them, else another {} or {}.inner_diameter_mm",
                             1e3 * needed, cable_key(facts, "play_mm"), 1e3 * needed, cable_key(facts, "helix_radius_mm"), facts.key)};
}

/// tension: of the cable with the largest share of its strength. moment: "at 1.2 s, program step 3 'text'".
pipeline::Warning force_warning(const CableFacts& facts, const pipeline::CableForce& cable, double tension,
                                const std::string& moment, bool sticks, double acceleration) {
  const Cure cure = cure_of(facts, cable, sticks, tension < 0, acceleration);
  return pipeline::warning_of(
      pipeline::WarningKind::force, "",
      fmt::format("'{}' is {} with {:.0f} % of its breaking force: {} of {} N (limit {:.0f} %) {}; that is unrealistic: "
                  "do not plan with the hours",
                  facts.name, tension < 0 ? "compressed" : "pulled", 100 * std::abs(tension) / cable.strength(),
                  pipeline::readable(std::abs(tension)), pipeline::readable(cable.strength()),
                  100 * pipeline::believable_share, moment),
      cure.cause, cure.remedy);
}

std::vector<CableFacts> facts_of(const pipeline::FileReader& strain, const pipeline::Job& job) {
  const auto names = strain.read<std::string>("/cable/name");
  const auto dresspack = strain.read<std::int32_t>("/cable/dresspack");
  const auto component = strain.read<std::int32_t>("/cable/component");
  std::vector<double> room, gain;
  const bool has_room = strain.has("/cable/room");
  if (has_room) room = strain.read<double>("/cable/room"), gain = strain.read<double>("/cable/path_gain");
  std::vector<CableFacts> all;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto in = static_cast<std::size_t>(dresspack[k]);
    const auto which = static_cast<std::size_t>(component[k]);
    CableFacts facts{names[k], line_key(job, in, "dresspack"), which + 1, &component_of(strain, job, in, which),
                     &job.dresspacks[in].dresspack};
    facts.has_room = has_room;
    facts.winding_slack = pipeline::winding_slack(job.dresspacks[in], *facts.component);
    if (has_room) facts.room = room[k], facts.least_gain = gain[2 * k], facts.most_gain = gain[2 * k + 1];
    all.push_back(facts);
  }
  return all;
}

/// Returns "at 1.2 s, program step 3 'text'".
std::string moment_of(const pipeline::FileReader& strain, std::size_t sample) {
  const auto time = strain.read<double>("/time");
  const auto step = strain.read<std::int32_t>("/program/step");
  const auto text = strain.read<std::string>("/program/text");
  const auto line = static_cast<std::size_t>(step[sample]);
  return fmt::format("at {:.3f} s, program step {} '{}'", time[sample], line + 1, line < text.size() ? text[line] : "");
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

CableForces write_cable_forces(const pipeline::FileReader& strain, const pipeline::Job& job, pipeline::FileWriter& life) {
  if (!strain.has("/cable/strain")) {
    for (const char* name : {"largest_force_share", "clamp_moment_share"})
      if (strain.has_attribute(name)) life.attribute(name, strain.number_attribute(name));
    return {};
  }
  Cables cables = cables_of(strain, job);
  const std::vector<CableFacts> facts = facts_of(strain, job);
  const auto carried = strain.read<double>("/cable_span/hose_moment");
  std::vector<std::vector<double>> tension(cables.all.size());
  std::vector<double> cable_moment, hose_moment;  // of the span with the largest moment of cables over the moment of the hose
  std::vector<pipeline::CableForce> force;
  for (const PulledCable& cable : cables.all) force.push_back(cable.force);
  double force_share = 0, moment_share = 0, relief_share = 0;
  std::size_t strained = 0, at_sample = 0;   // cable with the largest share of its strength, and the sample
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
      if (held > 0)
        relief_share = std::max(relief_share, std::max(pulls.end_pull[i][0], pulls.end_pull[i][1]) / held);
    }
    if (pulls.force_share > force_share)
      force_share = pulls.force_share, strained = in_span[pulls.of_cable], at_sample = pulls.at_sample;
    std::vector<double> of_hose(cables.samples);
    for (std::size_t t = 0; t < cables.samples; ++t) of_hose[t] = carried[t * cables.spans + span];
    const double share = pipeline::moment_share(pulls, of_hose);
    if (!cable_moment.empty() && share <= moment_share) continue;
    moment_share = share;
    bent_sample = static_cast<std::size_t>(std::max_element(pulls.moment.begin(), pulls.moment.end()) - pulls.moment.begin());
    bender = *std::max_element(in_span.begin(), in_span.end(), [&](std::size_t a, std::size_t b) {
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
  std::vector<pipeline::Warning> warnings;
  if (force_share > pipeline::believable_share)
    warnings.push_back(force_warning(facts[strained], force[strained], tension[strained][at_sample],
                                     moment_of(strain, at_sample), sticks, job.motion.acceleration_percent));
  if (moment_share > pipeline::believable_share) {
    const Cure cure = cure_of(facts[bender], force[bender], sticks, tension[bender][bent_sample] < 0,
                              job.motion.acceleration_percent);
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::force, "",
        fmt::format("the cables bend a clamp with {:.2g} times the moment of the hose ({} of {} N m, limit {:g} times) {}; "
                    "'{}' {} most, with {} N",
                    moment_share, pipeline::readable(cable_moment[bent_sample]),
                    pipeline::readable(*std::max_element(hose_moment.begin(), hose_moment.end())),
                    pipeline::believable_share, moment_of(strain, bent_sample), facts[bender].name,
                    tension[bender][bent_sample] < 0 ? "presses" : "pulls",
                    pipeline::readable(std::abs(tension[bender][bent_sample]))),
        cure.cause, cure.remedy));
  }
  return {std::move(warnings), std::move(tension)};
}

}  // namespace dresslife::fatigue
