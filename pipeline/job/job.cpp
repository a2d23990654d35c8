#include "pipeline/job/job.h"

#include <stdexcept>

#include "pipeline/job/job_forms.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

JobForms forms_of(const Job& job) {
  const bool one = job.dresspacks.size() == 1 && job.dresspacks.front().name.empty();
  return {one, !one};
}

void describe_keys(Fields& f, Job& job, const JobForms& forms) {
  // The motion is first, because it determines whether a robot is required.
  f.group("motion", job.motion, Need::required,
          "The motion: a name of config/programs, a file, or the keys themselves.");
  f.group("robot", job.robot, job.motion.needs_robot() ? Need::required : Need::optional,
          "The robot: a name of config/robots, a file, or the keys themselves. A rig needs none.",
          !job.robot.joints.empty());
  if (forms.one) {
    MountedDresspack& only = job.dresspacks.front();
    f.group("dresspack", only.dresspack, Need::required,
            "The dresspack: a name of config/dresspacks, a file, or the keys themselves.");
    f.group("routing", only.routing, job.motion.rig ? Need::optional : Need::required,
            "The clamps and the free length. A rig needs none.", !job.motion.rig);
  }
  if (forms.list)
    f.list("dresspacks", job.dresspacks, forms.one ? Need::optional : Need::required,
           "Several dresspacks on one robot, instead of dresspack and routing.");
  f.group("cell", job.cell, Need::optional, "The fixed obstacles around the robot.");
  f.group("simulation", job.simulation, Need::optional, "The settings of dresslife-sim.");
  f.group("strain", job.strain, Need::optional, "The settings of dresslife-strain.");
  f.group("fatigue", job.fatigue, Need::optional, "The settings of dresslife-fatigue.");
  f.group("inspection", job.inspection, Need::optional, "The visual checks of the dresspack in the plant.");
  f.group("uncertainty", job.uncertainty, Need::optional, "The uncertain parameters and their standard deviations.");
  f.maybe_group("calibration", job.calibration,
                "A file that dresslife calibrate wrote. It holds the posterior of the uncertain parameters.",
                Need::written);
}

void describe(Fields& f, Job& job) { describe_keys(f, job, forms_of(job)); }

namespace {

const Material& resolved_material(const Job& job, const std::string& wanted) {
  for (const MountedDresspack& mounted : job.dresspacks)
    for (const Material& material : mounted.dresspack.materials)
      if (material.name == wanted) return material;
  throw std::logic_error("material '" + wanted + "' was not resolved");
}

}  // namespace

Material material_of(const Job& job, const std::string& name) {
  return changed(resolved_material(job, job.fatigue.material.empty() ? name : job.fatigue.material), job.fatigue);
}

ParameterKnowledge knowledge_of(const Job& job) {
  ParameterKnowledge knowledge = prior_of(job.uncertainty);
  if (job.calibration) knowledge = knowledge_of(*job.calibration, std::move(knowledge));
  if (job.robot.joints.empty()) {  // no ramps of a controller and no swinging
    const auto motion = static_cast<Eigen::Index>(index_of(Uncertain::motion));
    knowledge.mean[motion] = 0;
    knowledge.covariance.row(motion).setZero();
    knowledge.covariance.col(motion).setZero();
  }
  return knowledge;
}

const Material& hose_material_of(const Job& job, const Dresspack& dresspack) {
  return resolved_material(job, dresspack.hose_material);
}

}  // namespace dresslife::pipeline
