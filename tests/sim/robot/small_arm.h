// An arm of six axes small enough to reason about: 1 m and 1 m on a column of 1 m, whose tool points forward
// at zero.
#pragma once

#include <numbers>
#include <string>

#include "pipeline/job/robot.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Speeds and accelerations are the caller's.
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
