// Joint angles that lead the tool to the same pose.
//
// A wrist whose axes 4 and 6 lie along each other at axis 5 = 0, and whose axis 5 crosses them at a right
// angle in a point, reaches every pose twice, because R_x(pi) R_y(-b) R_x(pi) = R_y(b), and more often by
// whole turns of axes 4 and 6:
//     (q4, q5, q6) -> (q4 +- 180 deg, -q5, q6 +- 180 deg)
//     (q4, q5, q6) -> (q4 +- 360 deg, q5, q6)
//     (q4, q5, q6) -> (q4, q5, q6 +- 360 deg)
// Another configuration of axes 1 to 3 (other_arms.h) reaches it, too.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"

namespace dresslife::pipeline {

/// Other joint angles for those of a target [rad]; absent: there are none within the axes' limits.
struct NamedTurn {
  std::string name;  ///< "axis 6 +360 deg"
  std::function<std::optional<std::vector<double>>(const std::vector<double>&)> turn;
};

/// The turns of wrist and arm above, of a robot that must outlive them; empty: its wrist is another.
std::vector<NamedTurn> other_turns(const Robot& robot);

/// Whether joint angles [rad] lie within the limits of the robot's axes.
bool within_limits(const Robot& robot, const std::vector<double>& joints);

}  // namespace dresslife::pipeline
