#include "sim/run/mounting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/job/setup.h"
#include "sim/contact/self_contact.h"
#include "sim/run/equilibrium.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

constexpr double joint_speed = 20 * EIGEN_PI / 180;  // speed of the fastest axis on the way to the start [rad/s]
constexpr int settling_steps = 20000;
constexpr double rest = 1e-5;       // target of the settling [m/s]
constexpr double near_rest = 2e-2;  // accepted as a start: the hose sways by less than its diameter [m/s]
constexpr double lean = 0.3;        // of a hose held up: exactly vertical it could stay in an unstable balance
// Between clamps in one plane with the arm a hose rests on both sides, and rounding would choose one. 6 deg choose the same side for
// clamps that are built some millimetres beside this plane.
constexpr double lean_to_left = 0.1;
constexpr double overlap_share = 0.5;  // share of the diameter: smaller overlaps are pushed out while settling

constexpr double roomy =
    0.98;  // share of the free length: the remainder is the length to bend when a unit is pulled out
constexpr double pre_twist_part = 0.5;  // rotation per step [rad]

struct MountedPiece {
  RodState state;
  double roll = 0;   // roll of its far end
  double depth = 0;  // largest overlap with an obstacle or another dresspack [m]
  int through = -1;  // index of the other dresspack, if that overlap is the deepest; -1: robot, cell or floor
  int obstacle = floor_obstacle;  // obstacle otherwise, numbered as in Contact
  double place = 0;               // place of the deepest overlap along the piece [m]
  bool found = false;
};

/// The part of a dresspack that is mounted at one time: from clamp to clamp; with rings from ring to
/// ring. Each ring holds the hose until the whole dresspack is mounted.
struct Piece {
  int dresspack = 0;
  RodProperties properties;
  Frame begin, end;
  int begin_link = no_link, end_link = no_link;
  int clamped_end = -1;  // index as in ClampFrames; -1: a ring or a free end
  bool twist_free = false;
  double pre_twist = 0;  // [rad]
};

Frame frame_of(const Vector3& position, const Vector3& orientation) {
  return {position, from_roll_pitch_yaw(orientation)};
}

/// shapes: a pipeline::Link or a pipeline::Cell.
template <class Shapes>
void add_shapes(World& world, int link, const Shapes& shapes) {
  for (const pipeline::Capsule& capsule : shapes.capsules)
    world.add(link, CapsuleShape{capsule.from, capsule.to, capsule.radius});
  for (const pipeline::Box& box : shapes.boxes)
    world.add(link, BoxShape{frame_of(box.position, box.orientation), box.sides});
  for (const pipeline::MeshFile& file : shapes.meshes)
    world.add(link, std::make_shared<const Mesh>(scaled_triangles(file.file, file.scale)),
              frame_of(file.position, file.orientation));
}

WorldSettings world_settings(const pipeline::Setup& setup) {
  WorldSettings settings;
  settings.time_step = setup.simulation.time_step;
  for (const pipeline::MountedDresspack& mounted : setup.dresspacks)
    settings.frictions.push_back(mounted.dresspack.friction);
  settings.floor = setup.simulation.floor;
  settings.self_contact = setup.simulation.self_contact;
  return settings;
}

void add_obstacles(World& world, const pipeline::Setup& setup, const RobotPath* robot) {
  if (!setup.simulation.contact) return;
  add_shapes(world, cell_obstacle, surroundings(setup));
  if (!robot) return;
  for (size_t link = 0; link < setup.robot.links.size(); ++link)
    add_shapes(world, static_cast<int>(link), setup.robot.links[link]);
}

class Mounting {
 public:
  Mounting(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, RobotPath* robot)
      : setup_(setup), rod_(rod), path_(path), robot_(robot) {}

