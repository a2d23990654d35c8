// A motion for a robot without a program: from a home pose through the usual range of a wrist.
#pragma once

#include <vector>

#include "pipeline/job/motion.h"

namespace dresslife::sim {

/// Returns the angles of the driven joints [rad], within their limits, at which the upper arm is vertical and the forearm is
/// horizontal and points forward, as makers draw a robot; found on a grid of 5 deg. Other joints: 0, or the limit
/// nearest to it.
std::vector<double> home_pose(const pipeline::Robot& robot);

/// Returns moves around the home pose, at half speed and back again: axes 1 to 3 by 15 to 30 deg, the last three
/// by 45, 45 and 60 deg, as far as limits allow; one by one and together.
pipeline::Motion exercise(const pipeline::Robot& robot);

}  // namespace dresslife::sim
