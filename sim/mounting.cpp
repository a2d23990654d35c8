#include "sim/mounting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/equilibrium.h"

namespace dresslife::sim {
namespace {

using pipeline::InputError;

constexpr double carrying_speed = 20 * EIGEN_PI / 180;  // of the fastest axis on the way to the start [rad/s]
constexpr int settling_steps = 20000;
constexpr double rest = 1e-5;          // what settling aims at [m/s]
constexpr double near_rest = 2e-2;     // still a start: sways by less than its diameter [m/s]
constexpr double lean = 0.3;           // of a hose held up: straight up it could stay there, balanced
constexpr double overlap_share = 0.5;  // of the diameter: overlaps up to this are pushed out while settling

struct Held {
  RodState state;
  double roll = 0;   // of the tool clamp
  double depth = 0;  // largest overlap with an obstacle [m]
  bool found = false;
};

Frame frame_of(const Vector3& position, const Vector3& orientation) {
  return {position, from_roll_pitch_yaw(orientation)};
}

/// shapes: a pipeline::Link or pipeline::Cell.
template <class Shapes>
void add_shapes(World& world, int link, const Shapes& shapes) {
  for (const pipeline::Capsule& capsule : shapes.capsules)
    world.add(link, CapsuleShape{capsule.from, capsule.to, capsule.radius});
  for (const pipeline::Box& box : shapes.boxes)
    world.add(link, BoxShape{frame_of(box.position, box.orientation), box.sides});
  for (const pipeline::MeshFile& file : shapes.meshes) {
    std::vector<Triangle> triangles = read_triangles(file.file);
    for (Triangle& triangle : triangles)
      for (Vector3& corner : triangle) corner *= file.scale;
    world.add(link, std::make_shared<const Mesh>(std::move(triangles)), frame_of(file.position, file.orientation));
  }
}

class Mounting {
 public:
  Mounting(const pipeline::Job& job, const Rod& rod, const ClampPath& path, RobotPath* robot)
      : job_(job), rod_(rod), path_(path), robot_(robot) {}

  RodState mounted() {
    const Pose pose = robot_ ? robot_->pose(robot_->mounting_pose()) : path_.at(0);
    const Held held = held_clear(pose);
    if (robot_) robot_->turn_tool_clamp(held.roll);
    const Pose turned = robot_ ? robot_->pose(robot_->mounting_pose()) : pose;
    RodState state = at_rest(held.state, turned);
    if (!robot_ || robot_->mounting_pose() == robot_->motion().position(0)) return state;
    return at_rest(carried(state), path_.at(0));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(job_.routing.where, what,
                     "check the free length and the clamps' places and directions in the mounting pose");
  }

  Held held_clear(const Pose& pose) const {
    const Vector3 g = job_.simulation.gravity;
    const Vector3 chord = pose.clamps.tool.position - pose.clamps.base.position;
    Vector3 side = chord.cross(g);
    if (side.norm() > 0) side *= g.norm() / side.norm();
    Held best;
    for (const Vector3& gravity : std::array<Vector3, 4>{g, side, -side, Vector3(-g + lean * side)}) {
      Held held = equilibrium(pose, gravity);
      if (!held.found || (best.found && held.depth >= best.depth)) continue;
      best = std::move(held);
      if (best.depth == 0) break;
    }
    if (!best.found) fail("dresspack finds no equilibrium between its clamps");
    if (best.depth > overlap_share * job_.dresspack.diameter)
      fail(fmt::format("dresspack runs {:.0f} mm deep through the robot or the floor in the mounting pose",
                       1e3 * best.depth));
    return best;
  }

  Held equilibrium(const Pose& pose, const Vector3& gravity) const {
    RodProperties properties = rod_.properties();
    properties.gravity = gravity;
    const Rod rod(properties);
    const bool free_of_twist = robot_ && !job_.routing.tool_clamp->roll;
    TwistFreeClamp clamped;
    if (free_of_twist)
      clamped = twist_free_roll(rod, pose.clamps);
    else
      clamped.equilibrium = find_equilibrium(rod, pose.clamps);
    const Equilibrium& found = clamped.equilibrium;
    if (found.status != EquilibriumStatus::converged) return {};
    const double depth =
        make_world(job_, rod, robot_, found.state, pose)->advance(found.state.clamps, pose.links).max_depth;
    return {found.state, clamped.roll, depth, true};
  }

  RodState at_rest(const RodState& state, const Pose& pose) const {
    const std::unique_ptr<World> world = make_world(job_, rod_, robot_, state, pose);
    const Equilibrium found = settle(*world, pose.links, settling_steps, rest);
    if (found.status == EquilibriumStatus::too_short) fail("dresspack is drawn taut when it is clamped");
    if (found.status != EquilibriumStatus::converged && !(found.residual < near_rest))
      fail(fmt::format("dresspack does not come to rest (it still moves at {:.3g} m/s)", found.residual));
    RodState still = found.state;
    for (int i = 0; i < rod_.segments(); ++i) still.velocity[i] = still.angular_velocity[i] = Vector3::Zero();
    return still;
  }

  /// Through the joint move from the mounting pose to the first waypoint, smooth at both ends.
  RodState carried(const RodState& start) const {
    const Eigen::VectorXd from = robot_->mounting_pose(), way = robot_->motion().position(0) - from;
    const int steps = static_cast<int>(
        std::ceil(way.lpNorm<Eigen::Infinity>() / (carrying_speed * job_.simulation.time_step)));
    const std::unique_ptr<World> world = make_world(job_, rod_, robot_, start, robot_->pose(from));
    for (int k = 1; k <= steps; ++k) {
      const double u = static_cast<double>(k) / steps;
      const Pose pose = robot_->pose(from + u * u * (3 - 2 * u) * way);
      if (!world->advance(pose.clamps, pose.links).finite ||
          rod_.mean_elongation(world->state()) > longest_elongation)
        fail("dresspack is drawn taut on the way from the mounting pose to the first waypoint");
    }
    return world->state();
  }

  const pipeline::Job& job_;
  const Rod& rod_;
  const ClampPath& path_;
  RobotPath* robot_;
};

}  // namespace

std::unique_ptr<World> make_world(const pipeline::Job& job, const Rod& rod, const RobotPath* robot,
                                  const RodState& state, const Pose& pose) {
  WorldSettings settings;
  settings.time_step = job.simulation.time_step;
  settings.friction = job.dresspack.friction;
  settings.floor = job.simulation.floor;
  settings.self_contact = job.simulation.self_contact;
  if (robot) {
    settings.base_link = robot->base_link();
    settings.tool_link = robot->tool_link();
  }
  auto world = std::make_unique<World>(rod, settings, state, pose.links);
  if (!job.simulation.contact) return world;
  add_shapes(*world, cell_obstacle, job.cell);
  if (!robot) return world;
  for (size_t link = 0; link < job.robot.links.size(); ++link)
    add_shapes(*world, static_cast<int>(link), job.robot.links[link]);
  return world;
}

RodState mount(const pipeline::Job& job, const Rod& rod, const ClampPath& path, RobotPath* robot) {
  return Mounting(job, rod, path, robot).mounted();
}

}  // namespace dresslife::sim
