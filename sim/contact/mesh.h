// Triangle meshes as obstacles: contacts of a piece of hose.
//
// A piece of hose is the axis of a capsule. Contacts are the local minima of the distance between the axis and the surface: for
// each triangle the nearest pair of points q (axis) and m (mesh), if no other triangle that contains m is nearer to q. So edges
// inside a flat face and the far sides of corners give no contact. Distances have no sign; neither the orientation of the
// triangles nor a closed surface is needed, as long as the axis is outside (overlap less than a radius). An axis that crosses the
// surface counts as one diameter deep.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/base/mesh_file.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

using pipeline::read_triangles;
using pipeline::Triangle;

/// Nearest points of an axis and a triangle.
struct NearestToTriangle {
  Vector3 on_axis, on_triangle;
  double distance = 0;  ///< 0: axis and triangle cross
};
Vector3 nearest_point(const Triangle& triangle, const Vector3& point);
NearestToTriangle nearest_points(const Triangle& triangle, const Vector3& from, const Vector3& to);

/// Returns the triangles of a file in metres. scale: metres per unit of the file. Errors: InputError of read_triangles(), and for
/// a mesh that is longer than a cell, which means that its unit is different.
std::vector<Triangle> scaled_triangles(const std::filesystem::path& file, double scale);

class Mesh {
 public:
  /// Precondition: at least one triangle. Triangles without area are dropped, unless all are without area.
  explicit Mesh(std::vector<Triangle> triangles);

  struct MeshContact {
    Vector3 on_axis, on_mesh;
    Vector3 normal;       ///< unit, from the mesh to the axis
    double distance = 0;  ///< 0: the axis crosses the surface
  };
  /// Returns the local minima of the distance between the piece from..to and the mesh, up to `reach`, nearest first, in the
  /// mesh's own frame. Costs O(log triangles) if few are near.
  std::vector<MeshContact> near(const Vector3& from, const Vector3& to, double reach) const;

  /// Returns whether a point is inside a closed mesh: the rays along the axes, in both senses, all cross the surface an odd number
  /// of times.
  bool contains(const Vector3& point) const;

  double radius() const { return radius_; }  ///< of the ball about the origin that contains the mesh [m]
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  using Box = Eigen::AlignedBox3d;
  struct Node {
    Box box;
    int first = 0, last = 0;  ///< triangles of a leaf
    int second_child = 0;     ///< 0: a leaf; the first child directly follows its parent
  };
  void build(int first, int last);
  void gather(const Box& box, std::vector<int>& hits) const;
  void add_candidates(const Vector3& from, const Vector3& to, double reach, const std::vector<int>& hits,
                      std::vector<MeshContact>& found) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  double radius_ = 0;
};

}  // namespace dresslife::sim
