// Triangle meshes from files. The two formats are read here: STL (binary, ASCII) and OBJ (v, f) are a list of
// triangles each. Assimp would read both, and forty more, for a dependency larger than the whole project.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace dresslife::pipeline {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// Triangles of an .stl or .obj file, in its units. Faces of more corners are cut into fans. Errors:
/// InputError that names the file, for OBJ and ASCII STL also the line.
std::vector<Triangle> read_triangles(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
