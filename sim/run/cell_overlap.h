// Boxes of the cell through which the robot moves: whoever gave them meant another place. Robots are not checked against anything else.
#pragma once

#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/setup.h"

namespace dresslife::sim {

class RobotPath;

/// One warning per box that a link enters by more than 50 mm in 100 moments of the motion, at the deepest of them. The base does not
/// count: it may stand on a box. Of links only capsules count, which are drawn by hand and a few centimetres off.
std::vector<pipeline::Warning> overlaps_with_cell(const pipeline::Setup& setup, const RobotPath& path);

}  // namespace dresslife::sim
