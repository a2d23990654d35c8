#include "pipeline/resolve/complete.h"

#include <unordered_map>

#include "pipeline/base/digest.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/cable/warmth.h"
#include "pipeline/job/job_forms.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

namespace {

/// Computes stiffnesses from the construction, after a check of the construction. They depend only on the keys and on the
/// temperature. Most jobs of a study share a few dresspacks, so each result is kept: without it the expansion of a study takes 1.4
/// times as long.
void take_stiffnesses(Dresspack& dresspack, const std::vector<Slip>& slip) {
  if (!is_from_construction(dresspack) && !lacks_friction(dresspack)) return;
  check_dresspack(dresspack, slip);
  struct Stiffnesses {
    double mass_per_length, bending, torsional, axial;
    std::vector<BendingFriction> friction;
  };
  thread_local std::unordered_map<std::string, Stiffnesses> known;
  const std::string text = to_yaml(echo_fields(dresspack));
  const std::string keys = xxh3(fmt::format("{}\n{}", dresspack.stiffness_factor, text));
  if (!known.contains(keys)) {
    take_from_construction(dresspack);
    known[keys] = {dresspack.mass_per_length, dresspack.bending_stiffness, dresspack.torsional_stiffness,
                   dresspack.axial_stiffness, dresspack.bending_friction};
  }
  const Stiffnesses& same = known[keys];
  dresspack.mass_per_length = same.mass_per_length;
  dresspack.bending_stiffness = same.bending;
  dresspack.bending_friction = same.friction;
  dresspack.torsional_stiffness = same.torsional;
  dresspack.axial_stiffness = same.axial;
}

void soften(std::vector<Component>& parts, double factor) {
  for (Component& part : parts) {
    part.stiffness_factor = factor;
    if (part.plain) part.plain->stiffness_factor = factor;
    soften(part.components, factor);
  }
}

/// strain.gate of a job with a rig, if the key is missing: above the rounding of strains in single precision (W26).
constexpr double gate_of_rigs = 1e-6;

}  // namespace

void complete_job(Job& job, const Node& document, Problems& problems) {
  const double softer = stiffness_at(job.cell.temperature);
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    MountedDresspack& mounted = job.dresspacks[d];
    mounted.dresspack.stiffness_factor = softer;
    soften(mounted.dresspack.components, softer);
    const std::string path = forms_of(job).one ? "" : fmt::format("dresspacks[{}].", d + 1);
    if (!problems.touch("robot") && !problems.touch(path + "routing"))
      problems.attempt(path + "routing", mounted.routing.where, [&] { place_clamps(mounted.routing, job.robot); });
    if (!problems.touch(path + "dresspack"))
      problems.attempt(path + "dresspack", mounted.dresspack.where,
                       [&] { take_stiffnesses(mounted.dresspack, job.strain.slip); });
  }
  if (problems.touch("motion")) return;
  if (!problems.attempt("motion", job.motion.where, [&] {
        job.motion.left_out = joined(std::move(job.motion.left_out), plausibility_of_motion(job));
      }))
    return;
  if (!job.motion.rig) return;
  problems.attempt("motion", job.motion.where, [&] { check_rig(*job.motion.rig); });
  const Node* strain = document.find("strain");
  // A rig tests millions of cycles below the usual gate, and its few samples need little time.
  if (!strain || !strain->find("gate")) job.strain.gate = gate_of_rigs;
}

}  // namespace dresslife::pipeline
