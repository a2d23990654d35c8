#include "sim/contact/mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

#include "pipeline/base/errors.h"
#include "sim/contact/self_contact.h"

namespace dresslife::sim {
namespace {

constexpr int leaf_size = 4;
constexpr double rounding = 1e-9;        // of coordinates in metres [m]
constexpr double same_direction = 0.99;  // cosine; contacts with nearer directions and places are merged
constexpr double same_place = 0.125;     // share of the axis

Vector3 normal_of(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

bool crosses(const Triangle& t, const Vector3& from, const Vector3& to, Vector3& where) {
  const Vector3 n = normal_of(t);
  const double above = n.dot(from - t[0]), below = n.dot(to - t[0]);
  if (above * below > 0 || above == below) return false;
  where = from + (above / (above - below)) * (to - from);
  for (int k = 0; k < 3; ++k)
    if (n.dot((t[(k + 1) % 3] - t[k]).cross(where - t[k])) < 0) return false;
  return true;
}

}  // namespace

// Returns the projection on the plane if it is inside the triangle, else the nearest of the nearest points of the three edges.
Vector3 nearest_point(const Triangle& t, const Vector3& point) {
  const Vector3 n = normal_of(t);
  bool inside = n.squaredNorm() > 0;
  Vector3 best = t[0];
  double least = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Vector3 edge = t[(k + 1) % 3] - t[k], way = point - t[k];
    if (n.dot(edge.cross(way)) < 0) inside = false;
    const double length2 = edge.squaredNorm();
    const double share = length2 > 0 ? std::clamp(edge.dot(way) / length2, 0.0, 1.0) : 0;
    const Vector3 on_edge = t[k] + share * edge;
    const double distance2 = (point - on_edge).squaredNorm();
    if (distance2 < least) least = distance2, best = on_edge;
  }
  return inside ? Vector3(point - (n.dot(point - t[0]) / n.squaredNorm()) * n) : best;
}

// The nearest pair includes an end of the axis or a point on an edge of the triangle, or axis and triangle cross.
NearestToTriangle nearest_points(const Triangle& t, const Vector3& from, const Vector3& to) {
  Vector3 where;
  if (crosses(t, from, to, where)) return {where, where, 0};
  NearestToTriangle best;
  best.distance = INFINITY;
  const auto take = [&](const Vector3& on_axis, const Vector3& on_triangle) {
    const double distance = (on_axis - on_triangle).norm();
    if (distance < best.distance) best = {on_axis, on_triangle, distance};
  };
  for (const Vector3& end : {from, to}) take(end, nearest_point(t, end));
  for (int k = 0; k < 3; ++k) {
    const Vector3 &a = t[k], &b = t[(k + 1) % 3];
    const NearestPoints nearest = nearest_points(from, to, a, b);
    take(from + nearest.a * (to - from), a + nearest.b * (b - a));
  }
  return best;
}

// ---- the tree of boxes ------------------------------------------------------------------------------------

std::vector<Triangle> scaled_triangles(const std::filesystem::path& file, double scale) {
  constexpr double longest = 30;  // [m]: a cell with its fences
  std::vector<Triangle> triangles = read_triangles(file);
  Eigen::AlignedBox3d box;
  for (Triangle& triangle : triangles)
    for (Vector3& corner : triangle) box.extend(corner *= scale);
  if (!triangles.empty() && box.sizes().maxCoeff() > longest)
    throw pipeline::InputError(
        {file.string()},
        fmt::format("the mesh is {:.4g} m long with scale {:g} (limit {:g} m)", box.sizes().maxCoeff(), scale, longest),
        fmt::format("give the mesh scale: {:g} if its unit is the millimetre (in a URDF scale=\"{:g} {:g} {:g}\")",
                    scale / 1e3, scale / 1e3, scale / 1e3, scale / 1e3));
  return triangles;
}

Mesh::Mesh(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  assert(!triangles_.empty());
  const auto flat = std::stable_partition(triangles_.begin(), triangles_.end(),
                                          [](const Triangle& t) { return normal_of(t).squaredNorm() > 0; });
  if (flat != triangles_.begin()) triangles_.erase(flat, triangles_.end());
  for (const Triangle& t : triangles_)
    for (const Vector3& corner : t) radius_ = std::max(radius_, corner.norm());
  build(0, static_cast<int>(triangles_.size()));
}

void Mesh::build(int first, int last) {
  const size_t index = nodes_.size();
  Node node;
  node.first = first, node.last = last;
  for (int k = first; k < last; ++k)
    for (const Vector3& corner : triangles_[k]) node.box.extend(corner);
  nodes_.push_back(node);
  if (last - first <= leaf_size) return;
  int axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  const auto place = [axis](const Triangle& t) { return t[0][axis] + t[1][axis] + t[2][axis]; };
  std::nth_element(triangles_.begin() + first, triangles_.begin() + middle, triangles_.begin() + last,
                   [&](const Triangle& a, const Triangle& b) { return place(a) < place(b); });
  build(first, middle);
  nodes_[index].second_child = static_cast<int>(nodes_.size());
  build(middle, last);
}

void Mesh::gather(const Box& box, std::vector<int>& hits) const {
  std::vector<int> open{0};
  while (!open.empty()) {
    const int index = open.back();
    const Node& node = nodes_[index];
    open.pop_back();
    if (!node.box.intersects(box)) continue;
    if (node.second_child == 0) {
      for (int k = node.first; k < node.last; ++k) hits.push_back(k);
    } else {
      open.push_back(node.second_child);
      open.push_back(index + 1);
    }
  }
}

// A projected edge counts at its lower end, but not at its upper one, and has the same sense in both of its triangles: a ray through
// an edge or a corner crosses one of the triangles there.
bool Mesh::contains(const Vector3& point) const {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> hits;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Box line(point, point);
    line.min()[axis] = -INFINITY, line.max()[axis] = INFINITY;
    gather(line, hits);
    bool above = false, below = false;  // odd numbers of crossings
    for (const int hit : hits) {
      const Triangle& t = triangles_[hit];
      bool crossed = false;
      for (int k = 0; k < 3; ++k) {
        const Vector3 *low = &t[k], *high = &t[(k + 1) % 3];
        if (((*low)[v] > point[v]) == ((*high)[v] > point[v])) continue;
        if ((*low)[v] > (*high)[v]) std::swap(low, high);
        const double share = (point[v] - (*low)[v]) / ((*high)[v] - (*low)[v]);
        if (point[u] < (*low)[u] + share * ((*high)[u] - (*low)[u])) crossed = !crossed;
      }
      if (!crossed) continue;
      const Vector3 normal = normal_of(t);
      bool& side = normal.dot(t[0] - point) * normal[axis] > 0 ? above : below;
      side = !side;
    }
    if (!above || !below) return false;
  }
  return true;
}

