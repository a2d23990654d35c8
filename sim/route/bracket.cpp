#include "sim/route/bracket.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "pipeline/job/line_key.h"
#include "sim/contact/mesh.h"
#include "sim/route/screening.h"
#include "sim/run/checks.h"

namespace dresslife::sim {
namespace {

constexpr double far_away = 1;  // [m], larger than any bracket: distances beyond it are not computed exactly
constexpr double clear = 0.3;   // [m] from a neighbour; the cost of meshes grows with this distance

struct PlacedMesh {
  Mesh mesh;
  Frame frame;
};

/// Shapes of a link or of the cell.
struct Solid {
  std::vector<pipeline::Capsule> capsules;
  std::vector<pipeline::Box> boxes;
  std::vector<PlacedMesh> meshes;

  bool empty() const { return capsules.empty() && boxes.empty() && meshes.empty(); }
  double distance(const Vector3& point, double most) const {
    double nearest = std::min(most, pipeline::distance_from(capsules, boxes, point));
    for (const PlacedMesh& placed : meshes) {
      const Vector3 local = placed.frame.orientation.conjugate() * (point - placed.frame.position);
      if (local.norm() - placed.mesh.radius() > nearest) continue;
      if (placed.mesh.contains(local)) {
        double depth = std::numeric_limits<double>::infinity();
        for (const Triangle& triangle : placed.mesh.triangles())
          depth = std::min(depth, (nearest_point(triangle, local) - local).norm());
        nearest = std::min(nearest, -depth);
        continue;
      }
      const auto found = placed.mesh.near(local, local, std::max(nearest, 0.0));
      if (!found.empty()) nearest = std::min(nearest, found.front().distance);
    }
    return nearest;
  }
};

template <class Shapes>
Solid solid_of(const Shapes& shapes) {
  Solid solid{shapes.capsules, shapes.boxes, {}};
  for (const pipeline::MeshFile& file : shapes.meshes) {
    if (std::vector<Triangle> triangles = scaled_triangles(file.file, file.scale); !triangles.empty())
      solid.meshes.push_back(
          {Mesh(std::move(triangles)), {file.position, pipeline::from_roll_pitch_yaw(file.orientation)}});
  }
  return solid;
}

}  // namespace

struct Surfaces::Parts {
  std::vector<Solid> links;
  Solid cell;
};

Surfaces::Surfaces(const pipeline::Setup& setup) : parts_(std::make_unique<Parts>()) {
  for (const pipeline::Link& link : setup.robot.links) parts_->links.push_back(solid_of(link));
  if (!parts_->links.empty() && parts_->links.back().empty())
    parts_->links.back().capsules = {{setup.robot.flange_position, setup.robot.flange_position, 0}};
  parts_->cell = solid_of(surroundings(setup));
}

Surfaces::~Surfaces() = default;

double Surfaces::of_link(int link, const Vector3& point, double most) const {
  return parts_->links[static_cast<std::size_t>(link)].distance(point, most);
}
double Surfaces::of_cell(const Vector3& point, double most) const { return parts_->cell.distance(point, most); }
bool Surfaces::has_shapes(int link) const { return !parts_->links[static_cast<std::size_t>(link)].empty(); }

double BracketFit::beyond(double most_length, double diameter) const {
  return std::max({length - most_length, -clearance, unbuildable}) / diameter;
}

double way_out(const Surfaces& surfaces, int link, const Vector3& position, const Vector3& out, double diameter) {
  const Vector3 point = position + diameter * out.normalized();
  return std::max(0.0, diameter - 2 * surfaces.of_link(link, point, diameter)) / (diameter * diameter);
}

std::vector<WayOut> ways_out(const pipeline::Setup& setup, const Surfaces& surfaces) {
  std::vector<WayOut> all;
  if (!setup.simulation.contact) return all;
  for (std::size_t d = 0; d < setup.dresspacks.size(); ++d) {
    const double diameter = setup.dresspacks[d].dresspack.diameter;
    const auto see = [&](const pipeline::Clamp& clamp, const std::string& name, double sense) {
      const auto of = std::ranges::find(setup.robot.links, clamp.link, &pipeline::Link::name);
      if (of == setup.robot.links.end() || (of->capsules.empty() && of->boxes.empty() && of->meshes.empty())) return;
      const int link = static_cast<int>(of - setup.robot.links.begin());
      all.push_back({d, &clamp, pipeline::line_key(setup, d, "routing." + name),
                     way_out(surfaces, link, clamp.position, sense * clamp.direction, diameter)});
    };
    const pipeline::Routing& routing = setup.dresspacks[d].routing;
    if (routing.base_clamp && !routing.retraction) see(*routing.base_clamp, "base_clamp", 1);
    for (std::size_t k = 0; k < routing.clamps.size(); ++k)
      for (const double sense : {-1, 1}) see(routing.clamps[k].clamp, fmt::format("clamps.{}", k + 1), sense);
    if (routing.tool_clamp) see(*routing.tool_clamp, "tool_clamp", -1);
  }
  return all;
}

std::vector<pipeline::Warning> way_out_warnings(const pipeline::Setup& setup) {
  if (setup.robot.links.empty() || !setup.simulation.contact) return {};
  std::vector<pipeline::Warning> warnings;
  for (const WayOut& way : ways_out(setup, Surfaces(setup))) {
    const pipeline::Dresspack& dresspack = setup.dresspacks[way.dresspack].dresspack;
    const double radius = limits_of(dresspack).least_bend_radius;
    if (way.curvature * radius <= 1) continue;
    const double depth = way.curvature * dresspack.diameter * dresspack.diameter / 2;
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::bend_radius, way.clamp->where.text(),
        fmt::format(
            "straight on from {}, the dresspack is {:.1f} mm inside {} at one diameter from the clamp: it comes out "
            "with a bend radius of {:.1f} mm or less (limit {:.1f} mm), also where the segments are too long to show it",
            way.key, 1e3 * depth, way.clamp->link, 1e3 / way.curvature, 1e3 * radius),
        "the clamp lies in the surface of its link, or its direction leads into it",
        fmt::format("{}.position_m {:.0f} mm farther from the surface, or a direction that leads away from it", way.key,
                    std::ceil(1e3 * depth))));
  }
  return warnings;
}

