#include "pipeline/report/simple_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

namespace dresslife::pipeline {
namespace {

using Eigen::Vector3d;
using Cube = std::array<int, 3>;

struct Middle {
  Vector3d sum = Vector3d::Zero();
  int corners = 0;
};

std::vector<Triangle> clustered(const std::vector<Triangle>& mesh, const Vector3d& low, double edge) {
  const auto cube_of = [&](const Vector3d& corner) {
    const Vector3d place = ((corner - low) / edge).array().floor();
    return Cube{static_cast<int>(place.x()), static_cast<int>(place.y()), static_cast<int>(place.z())};
  };
  std::map<Cube, Middle> middles;
  for (const Triangle& triangle : mesh)
    for (const Vector3d& corner : triangle) {
      Middle& middle = middles[cube_of(corner)];
      middle.sum += corner;
      ++middle.corners;
    }
  std::set<std::array<Cube, 3>> seen;
  std::vector<Triangle> left;
  for (const Triangle& triangle : mesh) {
    std::array<Cube, 3> cubes{cube_of(triangle[0]), cube_of(triangle[1]), cube_of(triangle[2])};
    Triangle moved;
    for (std::size_t k = 0; k < 3; ++k) {
      const Middle& middle = middles.at(cubes[k]);
      moved[k] = middle.sum / middle.corners;
    }
    if (cubes[0] == cubes[1] || cubes[1] == cubes[2] || cubes[2] == cubes[0]) continue;
    std::ranges::sort(cubes);
    if (seen.insert(cubes).second) left.push_back(moved);
  }
  return left;
}

}  // namespace

std::vector<Triangle> simplified(const std::vector<Triangle>& mesh, std::size_t most) {
  if (mesh.size() <= most) return mesh;
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : mesh)
    for (const Vector3d& corner : triangle) box.extend(corner);
  double edge = box.sizes().maxCoeff() / 1000;
  if (!(edge > 0)) return {};
  std::vector<Triangle> left = clustered(mesh, box.min(), edge);
  while (left.size() > most) left = clustered(mesh, box.min(), edge *= 2);
  return left;
}

}  // namespace dresslife::pipeline