  RodState mounted() {
    for (int d = 0; d < rod_.dresspacks(); ++d) hang_up(d);
    RodState state = at_rest(as_spans(joined(hung_rod(), hung_)), mounting_pose());
    if (!robot_ || robot_->mounting_pose() == robot_->motion().position(0)) return state;
    return at_rest(moved_to_start(state), path_.at(0));
  }

 private:
  const pipeline::Routing& routing(int dresspack) const { return setup_.dresspacks[dresspack].routing; }

  static constexpr const char* clamp_remedy =
      "check the free length and the clamps' places and directions in the mounting pose";

  RoutingRefusal refusal_of(int dresspack, const std::string& what, const std::string& remedy) const {
    return {routing(dresspack).where, fmt::format("{} {}", pipeline::dresspack_words(setup_, dresspack), what),
            remedy + " (dresslife preview shows them)", dresspack};
  }

  [[noreturn]] void fail(int dresspack, const std::string& what, const std::string& remedy = clamp_remedy) const {
    throw refusal_of(dresspack, what, remedy);
  }

  [[noreturn]] void fail_taut(int dresspack, const std::string& when) const {
    RoutingRefusal tight = refusal_of(dresspack, "is pulled tight " + when, clamp_remedy);
    tight.taut = true;
    throw tight;
  }

  [[noreturn]] void fail_in_the_way(const Piece& piece, const MountedPiece& held) const {
    const std::string what = held.through >= 0                ? pipeline::dresspack_words(setup_, held.through)
                             : held.obstacle >= 0             ? setup_.robot.links[held.obstacle].name
                             : held.obstacle == cell_obstacle ? "an obstacle of the cell"
                                                              : "the floor";
    double before = 0;  // length before the piece, along the dresspack
    for (const Piece& hung : hung_pieces_)
      if (hung.dresspack == piece.dresspack) before += hung.properties.length;
    const double deep = 1e3 * held.depth;
    fail(
        piece.dresspack,
        fmt::format("runs {:.0f} mm deep through {} in the mounting pose, {:.2f} m from its base clamp", deep, what,
                    before + held.place),
        fmt::format(
            "bring a clamp {:.0f} mm and more out of its way, turn the clamps' directions away from it, or change the free "
            "length",
            deep));
  }

  Pose mounting_pose() const { return robot_ ? robot_->pose(robot_->mounting_pose()) : path_.at(0); }

  /// Mounts a dresspack piece by piece from its base clamp.
  void hang_up(int dresspack) {
    const int first = rod_.first_span(dresspack);
    Frame begin = mounting_pose().clamps.end(2 * first);
    if (rod_.spans()[first].properties.slider) {
      pulled_out_.push_back(pulled_out(first));
      begin.position += pulled_out_.back() * tangent(begin.orientation);
    } else {
      pulled_out_.push_back(0);
    }
    for (int k = first; k < rod_.first_span(dresspack + 1); ++k)
      for (Piece piece : pieces_of(k, begin.position)) {
        piece.begin = begin;
        const MountedPiece held = held_clear(piece);
        begin = held.state.clamps.tool;
        hung_.push_back(held.state);
        hung_pieces_.push_back(piece);
        if (robot_ && piece.clamped_end >= 0) robot_->turn_clamp(piece.clamped_end, held.roll);
      }
  }

  /// Returns a rod of the mounted pieces, and of one more piece if given.
  Rod hung_rod(const Piece* more = nullptr) const {
    std::vector<RodProperties> pieces;
    std::vector<int> first_of_dresspack;
    int dresspack = -1;
    const auto add = [&](const Piece& piece) {
      if (piece.dresspack != dresspack) first_of_dresspack.push_back(static_cast<int>(pieces.size()));
      dresspack = piece.dresspack;
      pieces.push_back(piece.properties);
    };
    for (const Piece& piece : hung_pieces_) add(piece);
    if (more) add(*more);
    return Rod(pieces, first_of_dresspack);
  }