BracketFit fit_of(const BracketPlace& place, const pipeline::Robot& robot, const Surfaces& surfaces,
                  std::span<const std::vector<Frame>> poses) {
  BracketFit fit;
  fit.clearance = std::numeric_limits<double>::infinity();
  if (surfaces.has_shapes(place.link)) {
    const double away = surfaces.of_link(place.link, place.position, far_away) - place.radius;
    fit.length = std::max(0.0, away), fit.inside = std::max(0.0, -away);
  }
  const double diameter = 2 * place.radius;
  fit.unbuildable = fit.inside - place.radius;
  if (place.link + 1 == static_cast<int>(robot.links.size()))
    fit.unbuildable =
        std::max(fit.unbuildable, adapter_radius(diameter) - off_flange_axis(robot, place.position, diameter));
  for (std::size_t m = 0; m < poses.size(); ++m) {
    const std::vector<Frame>& links = poses[m];
    const Frame& own = links[static_cast<std::size_t>(place.link)];
    const Vector3 point = own.position + own.orientation * place.position;
    const auto most = [&] { return std::min(clear, fit.clearance + place.radius); };
    const auto see = [&](double distance, int neighbour) {
      if (distance >= most()) return;
      fit.clearance = distance - place.radius;
      fit.neighbour = neighbour;
      fit.moment = m;
    };
    see(surfaces.of_cell(point, most()), -1);
    for (std::size_t link = 0; link < links.size(); ++link)
      if (static_cast<int>(link) != place.link)
        see(surfaces.of_link(static_cast<int>(link),
                             links[link].orientation.conjugate() * (point - links[link].position), most()),
            static_cast<int>(link));
  }
  return fit;
}

