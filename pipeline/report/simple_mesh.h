// A mesh made small enough for a page.
#pragma once

#include <vector>

#include "pipeline/base/mesh_file.h"

namespace dresslife::pipeline {

/// Corners moved to the middle of those that share a cube with them; triangles that collapse or coincide then
/// are dropped. The cubes' edge doubles from 1/1000 of the mesh's largest side until at most `most` triangles
/// are left; no corner moves farther than their diagonal. A mesh with no more triangles stays as it is.
std::vector<Triangle> simplified(const std::vector<Triangle>& mesh, std::size_t most);

}  // namespace dresslife::pipeline