  /// Returns the travel of a retraction unit at which the dresspack reaches its next clamp with some slack.
  double pulled_out(int span) const {
    constexpr int parts = 100;
    const Pose pose = mounting_pose();
    std::vector<RodProperties> spans;
    for (const Span& of : rod_.spans()) spans.push_back(of.properties);
    RodProperties& held = spans[span];
    const double stroke = held.slider->stroke;
    held.slider.reset();
    const Rod rod(spans);
    std::vector<Vector3> through;  // centres of the rings that hold the dresspack
    const std::vector<RoutedRing> routed = routed_rings(setup_);
    for (size_t r = 0; r < pose.rings.size(); ++r)
      if (routed[r].span == span) through.push_back(pose.rings[r].position);
    for (int part = 0; part <= parts; ++part) {
      const double way = stroke * part / parts;
      ClampFrames at = pose.clamps;
      Frame& base = at.end(2 * span);
      base.position += way * tangent(base.orientation);
      if (held.tool_end == End::free || shortest_way(rod, at, span, through) < roomy * held.length) return way;
    }
    return stroke;
  }

  /// Returns the pieces of one span with the base end at `from`, in order; each except the last ends in a ring. Segments are
  /// distributed by length.
  std::vector<Piece> pieces_of(int k, const Vector3& from) const {
    const Span& span = rod_.spans()[k];
    const Pose pose = mounting_pose();
    const std::vector<RoutedRing> routed = routed_rings(setup_);
    const std::vector<int> end_links =
        robot_ ? robot_->end_links() : std::vector<int>(2 * rod_.spans().size(), no_link);
    const bool free_end = span.properties.tool_end == End::free;
    std::vector<Frame> ends;
    std::vector<int> links;
    std::vector<double> given;
    for (size_t r = 0; r < pose.rings.size(); ++r)
      if (routed[r].span == k) {
        ends.push_back(pose.rings[r]);
        links.push_back(robot_->ring_links()[r]);
        const auto& at = routed[r].ring.at_length;
        given.push_back(at ? *at - span.first_arc : 0);
      }
    ends.push_back(pose.clamps.end(2 * k + 1));
    links.push_back(end_links[2 * k + 1]);
    given.push_back(span.properties.length);
    const std::vector<int> counts = dealt(span, from, ends, given);
    std::vector<Piece> pieces;
    for (size_t p = 0; p < ends.size(); ++p) {
      const bool last = p + 1 == ends.size();
      Piece piece;
      piece.dresspack = span.dresspack;
      piece.properties = span.properties;
      piece.properties.slider.reset();
      piece.properties.segments = counts[p];
      piece.properties.length = counts[p] * span.segment_length;
      if (!last)
        piece.properties.tool_end = End::clamped, piece.properties.tip_mass = 0, piece.properties.stiff_ends[1] = {};
      if (p > 0) piece.properties.stiff_ends[0] = {};
      piece.end = ends[p];
      piece.begin_link = p == 0 ? end_links[2 * k] : links[p - 1];
      piece.end_link = links[p];
      piece.twist_free = !last || free_of_twist(k);
      if (last && k + 1 == rod_.first_span(span.dresspack + 1)) piece.pre_twist = routing(span.dresspack).pre_twist;
      if (last && !free_end) piece.clamped_end = 2 * k + 1;
      pieces.push_back(piece);
    }
    return pieces;
  }

  /// Returns the segments of each piece: up to the given place of the ring, else such that all pieces have equal slack.
  std::vector<int> dealt(const Span& span, Vector3 from, const std::vector<Frame>& ends,
                         const std::vector<double>& given) const {
    constexpr int fewest = 2;
    const int pieces = static_cast<int>(ends.size());
    std::vector<double> ways{0};
    for (const Frame& end : ends) ways.push_back(ways.back() + (end.position - from).norm()), from = end.position;
    std::vector<int> counts;
    int before = 0;
    for (int p = 0; p < pieces; ++p) {
      const double share = given[p] > 0 ? given[p] / span.properties.length : ways[p + 1] / ways.back();
      const int left = fewest * (pieces - 1 - p);
      const int up_to = std::min(span.segments() - left,
                                 std::max(before + fewest, static_cast<int>(std::lround(share * span.segments()))));
      counts.push_back((p + 1 == pieces ? span.segments() : up_to) - before);
      if (counts.back() < fewest)
        fail(span.dresspack, "has too few segments for its guide rings (simulation.segments)");
      before = up_to;
    }
    return counts;
  }

