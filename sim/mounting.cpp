#include "sim/mounting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/equilibrium.h"
#include "sim/routing.h"

namespace dresslife::sim {
namespace {

using pipeline::InputError;

constexpr double carrying_speed = 20 * EIGEN_PI / 180;  // of the fastest axis on the way to the start [rad/s]
constexpr int settling_steps = 20000;
constexpr double rest = 1e-5;          // what settling aims at [m/s]
constexpr double near_rest = 2e-2;     // still a start: sways by less than its diameter [m/s]
constexpr double lean = 0.3;           // of a hose held up: straight up it could stay there, balanced
constexpr double overlap_share = 0.5;  // of the diameter: overlaps up to this are pushed out while settling

constexpr double roomy = 0.98;  // of the free length: no less is left to bend when a unit is pulled out
constexpr double pre_twist_part = 0.5;  // turned at a time [rad]

struct Held {
  RodState state;
  double roll = 0;   // of its far end
  double depth = 0;  // largest overlap with an obstacle [m]
  bool found = false;
};

/// What is hung up at a time: from clamp to clamp, or, where rings lie between, from ring to ring, each of
/// them holding the hose until all of it hangs.
struct Piece {
  RodProperties properties;
  Frame begin, end;
  int begin_link = no_link, end_link = no_link;
  int end_clamp = -1;  // of the robot's; -1: a ring or a free end
  bool twist_free = false;
  double pre_twist = 0;  // [rad]
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

WorldSettings world_settings(const pipeline::Job& job) {
  WorldSettings settings;
  settings.time_step = job.simulation.time_step;
  settings.friction = job.dresspack.friction;
  settings.floor = job.simulation.floor;
  settings.self_contact = job.simulation.self_contact;
  return settings;
}

void add_obstacles(World& world, const pipeline::Job& job, const RobotPath* robot) {
  if (!job.simulation.contact) return;
  add_shapes(world, cell_obstacle, job.cell);
  if (!robot) return;
  for (size_t link = 0; link < job.robot.links.size(); ++link)
    add_shapes(world, static_cast<int>(link), job.robot.links[link]);
}

class Mounting {
 public:
  Mounting(const pipeline::Job& job, const Rod& rod, const ClampPath& path, RobotPath* robot)
      : job_(job), rod_(rod), path_(path), robot_(robot) {}

  RodState mounted() {
    std::vector<RodState> pieces;
    std::vector<RodProperties> properties;
    const int spans = static_cast<int>(rod_.spans().size());
    double way = 0;
    Frame begin = mounting_pose().clamps.base;
    if (rod_.properties().slider)
      way = pulled_out(mounting_pose()), begin.position += way * tangent(begin.orientation);
    for (int k = 0; k < spans; ++k) {
      for (Piece piece : pieces_of(k)) {
        piece.begin = begin;
        const Held held = held_clear(piece);
        begin = held.state.clamps.tool;
        pieces.push_back(held.state);
        segments_before_.push_back((segments_before_.empty() ? 0 : segments_before_.back()) +
                                   piece.properties.segments);
        properties.push_back(piece.properties);
        if (robot_ && piece.end_clamp >= 0) robot_->turn_clamp(piece.end_clamp, held.roll);
      }
    }
    RodState state = at_rest(as_spans(joined(Rod(properties), pieces), way), mounting_pose());
    if (!robot_ || robot_->mounting_pose() == robot_->motion().position(0)) return state;
    return at_rest(carried(state), path_.at(0));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(job_.routing.where, what,
                     "check the free length and the clamps' places and directions in the mounting pose");
  }

  Pose mounting_pose() const { return robot_ ? robot_->pose(robot_->mounting_pose()) : path_.at(0); }

  /// How far a retraction unit must be out for the dresspack to reach its next clamp with some slack.
  double pulled_out(const Pose& pose) const {
    constexpr int parts = 100;
    RodProperties held = rod_.properties();
    const double stroke = held.slider->stroke;
    held.slider.reset();
    const Rod rod(held);
    ClampFrames clamps{pose.clamps.base, pose.clamps.end(1)};
    const auto way = [&](int part) {
      ClampFrames at = clamps;
      at.base.position += (stroke * part / parts) * tangent(clamps.base.orientation);
      return at;
    };
    for (int part = 0; part <= parts; ++part)
      if (held.tool_end == End::free ||
          shortest_ways(job_, rod, way(part), pose.rings).front() < roomy * held.length)
        return stroke * part / parts;
    return stroke;
  }

