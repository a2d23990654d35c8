// A slip in the order, a sign or the unit of joint angles that explains why a motion exceeds the limits of the robot's axes.
#pragma once

#include <string>

namespace dresslife::pipeline {
struct Motion;
struct Robot;
}  // namespace dresslife::pipeline

namespace dresslife::sim {

/// Returns "the angles of joint_2 and joint_3 are exchanged", "the sign of joint_3 is inverted" or "the angles are degrees, read as
/// radians" if after the correction of this slip all joint targets keep the limits of their axes, and all steps with times their
/// speeds. Empty: no slip explains the motion, or several do.
std::string joint_slip(const pipeline::Motion& motion, const pipeline::Robot& robot);

}  // namespace dresslife::sim
