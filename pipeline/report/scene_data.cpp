#include "pipeline/report/scene_data.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "pipeline/report/json.h"
#include "pipeline/report/simple_mesh.h"

namespace dresslife::pipeline {
namespace {

/// 24 characters of the page for a triangle: 0.7 MB for all meshes of a robot together.
constexpr std::size_t most_triangles = 30'000;
/// Between a link's surface and what it carries [m].
constexpr double longest_bracket = 0.15;

std::string pose(const Vector3d& position, const Vector3d& roll_pitch_yaw) {
  const Eigen::Quaterniond turn = from_roll_pitch_yaw(roll_pitch_yaw);
  return fmt::format("\"position\":{},\"quaternion\":{}", json(position),
                     json(std::vector<double>{turn.x(), turn.y(), turn.z(), turn.w()}));
}

std::string mesh_shape(const MeshFile& file, std::size_t most) {
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
  return fmt::format("{{\"kind\":\"mesh\",{},\"low\":{},\"step\":{},\"triangles\":{}}}",
                     pose(file.position, file.orientation), json(steps.low), json(steps.step),
                     base64_of(numbers));
}

class Scene {
 public:
  Scene(const Setup& setup, std::vector<std::string>& notes) : setup_(setup), notes_(notes) {
    for (const Link& link : setup.robot.links) meshes_ += link.meshes.size();
    meshes_ += setup.cell.meshes.size();
  }

  std::string text() {
    std::string links, clamps, rings, points, hoses;
    for (const Link& link : setup_.robot.links)
      add(links, fmt::format("{{\"name\":{},\"shapes\":{}}}", json(link.name), shapes(link)));
    for (std::size_t d = 0; d < setup_.dresspacks.size(); ++d) {
      add_routing(d, clamps, rings);
      add(hoses, fmt::format("{{\"name\":{},\"radius\":{}}}", json(name_among(setup_, d)),
                             json(setup_.dresspacks[d].dresspack.diameter / 2)));
    }
    for (const MountingPoint& point : setup_.robot.mounting_points)
      add(points, fmt::format("{{\"name\":{},{}}}", json(point.name),
                              place(point.link, point.position, point.direction)));
    std::vector<std::string> joints;
    for (const Joint& joint : setup_.robot.joints) joints.push_back(joint.name);
    return fmt::format(
        "{{\"joints\":{},\"links\":[{}],\"cell\":{},\"floor\":{},\"clamps\":[{}],\"rings\":[{}],\"mounting_"
        "points\":[{}],"
        "\"hoses\":[{}],\"bracket\":{}}}",
        json(joints), links, shapes(setup_.cell), setup_.simulation.floor, clamps, rings, points, hoses,
        json(longest_bracket));
  }

 private:
  static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }

  std::string place(const std::string& link, const Vector3d& position, const Vector3d& direction) const {
    const auto& links = setup_.robot.links;
    const auto found =
        std::find_if(links.begin(), links.end(), [&](const Link& one) { return one.name == link; });
    return fmt::format("\"link\":{},\"position\":{},\"direction\":{}", found - links.begin(), json(position),
                       json(Vector3d(direction.normalized())));
  }

  void add_routing(std::size_t dresspack, std::string& clamps, std::string& rings) const {
    const MountedDresspack& mounted = setup_.dresspacks[dresspack];
    const Routing& routing = mounted.routing;
    const std::string before = mounted.name.empty() ? "" : mounted.name + ", ";
    const auto clamp = [&](const std::string& name, const std::string& key, double at, const Clamp& one) {
      add(clamps, fmt::format("{{\"name\":{},\"key\":{},\"dresspack\":{},\"at\":{},\"radius\":{},{}}}", json(before + name),
                              json(key), dresspack, json(at), json(mounted.dresspack.diameter / 2),
                              place(one.link, one.position, one.direction)));
    };
    if (routing.base_clamp) clamp("base clamp", "base_clamp", 0, *routing.base_clamp);
    for (const IntermediateClamp& between : routing.clamps)
      clamp(fmt::format("clamp at {:.2f} m", between.at_length), "clamp", between.at_length, between.clamp);
    if (routing.tool_clamp) clamp("tool clamp", "tool_clamp", routing.free_length, *routing.tool_clamp);
    for (const GuideRing& ring : routing.rings)
      add(rings,
          fmt::format("{{\"name\":{},\"radius\":{},\"width\":{},{}}}", json(before + "ring"),
                      json(ring.radius), json(ring.width), place(ring.link, ring.position, ring.direction)));
  }

  template <class Shapes>
  std::string shapes(const Shapes& of) {
    std::string list;
    for (const Capsule& capsule : of.capsules)
      add(list, fmt::format("{{\"kind\":\"capsule\",\"from\":{},\"to\":{},\"radius\":{}}}",
                            json(capsule.from), json(capsule.to), json(capsule.radius)));
    for (const Box& box : of.boxes)
      add(list, fmt::format("{{\"kind\":\"box\",{},\"sides\":{}}}", pose(box.position, box.orientation),
                            json(box.sides)));
    for (const MeshFile& mesh : of.meshes) {
      try {
        add(list, mesh_shape(mesh, most_triangles / meshes_));
      } catch (const InputError& problem) {
        notes_.push_back(fmt::format("not drawn: {}", problem.what()));
      }
    }
    return '[' + list + ']';
  }

  const Setup& setup_;
  std::vector<std::string>& notes_;
  std::size_t meshes_ = 0;
};

}  // namespace

std::string scene_data(const Setup& setup, std::vector<std::string>& notes) {
  return Scene(setup, notes).text();
}

}  // namespace dresslife::pipeline
