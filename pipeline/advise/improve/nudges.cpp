#include "pipeline/advise/improve/nudges.h"

#include <fmt/format.h>

#include "pipeline/job/job.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

std::string routings_of(const Job& job) {
  std::string text;
  for (const MountedDresspack& mounted : job.dresspacks)
    text += mounted.name + to_yaml(echo_fields(mounted.routing));
  return text;
}

void add_place(std::vector<Nudge>& nudges, const std::string& path, const std::string& name,
               const Vector3d& own, double by) {
  constexpr const char* axes = "xyz";
  for (int axis = 0; axis < 3; ++axis)
    for (const double off : {-by, by}) {
      Vector3d position = own;
      position[axis] += off;
      nudges.push_back({fmt::format("{}, {} {} {:.3g} mm", name, axes[axis], off < 0 ? "−" : "+", 1e3 * by),
                        {fmt::format("{}.position_m=[{:.6g}, {:.6g}, {:.6g}]", path, position.x(),
                                     position.y(), position.z())}});
    }
}

}  // namespace

std::vector<Nudge> nudges_of(const std::vector<StudyJob>& jobs, double by) {
  std::vector<Nudge> nudges;
  for (const StudyJob& job : jobs)
    if (!job.job || routings_of(*job.job) != routings_of(*jobs.front().job)) return nudges;
  const Job& job = *jobs.front().job;
  for (std::size_t k = 0; k < job.dresspacks.size(); ++k) {
    const MountedDresspack& mounted = job.dresspacks[k];
    const std::string path = mounted.name.empty() ? "routing" : fmt::format("dresspacks.{}.routing", k + 1);
    const std::string of = mounted.name.empty() ? "" : mounted.name + ": ";
    if (mounted.routing.base_clamp)
      add_place(nudges, path + ".base_clamp", of + "base clamp", mounted.routing.base_clamp->position, by);
    const auto& between = mounted.routing.clamps;
    for (std::size_t i = 0; i < between.size(); ++i)
      add_place(nudges, fmt::format("{}.clamps.{}", path, i + 1), fmt::format("{}clamp {}", of, i + 1),
                between[i].clamp.position, by);
    const auto& rings = mounted.routing.rings;
    for (std::size_t i = 0; i < rings.size(); ++i)
      add_place(nudges, fmt::format("{}.rings.{}", path, i + 1), fmt::format("{}ring {}", of, i + 1),
                rings[i].position, by);
    if (mounted.routing.tool_clamp)
      add_place(nudges, path + ".tool_clamp", of + "tool clamp", mounted.routing.tool_clamp->position, by);
    for (const double off : {-by, by})
      nudges.push_back({fmt::format("{}length, {} {:.3g} mm", of, off < 0 ? "−" : "+", 1e3 * by),
                        {fmt::format("{}.free_length_m={:.6g}", path, mounted.routing.free_length + off)}});
  }
  return nudges;
}

}  // namespace dresslife::pipeline