  /// Of one span, in order; each but the last ends in a ring. Segments are dealt by length.
  std::vector<Piece> pieces_of(int k) const {
    const Span& span = rod_.spans()[k];
    const Pose pose = mounting_pose();
    const std::vector<int> of_ring = ring_spans(job_);
    const std::vector<int> clamp_links = robot_ ? robot_->clamp_links() : std::vector<int>(k + 2, no_link);
    const bool free_end = span.properties.tool_end == End::free;
    std::vector<Frame> ends;
    std::vector<int> links;
    std::vector<double> given;
    for (size_t r = 0; r < pose.rings.size(); ++r)
      if (of_ring[r] == k) {
        ends.push_back(pose.rings[r]);
        links.push_back(robot_->ring_links()[r]);
        const auto& at = job_.routing.rings[r].at_length;
        given.push_back(at ? *at - span.first_arc : 0);
      }
    ends.push_back(pose.clamps.end(2 * k + 1));
    links.push_back(free_end ? no_link : clamp_links[k + 1]);
    given.push_back(span.properties.length);
    const std::vector<int> counts = dealt(span, pose.clamps.end(2 * k).position, ends, given);
    std::vector<Piece> pieces;
    for (size_t p = 0; p < ends.size(); ++p) {
      const bool last = p + 1 == ends.size();
      Piece piece;
      piece.properties = span.properties;
      piece.properties.slider.reset();
      piece.properties.segments = counts[p];
      piece.properties.length = counts[p] * span.segment_length;
      if (!last) piece.properties.tool_end = End::clamped, piece.properties.tip_mass = 0;
      piece.end = ends[p];
      piece.begin_link = p == 0 ? clamp_links[k] : links[p - 1];
      piece.end_link = links[p];
      piece.twist_free = !last || free_of_twist(k);
      piece.pre_twist = last && k + 1 == static_cast<int>(rod_.spans().size()) ? job_.routing.pre_twist : 0;
      if (last && !free_end) piece.end_clamp = k + 1;
      pieces.push_back(piece);
    }
    return pieces;
  }

  /// Segments of each piece: up to where the ring is given to sit, else so that all pieces have slack alike.
  std::vector<int> dealt(const Span& span, Vector3 from, const std::vector<Frame>& ends,
                         const std::vector<double>& given) const {
    constexpr int fewest = 2;
    const int pieces = static_cast<int>(ends.size());
    std::vector<double> ways{0};
    for (const Frame& end : ends)
      ways.push_back(ways.back() + (end.position - from).norm()), from = end.position;
    std::vector<int> counts;
    int before = 0;
    for (int p = 0; p < pieces; ++p) {
      const double share = given[p] > 0 ? given[p] / span.properties.length : ways[p + 1] / ways.back();
      const int left = fewest * (pieces - 1 - p);
      const int up_to =
          std::min(span.segments() - left,
                   std::max(before + fewest, static_cast<int>(std::lround(share * span.segments()))));
      counts.push_back((p + 1 == pieces ? span.segments() : up_to) - before);
      if (counts.back() < fewest)
        fail("dresspack has too few segments for its guide rings (simulation.segments)");
      before = up_to;
    }
    return counts;
  }

  /// Unless the routing turns the clamp at the span's tool end.
  bool free_of_twist(int span) const {
    if (!robot_ || rod_.spans()[span].properties.tool_end == End::free) return false;
    const auto& between = job_.routing.clamps;
    return !(span < static_cast<int>(between.size()) ? between[span].clamp : *job_.routing.tool_clamp).roll;
  }

  /// Pieces hung up one after the other as one state of the rod.
  RodState as_spans(RodState state, double way) const {
    const int spans = static_cast<int>(rod_.spans().size());
    const RodState pieces = state;
    state.clamps.between.assign(2 * spans - 2, Frame{});
    int piece_end = -1, segment = 0;
    for (int k = 0; k < spans; ++k) {
      state.clamps.end(2 * k) = pieces.clamps.end(piece_end + 1);
      segment += rod_.spans()[k].segments();
      do piece_end += 2;
      while (segments_before_[piece_end / 2] < segment);
      state.clamps.end(2 * k + 1) = pieces.clamps.end(piece_end);
    }
    state.clamp_velocity.assign(2 * spans, Vector3::Zero());
    state.clamp_angular_velocity.assign(2 * spans, Vector3::Zero());
    state.travel.assign(spans, Travel{});
    state.travel.front().way = way;
    state.link_force.clear();
    for (int j = 0; j < rod_.links(); ++j)
      state.link_force.push_back(rod_.gap_stiffness(j) * rod_.link_state(state, j).gap);
    return state;
  }

