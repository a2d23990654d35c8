#include "pipeline/base/mesh_file.h"

#include <bit>
#include <cstring>
#include <sstream>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

using Vector3 = Eigen::Vector3d;

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& what) {
  throw InputError({file.string(), line, 1}, what, "export the mesh again, as binary STL");
}

constexpr size_t stl_header = 84, stl_triangle = 50;  // [bytes]
static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

std::vector<Triangle> binary_stl(const std::string& bytes) {
  std::vector<Triangle> triangles((bytes.size() - stl_header) / stl_triangle);
  for (size_t k = 0; k < triangles.size(); ++k) {
    float numbers[9];  // the nine coordinates behind the normal
    std::memcpy(numbers, bytes.data() + stl_header + k * stl_triangle + 12, sizeof(numbers));
    for (int corner = 0; corner < 3; ++corner)
      triangles[k][corner] = {numbers[3 * corner], numbers[3 * corner + 1], numbers[3 * corner + 2]};
  }
  return triangles;
}

bool is_binary_stl(const std::string& bytes) {
  if (bytes.size() < stl_header) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return bytes.size() == stl_header + stl_triangle * count;
}

std::vector<Triangle> ascii_stl(const std::string& text, const std::filesystem::path& file) {
  std::vector<Triangle> triangles;
  std::vector<Vector3> corners;
  std::istringstream lines(text);
  std::string line, word;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    words >> word;
    if (number == 1 && word != "solid")
      fail(file, 1, "is no STL (neither of the right length nor beginning with 'solid')");
    if (word == "vertex") {
      Vector3 corner;
      if (!(words >> corner[0] >> corner[1] >> corner[2])) fail(file, number, "vertex without three numbers");
      corners.push_back(corner);
    } else if (word == "endfacet") {
      if (corners.size() != 3) fail(file, number, "facet without three vertices");
      triangles.push_back({corners[0], corners[1], corners[2]});
      corners.clear();
    }
    word.clear();
  }
  return triangles;
}

// Reads the first number of "7", "7/1", "7//3" or "-1". Negative numbers count from the last vertex.
Vector3 corner_of(const std::string& word, const std::vector<Vector3>& vertices, const std::filesystem::path& file,
                  int line) {
  const int index = std::atoi(word.c_str()), count = static_cast<int>(vertices.size());
  const int place = index < 0 ? count + index : index - 1;
  if (place < 0 || place >= count) fail(file, line, fmt::format("face names vertex {} of {}", word, count));
  return vertices[place];
}

std::vector<Triangle> obj(const std::string& text, const std::filesystem::path& file) {
  std::vector<Triangle> triangles;
  std::vector<Vector3> vertices;
  std::istringstream lines(text);
  std::string line, word;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Vector3 vertex;
      if (!(words >> vertex[0] >> vertex[1] >> vertex[2])) fail(file, number, "vertex without three numbers");
      vertices.push_back(vertex);
    } else if (word == "f") {
      std::vector<Vector3> corners;
      while (words >> word) corners.push_back(corner_of(word, vertices, file, number));
      if (corners.size() < 3) fail(file, number, "face without three corners");
      for (size_t k = 2; k < corners.size(); ++k) triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
    word.clear();
  }
  return triangles;
}

}  // namespace

std::vector<Triangle> read_triangles(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  if (ending != ".stl" && ending != ".obj")
    throw InputError({file.string()}, fmt::format("is a '{}' (a mesh must be .stl or .obj)", ending),
                     "export the mesh as STL");
  const std::string bytes = read_text(file);
  const std::vector<Triangle> triangles = ending == ".obj"       ? obj(bytes, file)
                                          : is_binary_stl(bytes) ? binary_stl(bytes)
                                                                 : ascii_stl(bytes, file);
  if (triangles.empty()) throw InputError({file.string()}, "holds no triangles", "export the mesh again");
  for (const Triangle& triangle : triangles)
    for (const Vector3& corner : triangle)
      if (!corner.allFinite())
        throw InputError({file.string()}, "holds a corner that is not finite", "correct the mesh");
  return triangles;
}

}  // namespace dresslife::pipeline
