#include "fatigue/cable_cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "pipeline/base/constants.h"
#include "pipeline/base/readable.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/excess.h"
#include "pipeline/job/line_key.h"
#include "pipeline/job/parts_room.h"

namespace dresslife::fatigue {

const pipeline::Component& component_of(const pipeline::FileReader& strain, const pipeline::Job& job,
                                        std::size_t dresspack, std::size_t component) {
  if (dresspack < job.dresspacks.size()) {
    const auto& components = job.dresspacks[dresspack].dresspack.components;
    if (component < components.size()) return components[component];
  }
  throw pipeline::InputError(strain.where(),
                             fmt::format("has a cable of component {} of dresspack {}, which its job does not have",
                                         component + 1, dresspack + 1),
                             "make the file again with dresslife-strain");
}

namespace {

/// Returns the slack nearest to the present one within the fitting range, as a line of the job.
std::string slack_line(const CableFacts& facts, double least, double most) {
  least /= facts.slack_factor, most /= facts.slack_factor;
  const std::string low = pipeline::percent_above(least), high = pipeline::percent_below(most);
  return fmt::format("{}: {} ({} .. {} fit; now {:.3g})", cable_key(facts, "slack_percent"),
                     facts.component->laying.slack < 100 * least ? low : high, low, high,
                     facts.component->laying.slack);
}

/// Returns the cause of the pull in a cable that is held at its place and at both clamps, and the remedy.
Cure held_cure(const CableFacts& facts, bool known_bore, double least, double most) {
  const std::string path = fmt::format(
      "its place in the dresspack and both clamps hold it, while its path changes by {:.2g} "
      ".. {:.2g} %",
      100 * facts.least_gain, 100 * facts.most_gain);
  if (known_bore)
    return {path, fmt::format("{}: loose, or {}", cable_key(facts, "position"),
                              std::isfinite(most) && least <= most
                                  ? slack_line(facts, least, most)
                                  : fmt::format("{} and tool_grip_N as measured", cable_key(facts, "base_grip_N")))};
  if (facts.motion && facts.motion->is_prescribed()) {
    const auto& rig = facts.motion->rig;
    const bool held = rig && rig->kind == pipeline::RigKind::torsion && !rig->weight;
    return {path, fmt::format("{}less bend or twist in {}",
                              held ? "motion.rig.weight_kg: 0 if the lower end is free to move, or " : "",
                              rig ? "motion.rig" : "motion.deformation")};
  }
  // Inside a cable friction may hold the pull, and then a clamp that lets the part slip changes little.
  const double bore = pipeline::usual_bore_share * facts.dresspack->diameter;
  const std::string in_hose =
      2 * facts.component->radius < bore
          ? fmt::format("{}.inner_diameter_mm: {:.3g} (ESTIMATE) if it lies in a hose, else ", facts.key, 1e3 * bore)
          : "";
  return {path, fmt::format("{}{}{} and tool_grip_N as measured", in_hose,
                            pipeline::is_single_cable(*facts.dresspack)
                                ? "the lengths and clamps that `dresslife improve` finds (less bend and twist), or "
                                : "",
                            cable_key(facts, "base_grip_N"))};
}

/// Returns the room per wound excess. Excess s in a room c makes a helix of curvature 2 s/c (excess.h), which must keep
/// the bend radius that the usual rule demands for the cable itself.
double room_per_excess(const CableFacts& facts) {
  return 2 * pipeline::least_bend_diameters * 2 * facts.component->radius;
}

}  // namespace

std::string cable_key(const CableFacts& facts, const char* key) {
  return fmt::format("{}.components.{}.{}", facts.key, facts.number, key);
}

Cure cure_of(const CableFacts& facts, const pipeline::CableForce& cable, bool sticks, bool compressed,
             double acceleration) {
  // A hose for air or water has no known breaking force. No force in it is too large then, and its slack is not the cause.
  const double limit = cable.strength() > 0 ? pipeline::believable_share * cable.strength() : infinity,
               slack = facts.slack_factor * facts.component->laying.slack / 100;
  if (sticks) return {"it sticks to the hose (strain.slip of its level is stick)", "strain.slip: friction"};
  if (!facts.has_room)
    return {"slack, play, grips or position of the cable",
            cable_key(facts, "slack_percent") + " (run dresslife-strain again for its value)"};
  const double least = std::max(0.0, facts.most_gain - cable.strain_at(limit));
  // Includes the straight hose, for which pipeline::slack_warnings() warns.
  const double most = std::min(0.0, facts.least_gain) + pipeline::excess_at_force(cable, limit, facts.room);
  if (!pipeline::lies_loose(*facts.dresspack, *facts.component))
    return held_cure(facts, pipeline::inner_radius(*facts.dresspack).has_value(), least, most);
  const std::string room = fmt::format("it has {:.2g} mm of room and {:.3g} % of slack", 1e3 * facts.room, 100 * slack);
  const double highest = std::min(most, pipeline::largest_slack);
  if (const double laid = pipeline::slack_to_lay(facts.winding_slack);
      !compressed && facts.winding_slack > 0 && slack < laid && slack < least && laid <= highest)
    return {
        fmt::format(
            "it has {:.3g} % of slack, too little to wind around the hose's axis, so that it stays on one side of the "
            "hose and a bend of the hose pulls it",
            100 * slack),
        slack_line(facts, laid, highest)};
  const std::string cause =
      compressed ? fmt::format("{}, where its path and its room take {} % at most", room, pipeline::percent_below(most))
                 : fmt::format("{}, and its path gets {} % longer if no cable beside it gives way", room,
                               pipeline::percent_above(least));
  if (least <= slack && slack <= most)
    return {
        room +
            ", which fit its path; winding around the hose's axis, friction, its weight and the hose's motion pull it",
        fmt::format("motion.acceleration_percent: {:.0f} (now {:.0f}), {} as measured, or {}",
                    std::max(1.0, acceleration / 2), acceleration, cable_key(facts, "friction_coefficient"),
                    gentle_clamps)};
  const double proposed = std::min(highest, facts.least_gain + facts.room / room_per_excess(facts));
  if (least <= proposed) return {cause, slack_line(facts, least, proposed)};
  if (least > pipeline::largest_slack)
    return {cause,
            fmt::format("no slack up to {:g} % cures it: a hose that bends less, or a place nearer to its axis ({})",
                        100 * pipeline::largest_slack, cable_key(facts, "helix_radius_mm"))};
  const double needed = std::max(pipeline::room_of_excess(cable, least - std::min(0.0, facts.least_gain), limit),
                                 (least - facts.least_gain) * room_per_excess(facts));
  return {
      cause,
      fmt::format(
          "no slack fits this room. It needs {:.2g} mm: {}: {:.2g} if it has them, else another {} or {}.inner_diameter_mm",
          1e3 * needed, cable_key(facts, "play_mm"), 1e3 * needed, cable_key(facts, "helix_radius_mm"), facts.key)};
}

std::vector<CableFacts> facts_of(const pipeline::FileReader& strain, const pipeline::Job& job) {
  const auto names = strain.read<std::string>("/cable/name");
  const auto dresspack = strain.read<std::int32_t>("/cable/dresspack");
  const auto component = strain.read<std::int32_t>("/cable/component");
  const auto span = strain.read<std::int32_t>("/cable/span");
  std::vector<double> room, gain;
  const bool has_room = strain.has("/cable/room");
  if (has_room) room = strain.read<double>("/cable/room"), gain = strain.read<double>("/cable/path_gain");
  std::vector<CableFacts> all;
  std::map<std::int32_t, std::int32_t> first_span;  // of a dresspack
  for (std::size_t k = 0; k < span.size(); ++k) {
    const auto found = first_span.try_emplace(dresspack[k], span[k]).first;
    found->second = std::min(found->second, span[k]);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto in = static_cast<std::size_t>(dresspack[k]);
    const auto which = static_cast<std::size_t>(component[k]);
    CableFacts facts{names[k], line_key(job, in, "dresspack"), "", &component_of(strain, job, in, which),
                     &job.dresspacks[in].dresspack};
    facts.between = pipeline::between_clamps(job.dresspacks[in].routing,
                                             static_cast<std::size_t>(span[k] - first_span.at(dresspack[k])));
    facts.number = entry_number(facts.dresspack->components, which);
    facts.motion = &job.motion;
    facts.has_room = has_room;
    facts.slack_factor = job.strain.factors.slack;
    facts.winding_slack = pipeline::winding_slack(job.dresspacks[in], *facts.component);
    if (has_room) facts.room = room[k], facts.least_gain = gain[2 * k], facts.most_gain = gain[2 * k + 1];
    all.push_back(facts);
  }
  return all;
}

std::string moment_of(const pipeline::FileReader& strain, std::size_t sample) {
  const auto time = strain.read<double>("/time");
  const auto step = strain.read<std::int32_t>("/program/step");
  const auto text = strain.read<std::string>("/program/text");
  const auto line = static_cast<std::size_t>(step[sample]);
  return fmt::format("at {:.3f} s, program step {} '{}'", time[sample], line + 1, line < text.size() ? text[line] : "");
}

}  // namespace dresslife::fatigue