  /// Returns false if the routing gives the roll of the clamp at the span's tool end.
  bool free_of_twist(int k) const {
    const Span& span = rod_.spans()[k];
    if (!robot_ || span.properties.tool_end == End::free) return false;
    const pipeline::Routing& of = routing(span.dresspack);
    const int clamp = k - rod_.first_span(span.dresspack);
    return !(clamp < static_cast<int>(of.clamps.size()) ? of.clamps[clamp].clamp : *of.tool_clamp).roll;
  }

  /// Joins the mounted pieces to one state of the rod.
  RodState as_spans(RodState state) const {
    const int spans = static_cast<int>(rod_.spans().size());
    const RodState pieces = state;
    state.clamps.between.assign(2 * spans - 2, Frame{});
    int piece = 0;
    for (int k = 0; k < spans; ++k) {
      state.clamps.end(2 * k) = pieces.clamps.end(2 * piece);
      for (int left = rod_.spans()[k].segments(); left > 0; ++piece) left -= hung_pieces_[piece].properties.segments;
      state.clamps.end(2 * k + 1) = pieces.clamps.end(2 * piece - 1);
    }
    state.clamp_velocity.assign(2 * spans, Vector3::Zero());
    state.clamp_angular_velocity.assign(2 * spans, Vector3::Zero());
    state.travel.assign(spans, Travel{});
    for (int d = 0; d < rod_.dresspacks(); ++d) state.travel[rod_.first_span(d)].way = pulled_out_[d];
    state.link_force.clear();
    for (int j = 0; j < rod_.links(); ++j)
      state.link_force.push_back(rod_.gap_stiffness(j) * rod_.link_state(state, j).gap);
    return state;
  }

  /// A way in which an installer holds a piece: pulled in the direction of `gravity`, and then let go, if `lets_go`, before the
  /// obstacles count.
  struct Hold {
    Vector3 gravity;
    bool lets_go;
  };
  /// Returns the ways in the order in which they are tried.
  std::vector<Hold> holds(const Piece& piece) const {
    const Vector3 g = setup_.simulation.gravity;
    const Vector3 chord = piece.end.position - piece.begin.position;
    Vector3 left = chord.cross(g);
    const pipeline::Side side = routing(piece.dresspack).side;
    if (left.norm() > 0)
      left *= g.norm() / left.norm();
    else if (side != pipeline::Side::either)
      fail(piece.dresspack, "has no left and no right side: its clamps are above each other, or there is no gravity",
           "leave routing.side out, or move the clamps");
    switch (side) {
      case pipeline::Side::left:
        return {{g + left, true}, {left, false}, {-g + left, false}};
      case pipeline::Side::right:
        return {{g - left, true}, {-left, false}, {-g - left, false}};
      case pipeline::Side::either:
        break;
    }
    return {{g + lean_to_left * left, true}, {g, false}, {left, false}, {-left, false}, {-g + lean * left, false}};
  }

  MountedPiece held_clear(const Piece& piece) const {
    const Pose pose = mounting_pose();
    MountedPiece best;
    for (const Hold& hold : holds(piece)) {
      MountedPiece held = equilibrium(piece, pose, hold);
      if (!held.found || (best.found && held.depth >= best.depth)) continue;
      best = std::move(held);
      if (best.depth == 0) break;
    }
    if (!best.found) fail(piece.dresspack, "finds no equilibrium between its clamps");
    if (best.depth > overlap_share * piece.properties.diameter) fail_in_the_way(piece, best);
    return best;
  }