void Mesh::add_candidates(const Vector3& from, const Vector3& to, double reach, const std::vector<int>& hits,
                          std::vector<MeshContact>& found) const {
  for (const int k : hits) {
    const Triangle& triangle = triangles_[k];
    const NearestToTriangle nearest = nearest_points(triangle, from, to);
    if (nearest.distance > reach) continue;
    const bool nearer = std::any_of(hits.begin(), hits.end(), [&](int other) {
      const Triangle& t = triangles_[other];
      return other != k && (nearest_point(t, nearest.on_triangle) - nearest.on_triangle).norm() < rounding &&
             (nearest_point(t, nearest.on_axis) - nearest.on_axis).norm() < nearest.distance - rounding;
    });
    if (nearer) continue;
    const Vector3 way = nearest.on_axis - nearest.on_triangle;
    const Vector3 normal =
        nearest.distance > rounding ? Vector3(way / nearest.distance) : normal_of(triangle).normalized();
    found.push_back({nearest.on_axis, nearest.on_triangle, normal, nearest.distance});
  }
}

// Tests the whole piece and its two ends, because a piece along a face rests on both ends.
std::vector<Mesh::MeshContact> Mesh::near(const Vector3& from, const Vector3& to, double reach) const {
  Box box(from);
  box.extend(to);
  const Vector3 around = Vector3::Constant(reach);
  std::vector<int> hits;
  gather(Box(box.min() - around, box.max() + around), hits);
  std::vector<MeshContact> found, kept;
  if (hits.empty()) return kept;
  add_candidates(from, to, reach, hits, found);
  for (const Vector3& end : {from, to}) add_candidates(end, end, reach, hits, found);
  std::stable_sort(found.begin(), found.end(),
                   [](const MeshContact& a, const MeshContact& b) { return a.distance < b.distance; });
  const double apart = same_place * (to - from).norm();
  for (const MeshContact& touching : found)
    if (std::none_of(kept.begin(), kept.end(), [&](const MeshContact& other) {
          return (other.on_axis - touching.on_axis).norm() <= apart &&
                 other.normal.dot(touching.normal) > same_direction;
        }))
      kept.push_back(touching);
  return kept;
}

}  // namespace dresslife::sim