  Held held_clear(const Piece& piece) const {
    const Pose pose = mounting_pose();
    const Vector3 g = job_.simulation.gravity;
    const Vector3 chord = piece.end.position - piece.begin.position;
    Vector3 side = chord.cross(g);
    if (side.norm() > 0) side *= g.norm() / side.norm();
    Held best;
    for (const Vector3& gravity : std::array<Vector3, 4>{g, side, -side, Vector3(-g + lean * side)}) {
      Held held = equilibrium(piece, pose, gravity);
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

  Held equilibrium(const Piece& piece, const Pose& pose, const Vector3& gravity) const {
    RodProperties properties = piece.properties;
    properties.gravity = gravity;
    const Rod rod(properties);
    ClampFrames clamps{piece.begin, piece.end};
    if (properties.tool_end == End::free) clamps = rod.straight(piece.begin).clamps;
    TwistFreeClamp clamped;
    if (piece.twist_free)
      clamped = twist_free_roll(rod, clamps);
    else
      clamped.equilibrium = find_equilibrium(rod, clamps);
    Equilibrium& found = clamped.equilibrium;
    const int parts = static_cast<int>(std::ceil(std::abs(piece.pre_twist) / pre_twist_part));
    const Frame untwisted = found.state.clamps.tool;
    for (int part = 1; part <= parts && found.status == EquilibriumStatus::converged; ++part) {
      const ClampFrames turned{clamps.base, rolled(untwisted, piece.pre_twist * part / parts)};
      found = find_equilibrium(rod, turned, found.state);
    }
    if (found.status != EquilibriumStatus::converged) return {};
    WorldSettings settings = world_settings(job_);
    settings.base_link = piece.begin_link, settings.tool_link = piece.end_link;
    World world(rod, settings, found.state, pose.links);
    add_obstacles(world, job_, robot_);
    const double depth = world.advance(found.state.clamps, pose.links).max_depth;
    if (properties.tool_end == End::free)
      found.state.clamps.tool = rod.tip_frame(found.state, rod.spans().front());
    return {found.state, clamped.roll + piece.pre_twist, depth, true};
  }

  RodState at_rest(const RodState& state, const Pose& pose) const {
    const std::unique_ptr<World> world = make_world(job_, rod_, robot_, state, pose);
    const Equilibrium found = settle(*world, pose.links, settling_steps, rest);
    if (found.status == EquilibriumStatus::too_short) fail("dresspack is drawn taut when it is clamped");
    if (found.status != EquilibriumStatus::converged && !(found.residual < near_rest))
      fail(fmt::format("dresspack does not come to rest (it still moves at {:.3g} m/s)", found.residual));
    RodState still = found.state;
    for (int i = 0; i < rod_.segments(); ++i) still.velocity[i] = still.angular_velocity[i] = Vector3::Zero();
    for (Travel& travel : still.travel) travel.speed = 0;
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
  std::vector<int> segments_before_;  // (piece) up to its end
};

}  // namespace

std::unique_ptr<World> make_world(const pipeline::Job& job, const Rod& rod, const RobotPath* robot,
                                  const RodState& state, const Pose& pose) {
  WorldSettings settings = world_settings(job);
  if (robot) {
    const std::vector<int>& links = robot->clamp_links();
    const bool free_end = job.routing.tool_end == pipeline::ToolEnd::free;
    const size_t last = links.size() - (free_end ? 0 : 1);
    settings.base_link = links.front();
    settings.tool_link = free_end ? no_link : links.back();
    for (size_t k = 1; k < last; ++k)
      settings.between_links.insert(settings.between_links.end(), 2, links[k]);
  }
  auto world = std::make_unique<World>(rod, settings, state, pose.links);
  add_obstacles(*world, job, robot);
  const std::vector<int> of_ring = ring_spans(job);
  for (size_t k = 0; k < job.routing.rings.size(); ++k) {
    const pipeline::GuideRing& ring = job.routing.rings[k];
    world->add(robot->ring_links()[k],
               RingShape{robot->rings()[k], ring.radius, ring.width, ring.friction, of_ring[k]});
  }
  return world;
}

RodState mount(const pipeline::Job& job, const Rod& rod, const ClampPath& path, RobotPath* robot) {
  return Mounting(job, rod, path, robot).mounted();
}

}  // namespace dresslife::sim