  MountedPiece equilibrium(const Piece& piece, const Pose& pose, const Hold& hold) const {
    RodProperties properties = piece.properties;
    properties.gravity = hold.gravity;
    Rod rod(properties);
    ClampFrames clamps{piece.begin, piece.end};
    if (properties.tool_end == End::free) clamps = rod.straight(piece.begin).clamps;
    TwistFreeClamp clamped;
    if (piece.twist_free)
      clamped = twist_free_roll(rod, clamps);
    else
      clamped.equilibrium = find_equilibrium(rod, clamps);
    if (hold.lets_go && clamped.equilibrium.status == EquilibriumStatus::converged) {
      properties.gravity = setup_.simulation.gravity;
      rod = Rod(properties);
      if (piece.twist_free)
        clamped = twist_free_roll(rod, clamps, clamped);
      else
        clamped.equilibrium = find_equilibrium(rod, clamps, clamped.equilibrium.state);
    }
    Equilibrium& found = clamped.equilibrium;
    const int parts = static_cast<int>(std::ceil(std::abs(piece.pre_twist) / pre_twist_part));
    const Frame untwisted = found.state.clamps.tool;
    for (int part = 1; part <= parts && found.status == EquilibriumStatus::converged; ++part) {
      const ClampFrames turned{clamps.base, rolled(untwisted, piece.pre_twist * part / parts)};
      found = find_equilibrium(rod, turned, found.state);
    }
    if (found.status != EquilibriumStatus::converged) return {};
    WorldSettings settings = world_settings(setup_);
    settings.base_link = piece.begin_link, settings.tool_link = piece.end_link;
    World world(rod, settings, found.state, pose.links);
    add_obstacles(world, setup_, robot_);
    MountedPiece held;
    held.state = found.state;
    held.roll = clamped.roll + piece.pre_twist;
    held.found = true;
    held.depth = world.advance(found.state.clamps, pose.links).max_depth;
    const double segment_length = properties.length / properties.segments;
    const auto shallower = [](const Contact& a, const Contact& b) { return a.depth < b.depth; };
    if (const auto& contacts = world.contacts(); !contacts.empty()) {
      const Contact& deepest = *std::ranges::max_element(contacts, shallower);
      held.obstacle = deepest.obstacle;
      held.place = (deepest.segment + 0.5) * segment_length;
    }
    if (properties.tool_end == End::free) held.state.clamps.tool = rod.tip_frame(held.state, rod.spans().front());
    find_other_dresspacks(piece, held);
    return held;
  }

  /// Computes the overlap of a piece with the mounted dresspacks.
  void find_other_dresspacks(const Piece& piece, MountedPiece& held) const {
    if (!setup_.simulation.self_contact || piece.dresspack == 0) return;
    const Rod rod = hung_rod(&piece);
    std::vector<RodState> pieces = hung_;
    pieces.push_back(held.state);
    std::vector<Contact> contacts;
    find_self_contacts(rod, joined(rod, pieces), 0, contacts);
    const Span& last = rod.spans().back();
    for (const Contact& contact : contacts) {
      const int other = rod.span_of(contact.segment).dresspack;  // the contact names the lower segment first
      if (contact.other < last.first_segment || other == last.dresspack || contact.depth <= held.depth) continue;
      held.depth = contact.depth;
      held.through = other;
      held.place = (contact.other - last.first_segment + 0.5) * last.segment_length;
    }
  }

