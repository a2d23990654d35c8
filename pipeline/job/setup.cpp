#include "pipeline/job/setup.h"

#include "pipeline/base/lists.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, MountedDresspack& mounted) {
  f.place(mounted.where);
  f.text("name", mounted.name, Need::required, "A unique name without '/'.");
  f.group("dresspack", mounted.dresspack, Need::required,
          "The dresspack: a name of config/dresspacks, a file, or the keys themselves.");
  f.group("routing", mounted.routing, Need::required, "The clamps and the free length.");
}

std::vector<double> free_lengths(const Setup& setup) {
  return mapped(setup.dresspacks, [](const MountedDresspack& mounted) { return mounted.routing.free_length; });
}

Cell surroundings(const Setup& setup) {
  Cell all = setup.cell;
  for (const Link& link : setup.robot.fixed_links) {
    all.capsules.insert(all.capsules.end(), link.capsules.begin(), link.capsules.end());
    all.boxes.insert(all.boxes.end(), link.boxes.begin(), link.boxes.end());
    all.meshes.insert(all.meshes.end(), link.meshes.begin(), link.meshes.end());
  }
  return all;
}

double clamped_length(const Setup& setup) {
  return setup.motion.rig ? clamped_length(*setup.motion.rig, setup.dresspacks.front().dresspack.diameter) : 0;
}

std::string name_among(const Setup& setup, std::size_t dresspack) {
  return setup.dresspacks.size() > 1 ? setup.dresspacks[dresspack].name : "";
}

std::string dresspack_words(const Setup& setup, std::size_t dresspack) {
  const std::string name = name_among(setup, dresspack);
  return name.empty() ? "dresspack" : fmt::format("dresspack '{}'", name);
}

}  // namespace dresslife::pipeline
