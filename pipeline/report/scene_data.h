// Objects of a page's 3D view other than the lines of the dresspacks: robot, cell, clamps, rings, mounting points; as JSON for
// viewer.js.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/setup.h"
#include "pipeline/report/json.h"

namespace dresslife::pipeline {

/// Returns {joints: [name], links: [{name, shapes}], cell: [shape], clamps: [..], rings: [..], mounting_points: [..],
/// hoses: [{name, radius}]}. A shape is a capsule {from, to, radius}, a box {position, quaternion x y z w,
/// sides} or a mesh {position, quaternion, low, step, triangles}, in the frame of its link or of the world. A
/// mesh whose file cannot be read is left out and named in `notes`.
Json scene_data(const Setup& setup, std::vector<std::string>& notes);

}  // namespace dresslife::pipeline
