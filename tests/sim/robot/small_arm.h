// A six-axis arm that is simple enough for calculation by hand: a column of 1 m and two links of 1 m. At zero the tool points
// forward.
#pragma once

#include <numbers>
#include <string>

#include "pipeline/job/robot.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Returns the arm. The caller sets speeds and accelerations.
inline pipeline::Robot small_arm() {
  pipeline::Robot robot;
  robot.name = "test arm";
  const Vector3 origins[] = {{0, 0, 1}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const Vector3 axes[] = {Vector3::UnitZ(), Vector3::UnitY(), Vector3::UnitY(),
                          Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitX()};
  for (int i = 0; i < 6; ++i) {
    pipeline::Joint& joint = robot.joints.emplace_back();
    joint.name = "axis_" + std::to_string(i + 1);
    joint.origin = origins[i];
    joint.axis = axes[i];
    joint.lower = -3;
    joint.upper = 3;
  }
  robot.links.resize(7);
  robot.flange_orientation = {0, std::numbers::pi / 2, 0};
  return robot;
}

}  // namespace dresslife::sim
