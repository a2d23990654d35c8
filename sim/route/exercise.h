// A motion for a robot whose program is not written yet: from a home pose to the ends of what a wrist usually
// does.
#pragma once

#include <vector>

#include "pipeline/job/motion.h"

namespace dresslife::sim {

/// Angles of the driven joints [rad] within their limits at which the upper arm stands and the forearm lies
/// level and points forward, as makers draw a robot; found on a grid of 5 deg. Other joints: 0, or the limit
/// next to it.
std::vector<double> home_pose(const pipeline::Robot& robot);

/// Moves about the home pose, at half speed and back again: the body's axes by 15 to 30 deg, the last three
/// by 45, 45 and 60, as far as limits allow; alone and together.
pipeline::Motion exercise(const pipeline::Robot& robot);

}  // namespace dresslife::sim
