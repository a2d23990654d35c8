#include "pipeline/advise/improve/reliefs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/advise/improve/merit.h"
#include "pipeline/base/readable.h"

namespace dresslife::pipeline {
namespace {

struct ClampPlace {
  const Clamp* clamp;
  std::string key;  ///< path behind "routing."
  double at;        ///< distance along the dresspack from the base clamp [m]
};

std::vector<ClampPlace> clamps_of(const Routing& routing) {
  std::vector<ClampPlace> clamps;
  if (routing.base_clamp) clamps.push_back({&*routing.base_clamp, "base_clamp", 0});
  for (std::size_t k = 0; k < routing.clamps.size(); ++k)
    clamps.push_back({&routing.clamps[k].clamp, fmt::format("clamps.{}", k + 1), routing.clamps[k].at_length});
  if (routing.tool_clamp) clamps.push_back({&*routing.tool_clamp, "tool_clamp", routing.free_length});
  return clamps;
}

BendRelief relief_of(const Job& job, const MountedDresspack& mounted) {
  return first_relief(mounted.dresspack.diameter, mounted.dresspack.bending_stiffness,
                      mounted.routing.free_length / job.simulation.segments);
}

}  // namespace

std::vector<std::vector<std::string>> reliefs_of(const Job& job) {
  std::vector<std::vector<std::string>> ways;
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    for (const double share : {0.5, 1.0}) {
      const MountedDresspack& mounted = job.dresspacks[d];
      const std::string path = mounted.name.empty() ? "routing." : fmt::format("dresspacks.{}.routing.", d + 1);
      const std::vector<ClampPlace> clamps = clamps_of(mounted.routing);
      std::vector<std::string> all;
      for (std::size_t k = 0; k < clamps.size(); ++k) {
        if (clamps[k].clamp->bend_relief) continue;
        double room = mounted.routing.free_length;
        if (k > 0) room = std::min(room, clamps[k].at - clamps[k - 1].at);
        if (k + 1 < clamps.size()) room = std::min(room, clamps[k + 1].at - clamps[k].at);
        BendRelief relief = relief_of(job, mounted);
        relief.stiffness *= share;
        constexpr double rounding = 1e-9;  // rounding error of differences of lengths [mm]
        relief.length = std::min(relief.length, std::floor(1e3 * room / 2 + rounding) / 1e3);
        all.push_back(fmt::format("{}{}.bend_relief={}", path, clamps[k].key, relief_text(relief)));
        ways.push_back({all.back()});
      }
      if (all.size() > 1) ways.push_back(all);
    }
  return ways;
}

std::string earlier_failures(const Outcome& with, const Outcome& without) {
  constexpr double worse = 1.1;  // (M1)
  std::string text;
  const auto add = [&](const std::string& mode, double hours, double own) {
    if (hours < std::min(with.robot_life, own / worse))
      text += fmt::format("{}{} after {} (without it {})", text.empty() ? "" : ", ", mode, hours_text(hours),
                          std::isinf(own) ? "never" : hours_text(own));
  };
  add("wires", with.hours, without.hours);
  for (const ModeLife& mode : with.modes) add(mode.mode, mode.hours, life_by(without, mode.mode));
  return text;
}

bool breaks_beside_clamp(const Job& job, const RankingRow& row) {
  if (!row.damaged() || row.headline_hours() >= row.robot_life_hours) return false;
  for (const MountedDresspack& mounted : job.dresspacks) {
    if (mounted.name != row.worst_dresspack && !row.worst_dresspack.empty()) continue;
    const double at = mounted.routing.free_length - row.worst_position_from_tool;
    for (const ClampPlace& clamp : clamps_of(mounted.routing))
      if (!clamp.clamp->bend_relief && std::abs(at - clamp.at) < relief_of(job, mounted).length) return true;
  }
  return false;
}

}  // namespace dresslife::pipeline
