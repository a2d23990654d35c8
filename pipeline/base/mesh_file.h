// Reads triangle meshes: STL (binary, ASCII) and OBJ (v, f). Both formats are lists of triangles. The library Assimp would read
// both and forty more, but it is larger than this project.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace dresslife::pipeline {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Returns the triangles of an .stl or .obj file, in its units. Faces of more than three corners are divided into triangle fans.
/// Errors: InputError with the file, for OBJ and ASCII STL also with the line.
std::vector<Triangle> read_triangles(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
