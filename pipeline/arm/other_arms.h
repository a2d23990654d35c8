// The same pose of the flange by another configuration of the arm: axes 1 to 3 put the wrist's centre where
// it was from the other side of the elbow or the shoulder, and the wrist turns the flange as it was.
//
// For a robot whose axes 4, 5, 6 cross in one point, axis 5 at right angles to the others, which lie along
// each other at axis 5 = 0. The centre c(q1, q2, q3) is found by Newton's method from many places within the
// axes' limits, which asks nothing of how the arm is built; sides are told by the sign of det(dc/dq), which
// changes where the arm is stretched or the centre passes the axis that it turns about. The wrist follows
// from R = R_a(q4) R_b(q5) R_a(q6) in closed form.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "pipeline/job/robot.h"

namespace dresslife::pipeline {

/// Whether a robot's last three axes are such a wrist.
bool has_wrist(const Robot& robot);

inline constexpr std::array<std::string_view, 4> arm_configurations{
    "elbow to the other side", "axis 1 turned round", "axis 1 turned round, elbow to the other side",
    "axis 1 by a whole turn"};

struct OtherArm {
  std::string_view what;       ///< one of them
  std::vector<double> joints;  ///< [rad]
};

/// All within the limits of axes 1 to 3 whose wrist has a turn within those of axes 4 to 6; that which is
/// next to `joints` [rad]. Precondition: has_wrist().
std::vector<OtherArm> other_arms(const Robot& robot, const std::vector<double>& joints);

}  // namespace dresslife::pipeline
