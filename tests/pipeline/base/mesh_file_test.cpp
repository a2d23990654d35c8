// Meshes of all formats, and all their errors.
#include "pipeline/base/mesh_file.h"

#include <cstdint>
#include <fstream>
#include <limits>

#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;
using Vector3 = Eigen::Vector3d;

namespace {

const std::vector<Triangle> two{{Vector3{0, 0, 0}, Vector3{1, 0, 0.5}, Vector3{0, 2, 0}},
                                {Vector3{0, 0, 3}, Vector3{1, -1, 0}, Vector3{0, 2, 0.25}}};

std::string vertices(const char* word, const Triangle& triangle) {
  std::string text;
  for (const Vector3& corner : triangle) text += fmt::format("{} {} {} {}\n", word, corner[0], corner[1], corner[2]);
  return text;
}

std::string binary_of(const std::vector<Triangle>& triangles) {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // some programs begin binary files with this word too
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    for (int k = 0; k < 3; ++k) put(9.0f);  // the normal is not used
    for (const Vector3& corner : triangle)
      for (int k = 0; k < 3; ++k) put(static_cast<float>(corner[k]));
    put(std::uint16_t{7});
  }
  return bytes;
}

std::vector<Triangle> read(const std::string& name, const std::string& text) {
  const Scratch scratch;
  std::ofstream(scratch / name, std::ios::binary) << text;
  return read_triangles(scratch / name);
}

}  // namespace

TEST_CASE("meshes: STL of both kinds and OBJ give the same triangles") {
  std::string ascii = "solid two\n", obj, relative,
              shared = vertices("v", two[0]) + vertices("v", two[1]) + "f 1 2 3\nf 4/1 5//2 6/1/1\n";
  for (const Triangle& triangle : two) {
    ascii += "facet normal 0 0 0\nouter loop\n" + vertices("  vertex", triangle) + "endloop\n endfacet\n";
    relative += vertices("v", triangle) + "f -3 -2/4 -1//1\n";
  }
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.stl", ascii},
                                   {"b.STL", binary_of(two)},
                                   {"c.OBJ", relative},
                                   {"d.obj", shared}}) {
    CAPTURE(name);
    const std::vector<Triangle> triangles = read(name, text);
    REQUIRE(triangles.size() == 2);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t corner = 0; corner < 3; ++corner) CHECK(triangles[k][corner] == two[k][corner]);
  }
  const std::vector<Triangle> quad =
      read("quad.obj", "# four corners\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  REQUIRE(quad.size() == 2);
  CHECK(quad[1][1] == Vector3{1, 1, 0});
  CHECK(quad[1][2] == Vector3{0, 1, 0});
}

TEST_CASE("meshes: what is none is refused with its line") {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", facet = "solid\nfacet\n" + vertices("vertex", two[0]);
  for (const auto& [name, text, words] : std::initializer_list<std::array<std::string, 3>>{
           {"a.obj", three + "f 1 2 4\n", "a.obj:4:1: error: face names vertex 4 of 3"},
           {"a.obj", three + "f 1 2 0\n", "a.obj:4:1: error: face names vertex 0 of 3"},
           {"a.obj", three + "f 1 2 -4\n", "a.obj:4:1: error: face names vertex -4 of 3"},
           {"a.obj", three + "f 1 2\n", "a.obj:4:1: error: face without three corners"},
           {"a.obj", "v 0 0\n", "a.obj:1:1: error: vertex without three numbers"},
           {"a.obj", three, "holds no triangles"},
           {"a.stl", "facet\n", "a.stl:1:1: error: is no STL"},
           {"a.stl", facet + "vertex 0 0 0\nendfacet\n", "a.stl:7:1: error: facet without three vertices"},
           {"a.stl", "solid\nvertex 0 0 0\nvertex 0 0 1\nendfacet\n", "a.stl:4:1: error: facet without three vertices"},
           {"a.stl", "solid\nvertex 0 x 0\n", "a.stl:2:1: error: vertex without three numbers"},
           {"a.stl", binary_of(two).substr(1), "is no STL"},
           {"a.step", facet, "must be .stl or .obj"}}) {
    CAPTURE(words);
    CHECK_THROWS_WITH(read(name, text), Catch::Contains(words));
  }
  std::vector<Triangle> endless = two;
  endless[1][2][0] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(read("a.stl", binary_of(endless)), Catch::Contains("not finite"));
  CHECK_THROWS_WITH(read_triangles("no such file.stl"), Catch::Contains("cannot be read"));
}
