// The same pose of the flange by another configuration of the arm: axes 1 to 3 reach the same wrist centre from the
// other side of the elbow or the shoulder, and the wrist gives the flange the same orientation.
//
// Assumption: axes 4, 5, 6 intersect in one point; axis 5 is at right angles to the others, which coincide at axis 5
// = 0. Newton's method finds the wrist centre c(q1, q2, q3) from many starts within the axes' limits. It needs no
// assumption about axes 1 to 3. The sign of det(dc/dq) distinguishes the sides: it changes where the arm is stretched
// or the centre crosses the axis about which it turns. The wrist follows from R = R_a(q4) R_b(q5) R_a(q6) in closed
// form.
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