  RodState at_rest(const RodState& state, const Pose& pose) const {
    const std::unique_ptr<World> world = make_world(setup_, rod_, robot_, state, pose);
    const Equilibrium found = settle(*world, pose.links, settling_steps, rest);
    if (found.status == EquilibriumStatus::too_short)
      fail_taut(rod_.most_stretched(found.state).dresspack, "when it is clamped");
    if (found.status != EquilibriumStatus::converged && !(found.residual < near_rest)) {
      const std::size_t contacts = world->contacts().size();
      const std::string what =
          fmt::format("{} ({}{})", rod_.dresspacks() > 1 ? "or another does not come to rest" : "does not come to rest",
                      std::isinf(found.residual) ? "the simulation breaks down"
                                                 : fmt::format("it still moves at {:.3g} m/s", found.residual),
                      contacts > 0 ? fmt::format(", with {} contacts", contacts) : "");
      const std::string warmth = warmth_words(setup_);
      RoutingRefusal refusal(
          routing(0).where, fmt::format("{} {}", pipeline::dresspack_words(setup_, 0), what),
          fmt::format(
              "check {}diameter and stiffness of the dresspack, the free length and the clamps' places and directions in "
              "the mounting pose (dresslife preview shows them)",
              warmth.empty() ? "" : warmth + ", "),
          0);
      refusal.work = world->work();
      throw refusal;
    }
    RodState still = found.state;
    for (int i = 0; i < rod_.segments(); ++i) still.velocity[i] = still.angular_velocity[i] = Vector3::Zero();
    for (Travel& travel : still.travel) travel.speed = 0;
    return still;
  }

  /// Returns the state after the joint move from the mounting pose to the first waypoint, with smooth begin and end.
  RodState moved_to_start(const RodState& start) const {
    const Eigen::VectorXd from = robot_->mounting_pose(), way = robot_->motion().position(0) - from;
    const int steps =
        static_cast<int>(std::ceil(way.lpNorm<Eigen::Infinity>() / (joint_speed * setup_.simulation.time_step)));
    const std::unique_ptr<World> world = make_world(setup_, rod_, robot_, start, robot_->pose(from));
    for (int k = 1; k <= steps; ++k) {
      const double u = static_cast<double>(k) / steps;
      const Pose pose = robot_->pose(from + u * u * (3 - 2 * u) * way);
      const char* const way_words = "on the way from the mounting pose to the first waypoint";
      if (!world->advance(pose.clamps, pose.links).finite)
        fail(0, fmt::format("breaks down in the simulation {}", way_words), "choose a smaller simulation.time_step_ms");
      if (rod_.mean_elongation(world->state()) > longest_elongation)
        fail_taut(rod_.most_stretched(world->state()).dresspack, way_words);
    }
    return world->state();
  }

  const pipeline::Setup& setup_;
  const Rod& rod_;
  const ClampPath& path_;
  RobotPath* robot_;
  std::vector<RodState> hung_;  // (piece) states of all mounted pieces, dresspack after dresspack
  std::vector<Piece> hung_pieces_;
  std::vector<double> pulled_out_;  // (dresspack) travel of its retraction unit [m]
};

}  // namespace

std::unique_ptr<World> make_world(const pipeline::Setup& setup, const Rod& rod, const RobotPath* robot,
                                  const RodState& state, const Pose& pose) {
  WorldSettings settings = world_settings(setup);
  if (robot) {
    const std::vector<int>& links = robot->end_links();
    settings.base_link = links.front();
    settings.tool_link = links.back();
    settings.between_links.assign(links.begin() + 1, links.end() - 1);
  }
  auto world = std::make_unique<World>(rod, settings, state, pose.links);
  add_obstacles(*world, setup, robot);
  const std::vector<RoutedRing> routed = routed_rings(setup);
  for (size_t k = 0; k < routed.size(); ++k) {
    const pipeline::GuideRing& ring = routed[k].ring;
    world->add(robot->ring_links()[k],
               RingShape{robot->rings()[k], ring.radius, ring.width, ring.friction, routed[k].span});
  }
  return world;
}

RodState mount(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, RobotPath* robot) {
  return Mounting(setup, rod, path, robot).mounted();
}

}  // namespace dresslife::sim
