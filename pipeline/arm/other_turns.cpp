#include "pipeline/arm/other_turns.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/arm/other_arms.h"
#include "pipeline/base/constants.h"

namespace dresslife::pipeline {
namespace {

std::vector<NamedTurn> turns_of_wrist(const Robot& robot) {
  std::vector<NamedTurn> turns;
  const auto add = [&](std::string name, double four, bool flipped, double six) {
    turns.push_back({std::move(name), [=, &robot](std::vector<double> joints) {
                       joints[3] += four * degree;
                       joints[4] *= flipped ? -1 : 1;
                       joints[5] += six * degree;
                       return within_limits(robot, joints) ? std::optional(joints) : std::nullopt;
                     }});
  };
  for (const double four : {-180.0, 180.0})
    for (const double six : {-180.0, 180.0})
      add(fmt::format("wrist over: axis 4 {:+.0f}, axis 6 {:+.0f} deg, axis 5 to the other side", four, six), four,
          true, six);
  for (const double turn : {-360.0, 360.0}) add(fmt::format("axis 6 {:+.0f} deg", turn), 0, false, turn);
  for (const double turn : {-360.0, 360.0}) add(fmt::format("axis 4 {:+.0f} deg", turn), turn, false, 0);
  return turns;
}

std::vector<NamedTurn> configurations_of_arm(const Robot& robot) {
  std::vector<NamedTurn> turns;
  for (const std::string_view name : arm_configurations)
    turns.push_back({fmt::format("other arm: {}", name), [&robot, name](const std::vector<double>& joints) {
                       const std::vector<OtherArm> arms = other_arms(robot, joints);
                       const auto is_it = [&](const OtherArm& arm) { return arm.what == name; };
                       const auto found = std::ranges::find_if(arms, is_it);
                       return found == arms.end() ? std::nullopt : std::optional(found->joints);
                     }});
  return turns;
}

}  // namespace

bool within_limits(const Robot& robot, const std::vector<double>& joints) {
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (joints[k] < robot.joints[k].lower || joints[k] > robot.joints[k].upper) return false;
  return true;
}

std::vector<NamedTurn> other_turns(const Robot& robot) {
  if (!has_wrist(robot)) return {};
  std::vector<NamedTurn> turns = turns_of_wrist(robot);
  for (NamedTurn& turn : configurations_of_arm(robot)) turns.push_back(std::move(turn));
  return turns;
}

}  // namespace dresslife::pipeline
