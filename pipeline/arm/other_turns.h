// Different joint angles that move the tool to the same pose.
//
// Precondition: axes 4 and 6 coincide at axis 5 = 0, and axis 5 crosses them at a right angle in one point. Such a wrist reaches
// every pose twice, because R_x(pi) R_y(-b) R_x(pi) = R_y(b), and more often with whole turns of axes 4 and 6:
//     (q4, q5, q6) -> (q4 +- 180 deg, -q5, q6 +- 180 deg)
//     (q4, q5, q6) -> (q4 +- 360 deg, q5, q6)
//     (q4, q5, q6) -> (q4, q5, q6 +- 360 deg)
// Another configuration of axes 1 to 3 (other_arms.h) reaches the pose too.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"

namespace dresslife::pipeline {

/// Replaces a target's joint angles by others [rad]; std::nullopt: there are none within the axes' limits.
struct NamedTurn {
  std::string name;  ///< "axis 6 +360 deg"
  std::function<std::optional<std::vector<double>>(const std::vector<double>&)> turn;
};

/// Returns the turns of wrist and arm described above; empty for another kind of wrist. Precondition: `robot` outlives the
/// result.
std::vector<NamedTurn> other_turns(const Robot& robot);

/// Returns whether joint angles [rad] are within the limits of the robot's axes.
bool within_limits(const Robot& robot, const std::vector<double>& joints);

}  // namespace dresslife::pipeline
