#include "pipeline/report/scene_data.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "pipeline/base/lists.h"
#include "pipeline/report/json.h"
#include "pipeline/report/simple_mesh.h"

namespace dresslife::pipeline {
namespace {

/// A triangle takes 24 characters of the page: 0.7 MB for all meshes of a robot together.
constexpr std::size_t most_triangles = 30'000;

Json pose(const Vector3d& position, const Vector3d& roll_pitch_yaw) {
  const Eigen::Quaterniond turn = from_roll_pitch_yaw(roll_pitch_yaw);
  return {{"position", position}, {"quaternion", std::vector<double>{turn.x(), turn.y(), turn.z(), turn.w()}}};
}

Json mesh_shape(const MeshFile& file, std::size_t most) {
  const std::vector<Triangle> mesh = simplified(read_triangles(file.file), most);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Triangle& triangle : mesh)
    for (const Vector3d& corner : triangle) {
      low = std::min(low, file.scale * corner.minCoeff());
      high = std::max(high, file.scale * corner.maxCoeff());
    }
  const Steps steps(low, high);
  std::vector<std::uint16_t> numbers;
  for (const Triangle& triangle : mesh)
    for (const Vector3d& corner : triangle)
      for (const double x : corner) numbers.push_back(steps.of(file.scale * x));
  return Json{{"kind", "mesh"}}
      .add(pose(file.position, file.orientation))
      .add({{"low", steps.low}, {"step", steps.step}, {"triangles", base64_of(numbers)}});
}

class Scene {
 public:
  Scene(const Setup& setup, std::vector<std::string>& notes) : setup_(setup), notes_(notes) {
    for (const Link& link : setup.robot.links) meshes_ += link.meshes.size();
    meshes_ += surroundings(setup).meshes.size();
  }

  Json json() {
    std::vector<Json> links, clamps, rings, points, hoses;
    for (const Link& link : setup_.robot.links) links.push_back({{"name", link.name}, {"shapes", shapes(link)}});
    for (std::size_t d = 0; d < setup_.dresspacks.size(); ++d) {
      const MountedDresspack& mounted = setup_.dresspacks[d];
      add_routing(d, clamps, rings);
      hoses.push_back({{"name", name_among(setup_, d)}, {"radius", mounted.dresspack.diameter / 2}});
    }
    for (const MountingPoint& point : setup_.robot.mounting_points)
      points.push_back(Json{{"name", point.name}}.add(place(point.link, point.position, point.direction)));
    return {{"joints", setup_.robot.axis_names()}, {"links", links},   {"cell", shapes(surroundings(setup_))},
            {"floor", setup_.simulation.floor},    {"clamps", clamps}, {"rings", rings},
            {"mounting_points", points},           {"hoses", hoses}};
  }

 private:
  Json place(const std::string& link, const Vector3d& position, const Vector3d& direction) const {
    const auto& links = setup_.robot.links;
    return {{"link", std::ranges::find(links, link, &Link::name) - links.begin()},
            {"position", position},
            {"direction", Vector3d(direction.normalized())}};
  }

  void add_routing(std::size_t dresspack, std::vector<Json>& clamps, std::vector<Json>& rings) const {
    const MountedDresspack& mounted = setup_.dresspacks[dresspack];
    const Routing& routing = mounted.routing;
    const std::string before = mounted.name.empty() ? "" : mounted.name + ", ";
    const auto clamp = [&](const std::string& name, const std::string& key, double at, const Clamp& one) {
      clamps.push_back(Json{{"name", before + name},
                            {"key", key},
                            {"dresspack", dresspack},
                            {"at", at},
                            {"most_bracket", longest_bracket_of(routing)},
                            {"radius", mounted.dresspack.diameter / 2}}
                           .add(place(one.link, one.position, one.direction)));
    };
    if (routing.base_clamp) clamp("base clamp", "base_clamp", 0, *routing.base_clamp);
    for (const IntermediateClamp& between : routing.clamps)
      clamp(fmt::format("clamp at {:.2f} m", between.at_length), "clamp", between.at_length, between.clamp);
    if (routing.tool_clamp) clamp("tool clamp", "tool_clamp", routing.free_length, *routing.tool_clamp);
    for (const GuideRing& ring : routing.rings)
      rings.push_back(Json{
          {"name", before + "ring"},
          {"most_bracket", longest_bracket_of(routing)},
          {"radius", ring.radius},
          {"width",
           ring.width}}.add(place(ring.link, ring.position, ring.direction)));
  }

  template <class Shapes>
  std::vector<Json> shapes(const Shapes& of) {
    std::vector<Json> list;
    for (const Capsule& capsule : of.capsules)
      list.push_back({{"kind", "capsule"}, {"from", capsule.from}, {"to", capsule.to}, {"radius", capsule.radius}});
    for (const Box& box : of.boxes)
      list.push_back(Json{{"kind", "box"}}.add(pose(box.position, box.orientation)).add("sides", box.sides));
    for (const MeshFile& mesh : of.meshes) {
      try {
        list.push_back(mesh_shape(mesh, most_triangles / meshes_));
      } catch (const InputError& problem) {
        notes_.push_back(fmt::format("not drawn: {}", problem.what()));
      }
    }
    return list;
  }

  const Setup& setup_;
  std::vector<std::string>& notes_;
  std::size_t meshes_ = 0;
};

}  // namespace

Json scene_data(const Setup& setup, std::vector<std::string>& notes) { return Scene(setup, notes).json(); }

}  // namespace dresslife::pipeline
