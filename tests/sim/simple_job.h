// A job simple enough for calculation by hand: one axis along x turns the tool clamp, and the hose lies along this axis.
#pragma once

#include "pipeline/job/job.h"

namespace dresslife::sim {

inline pipeline::MotionStep move_to(double angle, const std::string& text = "") {
  pipeline::MotionStep step;
  step.joints = {angle};
  step.text = text;
  return step;
}

inline pipeline::MotionStep dwell_for(double seconds) {
  pipeline::MotionStep step;
  step.dwell = seconds;
  return step;
}

/// Returns the job. Base clamp at x = 0, tool clamp at x = 0.9 on the turning link, both 1 m above the floor, pointing along x.
/// 1 m of hose hangs between them and sags.
inline pipeline::Job simple_job() {
  pipeline::Job job;
  pipeline::Joint joint;
  joint.name = "spindle";
  joint.axis = {1, 0, 0};
  joint.lower = -20;
  joint.upper = 20;
  joint.speed = 3;
  joint.acceleration = 6;
  job.robot.name = "spindle";
  job.robot.joints = {joint};
  job.robot.links = {{"bench", {}}, {"spindle", {}}};
  job.motion.name = "turn";
  job.motion.steps = {move_to(0, "start"), move_to(2, "turn"), dwell_for(0.5), move_to(0, "back")};
  job.dresspacks[0].dresspack.diameter = 0.04;
  job.dresspacks[0].dresspack.mass_per_length = 1.5;
  job.dresspacks[0].dresspack.bending_stiffness = 2;
  job.dresspacks[0].dresspack.torsional_stiffness = 1.6;
  job.dresspacks[0].dresspack.axial_stiffness = 1e5;
  job.dresspacks[0].dresspack.damping_time = 0.01;
  job.dresspacks[0].dresspack.friction = 0.3;
  job.dresspacks[0].routing.free_length = 1;
  job.dresspacks[0].routing.base_clamp = pipeline::Clamp{"bench", {0, 0, 1}, {1, 0, 0}, {}, {"job.yaml", 9, 3}};
  job.dresspacks[0].routing.tool_clamp = pipeline::Clamp{"spindle", {0.9, 0, 1}, {1, 0, 0}, {}, {"job.yaml", 10, 3}};
  // The axis passes through both clamps, so its rotation only twists the hose.
  job.robot.joints[0].origin = {0, 0, 1};
  job.dresspacks[0].routing.tool_clamp->position = {0.9, 0, 0};
  job.dresspacks[0].routing.where = {"job.yaml", 8, 3};
  job.simulation.segments = 20;
  return job;
}

}  // namespace dresslife::sim
