#include "sim/robot/joint_slip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "pipeline/job/motion.h"
#include "sim/robot/robot.h"

namespace dresslife::sim {
namespace {

constexpr double rounding = 1e-6, speed_rounding = 1.01;  // [rad] and ratio: rounded angles and times of recordings

struct JointTarget {
  std::vector<double> joints;
  double duration = 0;  // of the step that leads to it [s]; 0: not given
};

void add_targets(const std::vector<pipeline::MotionStep>& steps, std::vector<JointTarget>& targets) {
  for (const pipeline::MotionStep& step : steps) {
    add_targets(step.steps, targets);
    if (!step.joints.empty()) targets.push_back({step.joints, step.duration.value_or(0)});
  }
}

using Correction = std::function<void(std::vector<double>&)>;

bool keeps_limits(const std::vector<JointTarget>& targets, const std::vector<Axis>& axes, const Correction& correct) {
  std::vector<double> before;
  for (const JointTarget& target : targets) {
    std::vector<double> joints = target.joints;
    correct(joints);
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (joints[k] < axes[k].lower - rounding || joints[k] > axes[k].upper + rounding) return false;
      if (!before.empty() && target.duration > 0 &&
          std::abs(joints[k] - before[k]) > speed_rounding * axes[k].speed * target.duration)
        return false;
    }
    before = std::move(joints);
  }
  return true;
}

}  // namespace

std::string joint_slip(const pipeline::Motion& motion, const pipeline::Robot& robot) {
  constexpr double turns = 4 * std::numbers::pi;  // no axis of a catalogue turns so far from its zero
  std::vector<JointTarget> targets;
  add_targets(motion.steps, targets);
  const std::vector<Axis> axes = axes_of(robot);
  double farthest = 0;
  for (const JointTarget& target : targets) {
    if (target.joints.size() != robot.axes()) return "";
    for (const double angle : target.joints) farthest = std::max(farthest, std::abs(angle));
  }
  std::vector<std::string> found;
  const auto try_one = [&](const std::string& words, const Correction& correct) {
    if (found.size() < 2 && keeps_limits(targets, axes, correct)) found.push_back(words);
  };
  for (std::size_t i = 0; i < robot.axes(); ++i) {
    if (!axes[i].turns) continue;
    try_one(fmt::format("the sign of {} is inverted", axes[i].name), [i](auto& joints) { joints[i] = -joints[i]; });
    for (std::size_t k = i + 1; k < robot.axes(); ++k)
      if (axes[k].turns)
        try_one(fmt::format("the angles of {} and {} are exchanged", axes[i].name, axes[k].name),
                [i, k](auto& joints) { std::swap(joints[i], joints[k]); });
  }
  // Of a program that has radians elsewhere, only the targets that turn too far are degrees.
  for (const double least : {0.0, turns})
    if (farthest > turns && found.empty())
      try_one(motion.steps.front().where.file.ends_with("script")
                  ? fmt::format("the angles are degrees, read as radians (write d2r({0:g}) for {0:g})", farthest)
                  : "the angles are degrees, read as radians",
              [least](auto& joints) {
                if (std::ranges::any_of(joints, [&](double angle) { return std::abs(angle) > least; }))
                  for (double& angle : joints) angle *= std::numbers::pi / 180;
              });
  return found.size() == 1 ? found.front() : "";
}

}  // namespace dresslife::sim
