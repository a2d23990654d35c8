// A reduced mesh for a page.
#pragma once

#include <vector>

#include "pipeline/base/mesh_file.h"

namespace dresslife::pipeline {

/// Returns a mesh with at most `most` triangles. Moves all corners in one cube to their mean and drops triangles that collapse or
/// coincide. The edge of the cubes doubles from 1/1000 of the mesh's largest side until few enough triangles are left. No corner
/// moves farther than a cube's diagonal. A mesh with at most `most` triangles is unchanged.
std::vector<Triangle> simplified(const std::vector<Triangle>& mesh, std::size_t most);

}  // namespace dresslife::pipeline