std::optional<ToolSpace> unknown_tool_space(const pipeline::Setup& setup, const std::vector<Vector3>& tools) {
  constexpr double short_tool = 0.1;  // [m]: measuring tips and suction cups; a hose bends with a larger radius
  // ESTIMATE: half of the width of a gripper or gun, mm; the shape begins behind the adapter plate and ends before the tip, where
  // fingers and electrodes are thinner
  constexpr double half_width = 60, begin = 0.1, end = 0.8;
  if (setup.robot.links.empty() || !setup.simulation.contact) return {};
  const pipeline::Robot& robot = setup.robot;
  const Eigen::Quaterniond turn = pipeline::from_roll_pitch_yaw(robot.flange_orientation);
  std::optional<Surfaces> surfaces;
  Vector3 longest = Vector3::Zero();
  for (const Vector3& tool : tools) {
    const double reach = tool.norm();
    if (reach <= std::max(short_tool, longest.norm())) continue;
    if (!surfaces) surfaces.emplace(setup);
    const int last = static_cast<int>(robot.links.size()) - 1;
    if (surfaces->of_link(last, robot.flange_position + turn * tool, reach) > reach / 2) longest = tool;
  }
  if (longest.isZero()) return {};
  const pipeline::Link& last = robot.links.back();
  const auto point = [&](double share) {
    const Vector3 at =
        (1e3 * (robot.flange_position + turn * (share * longest))).array().round() / 1e3 + 0.0;  // + 0.0 avoids -0
    return fmt::format("[{:g}, {:g}, {:g}]", at.x(), at.y(), at.z());
  };
  ToolSpace space{longest.norm(), last.name, {}};
  const std::string shapes = fmt::format("robot.links.{}.", robot.links.size());
  if (last.capsules.empty())  // a list replaces the existing one
    space.line = {shapes + "capsules",
                  fmt::format("[{{from_m: {}, to_m: {}, radius_mm: {}}}]", point(begin), point(end), half_width)};
  else if (last.boxes.empty())
    space.line = {shapes + "boxes", fmt::format("[{{position_m: {}, sides_m: [{}, {}, {}]}}]", point((begin + end) / 2),
                                                2e-3 * half_width, 2e-3 * half_width, 2e-3 * half_width)};
  return space;
}

double off_flange_axis(const pipeline::Robot& robot, const Vector3& position, double diameter) {
  const Vector3 axis = pipeline::from_roll_pitch_yaw(robot.flange_orientation) * Vector3::UnitZ();
  const Vector3 off = position - robot.flange_position;
  return off.dot(axis) > -diameter ? off.cross(axis).norm() : std::numeric_limits<double>::infinity();
}

std::vector<pipeline::Warning> tool_clamp_warnings(const pipeline::Setup& setup,
                                                   const std::optional<ToolSpace>& space) {
  std::vector<pipeline::Warning> warnings;
  if (!space) return warnings;
  for (std::size_t d = 0; d < setup.dresspacks.size(); ++d) {
    const pipeline::MountedDresspack& mounted = setup.dresspacks[d];
    const std::optional<pipeline::Clamp>& clamp = mounted.routing.tool_clamp;
    if (!clamp || clamp->link != space->link) continue;
    const double diameter = mounted.dresspack.diameter, off = off_flange_axis(setup.robot, clamp->position, diameter);
    const bool beyond_tool = (clamp->position - setup.robot.flange_position).norm() > space->reach;
    if (off >= adapter_radius(diameter) || beyond_tool) continue;
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::overlap, clamp->where.text(),
        fmt::format("{} is {:.0f} mm beside the axis of the flange (limit {:.0f} mm): there the adapter of "
                    "the tool is, and no clamp can be built",
                    pipeline::line_key(setup, d, "routing.tool_clamp.position_m"), 1e3 * off,
                    1e3 * adapter_radius(diameter)),
        "a place inside the tool, whose shape the job does not have",
        fmt::format(
            "a place beside the tool; {}: {} gives {} its shape (sizes: those of your tool), which dresslife route "
            "then keeps clear of",
            space->line.key.empty() ? "shapes" : space->line.key,
            space->line.key.empty() ? "those of your tool" : space->line.value, space->link)));
  }
  return warnings;
}

std::vector<pipeline::Warning> clamp_warnings(const pipeline::Setup& setup, const std::optional<ToolSpace>& space) {
  return pipeline::joined(way_out_warnings(setup), tool_clamp_warnings(setup, space));
}

std::string tool_space_note(const std::optional<ToolSpace>& space) {
  if (!space) return "";
  return fmt::format(
      "The space of the tool is not known: it works {:.0f} mm from the flange, and {} has no shape there. The hose may "
      "pass through the tool{}",
      1e3 * space->reach, space->link,
      space->line.key.empty() ? ". Add the shape of your tool to those of this link"
                              : fmt::format(". A line such as {}: {} gives it one (sizes: those of your tool)",
                                            space->line.key, space->line.value));
}

}  // namespace dresslife::sim
