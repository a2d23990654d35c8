// Other arm configurations for one pose of the flange: axes 1 to 3 reach the same wrist centre with the elbow or the shoulder on
// the other side, and the wrist gives the flange the same orientation.
//
// Assumption: axes 4, 5, 6 intersect in one point; axis 5 is perpendicular to the others, which coincide at axis 5 = 0. Newton's
// method finds the arm of a wrist centre c(q1, q2, q3) from many starts within the axes' limits. It needs no assumption about
// axes 1 to 3. The sign of det(dc/dq) distinguishes the configurations: it changes if the arm is stretched or the centre crosses
// the axis about which it turns. The wrist follows from R = R_a(q4) R_b(q5) R_a(q6) in closed form.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "pipeline/job/robot.h"

namespace dresslife::pipeline {

/// Returns whether a robot's last three axes are such a wrist.
bool has_wrist(const Robot& robot);

inline constexpr std::array<std::string_view, 4> arm_configurations{"elbow to the other side", "axis 1 turned round",
                                                                    "axis 1 turned round, elbow to the other side",
                                                                    "axis 1 by a whole turn"};

struct OtherArm {
  std::string_view what;       ///< one of arm_configurations
  std::vector<double> joints;  ///< [rad]
};

/// Returns all other arms within the limits of axes 1 to 3 whose wrist has a solution within the limits of axes 4 to 6, with the
/// wrist nearest to `joints` [rad]. Precondition: has_wrist().
std::vector<OtherArm> other_arms(const Robot& robot, const std::vector<double>& joints);

}  // namespace dresslife::pipeline
