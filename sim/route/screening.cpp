#include "sim/route/screening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "pipeline/base/statistics.h"
#include "pipeline/job/setup.h"
#include "sim/robot/robot.h"
#include "sim/rod/start_curve.h"
#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"
#include "sim/run/equilibrium.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

constexpr double moments_a_second = 10;
constexpr int fewest_moments = 100, most_moments = 2000;  // 2 ms for the distances
constexpr int drawn_poses = 16;                           // 0.1 ms for each curve
constexpr int curve_segments = 16;                        // each a sixteenth of the length
constexpr int carried_moments = 40;                       // from the mounting pose to the first waypoint
constexpr double overlap_share = 0.5;  // share of the diameter that is pushed out while mounting (R7)
constexpr double unasked = -std::numeric_limits<double>::infinity();
constexpr double whole_turn = 2 * std::numbers::pi;

struct Moment {
  double time = 0;
  std::vector<Frame> links;  // links of the robot
  ClampFrames recorded;      // without a robot
};

/// A frame on a link.
struct ThreadNode {
  int link = no_link;
  Frame local;
};

/// A span with its nodes: its base end, its rings, its tool end.
struct Thread {
  const Span* span = nullptr;
  std::vector<ThreadNode> nodes;
  int recorded_end = 0;                    // index of its base end among the recorded clamps
  double rings_save = 0;                   // length that a hose saves by passing the rings off-centre [m]
  std::optional<double> turn_at_mounting;  // given by the clamp's roll [rad]; absent: without twist
  double pre_twist = 0;                    // [rad]
  MotionLimits limits;
};

using Frames = std::vector<Frame>;

Frames frames_of(const Thread& thread, const Moment& moment) {
  if (moment.links.empty())
    return {moment.recorded.end(thread.recorded_end), moment.recorded.end(thread.recorded_end + 1)};
  Frames frames;
  for (const ThreadNode& node : thread.nodes) frames.push_back(moment.links[node.link] * node.local);
  return frames;
}

double way_of(const Thread& thread, const Frames& frames) {
  Vector3 from = frames.front().position;
  if (const auto& slider = thread.span->properties.slider) {
    const Vector3 d = tangent(frames.front().orientation);
    from += std::clamp(d.dot(frames[1].position - from), 0.0, slider->stroke) * d;
  }
  double way = -thread.rings_save;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    way += (frames[k].position - from).norm();
    from = frames[k].position;
  }
  return way;
}

Quaternion transported(const Quaternion& q, const Vector3& t) { return turn_between(tangent(q), t) * q; }

/// Returns the rotation about the tangent [rad], up to full turns, by transport from frame to chord to frame.
double turn_by_chords(const Frames& frames) {
  double turn = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const Vector3 chord = frames[k].position - frames[k - 1].position;
    Quaternion q = frames[k - 1].orientation;
    if (chord.norm() > 0) q = transported(q, chord.normalized());
    q = transported(q, tangent(frames[k].orientation));
    turn += rotation_vector(q.conjugate() * frames[k].orientation).z();
  }
  return turn;
}

double near(double angle, double to) { return angle + whole_turn * std::round((to - angle) / whole_turn); }

/// The curve of a thread through its nodes.
struct Drawn {
  std::vector<Vector3> points;  // centres of the segments
  double curvature = 0;         // largest [1/m]
  double turn = 0;              // rotation about the tangent, up to full turns [rad]
};

/// Returns the pieces; piece k leads from frame k to the next one. Pieces share the length in proportion to their straight
/// distances.
std::vector<RodProperties> pieces_of(const Thread& thread, const Frames& frames, End tool_end) {
  std::vector<double> ways;
  for (std::size_t k = 1; k < frames.size(); ++k)
    ways.push_back(std::max(1e-6, (frames[k].position - frames[k - 1].position).norm()));
  const double whole = std::accumulate(ways.begin(), ways.end(), 0.0);
  std::vector<RodProperties> pieces(ways.size(), thread.span->properties);
  for (std::size_t k = 0; k < ways.size(); ++k) {
    pieces[k].slider.reset();
    if (k > 0) pieces[k].stiff_ends[0] = {};
    if (k + 1 < ways.size()) pieces[k].stiff_ends[1] = {};
    pieces[k].tool_end = tool_end;
    pieces[k].length *= ways[k] / whole;
    pieces[k].segments = std::max(fewest_segments, static_cast<int>(std::lround(curve_segments * ways[k] / whole)));
  }
  return pieces;
}

double largest_curvature(const Rod& rod, const RodState& state) {
  double most = 0;
  for (int link = 0; link < rod.links(); ++link)
    most = std::max(most, rod.curvature(rod.link_state(state, link).turn, link));
  return most;
}

/// Returns a curve with the excess length in a sag or in a round arch, whichever bends less.
StartCurve smoother_curve(const Rod& rod, const ClampFrames& clamps) {
  constexpr double of_an_arch = 4;  // in lengths: half a circle has 1.3
  constexpr int halvings = 22;      // resolution of a millionth of the length; values are shown to a hundredth
  const StartCurve sagging = start_curve(rod, clamps, 1, halvings);
  const StartCurve arch = start_curve(rod, clamps, of_an_arch, halvings);
  return largest_curvature(rod, arch.state) < largest_curvature(rod, sagging.state) ? arch : sagging;
}

Drawn drawn(const Thread& thread, const Frames& frames) {
  Drawn curve;
  const std::vector<RodProperties> pieces = pieces_of(thread, frames, End::clamped);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Rod rod(pieces[k]);
    const StartCurve start = smoother_curve(rod, {frames[k], frames[k + 1]});
    curve.curvature = std::max(curve.curvature, largest_curvature(rod, start.state));
    curve.turn += start.roll_to_tool;
    curve.points.insert(curve.points.end(), start.state.position.begin(), start.state.position.end());
  }
  return curve;
}

/// Returns the largest curvature of the pieces at rest [1/m].
double curvature_at_rest(const Thread& thread, const Frames& frames) {
  constexpr double no_rest = 100;  // [1/m], if no equilibrium is found
  EquilibriumSettings settings;
  settings.iterations = 60;   // most equilibria take 20
  settings.tolerance = 1e-3;  // of the forces
  double most = 1e-6;
  const std::vector<RodProperties> pieces = pieces_of(thread, frames, End::swivel);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Rod rod(pieces[k]);
    const Equilibrium found = find_equilibrium(rod, {frames[k], frames[k + 1]}, settings);
    most = std::max(most, found.status == EquilibriumStatus::converged ? largest_curvature(rod, found.state) : no_rest);
  }
  return most;
}

}  // namespace

bool Screening::rejected() const {
  for (std::size_t k = 0; k < beyond.size(); ++k)
    if (beyond[k] > surely_beyond[k]) return true;
  return false;
}

struct Screener::Parts {
  std::vector<Moment> moments;       // first the moments from the mounting pose to the start
  std::size_t first = 0;             // index of the first moment of the program
  std::vector<std::size_t> poses;    // poses with curves, in order
  std::optional<Surfaces> surfaces;  // for a robot with brackets
  pipeline::Robot robot;             // with surfaces
  std::vector<Frames> carriers;      // (moment, link), for brackets

  void add_robot(const pipeline::Setup& setup, const RobotPath& path);
  void choose_poses(const std::vector<Eigen::VectorXd>& joints);
  std::vector<Thread> threads(const pipeline::Setup& setup, const Rod& rod) const;
  void see(const pipeline::Setup& setup, const Thread& thread, Screening& screening) const;
  double depth(const pipeline::Setup& setup, const Thread& thread, const Moment& moment,
               const std::vector<Vector3>& points) const;
};

Screener::Screener(const pipeline::Setup& setup, bool brackets) : parts_(std::make_unique<Parts>()) {
  const std::unique_ptr<ClampPath> path = path_of(setup);
  if (const auto* robot = dynamic_cast<const RobotPath*>(path.get())) {
    parts_->add_robot(setup, *robot);
    if (!brackets) return;
    parts_->surfaces.emplace(setup);
    parts_->robot = setup.robot;
    for (const Moment& moment : parts_->moments) parts_->carriers.push_back(moment.links);
    return;
  }
  const int count = std::clamp(static_cast<int>(path->duration() * moments_a_second), fewest_moments, most_moments);
  for (int k = 0; k <= count; ++k) {
    const double time = path->duration() * k / count;
    parts_->moments.push_back({time, {}, path->at(time).clamps});
  }
  for (int k = 0; k < drawn_poses; ++k)
    parts_->poses.push_back(static_cast<std::size_t>(count) * k / (drawn_poses - 1));
}

Screener::~Screener() = default;

void Screener::Parts::add_robot(const pipeline::Setup& setup, const RobotPath& path) {
  const RobotKinematics kinematics(setup.robot);
  std::vector<Eigen::VectorXd> joints;
  const auto add = [&](double time, const Eigen::VectorXd& q) {
    Moment moment{path.program_time(time), Frames(kinematics.links()), {}};
    kinematics.link_frames({q.data(), static_cast<std::size_t>(q.size())}, moment.links);
    moments.push_back(std::move(moment));
    joints.push_back(q);
  };
  const Eigen::VectorXd start = path.motion().position(0), mounting = path.mounting_pose();
  if (mounting != start)
    for (int k = 0; k < carried_moments; ++k) {
      const double share = static_cast<double>(k) / carried_moments;
      add(0, mounting + share * (start - mounting));
    }
  first = moments.size();
  const double duration = path.duration();
  const int count = std::clamp(static_cast<int>(duration * moments_a_second), fewest_moments, most_moments);
  std::vector<double> times;
  for (int k = 0; k <= count; ++k) times.push_back(duration * k / count);
  for (const MotionPiece& piece : path.motion().pieces())  // stops, at which distances are often largest
    if (times.size() < 2 * most_moments) times.push_back(piece.start);
  std::sort(times.begin(), times.end());
  for (const double time : times) add(time, path.motion().position(time));
  choose_poses(joints);
}

/// Chooses the first pose, then repeatedly the pose that is farthest from all chosen ones, by the axis that moves most.
void Screener::Parts::choose_poses(const std::vector<Eigen::VectorXd>& joints) {
  std::vector<double> distance(joints.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  for (int k = 0; k < drawn_poses && distance[next] > 0; ++k) {
    poses.push_back(next);
    for (std::size_t m = 0; m < joints.size(); ++m)
      distance[m] = std::min(distance[m], (joints[m] - joints[poses.back()]).lpNorm<Eigen::Infinity>());
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  std::sort(poses.begin(), poses.end());
}

std::vector<Thread> Screener::Parts::threads(const pipeline::Setup& setup, const Rod& rod) const {
  std::vector<Thread> list;
  const bool recorded = moments.front().links.empty();
  const std::vector<RoutedRing> rings = routed_rings(setup);
  for (int k = 0; k < static_cast<int>(rod.spans().size()); ++k) {
    const Span& span = rod.spans()[k];
    if (span.properties.tool_end == End::free) continue;
    const pipeline::MountedDresspack& mounted = setup.dresspacks[span.dresspack];
    const pipeline::Routing& routing = mounted.routing;
    Thread thread;
    thread.span = &span;
    thread.recorded_end = 2 * k;
    thread.limits = limits_of(mounted.dresspack);
    const auto between = static_cast<std::size_t>(k - rod.first_span(span.dresspack));
    const bool last = between == routing.clamps.size();
    if (last) thread.pre_twist = routing.pre_twist;
    const auto add = [&](const pipeline::Clamp& clamp) {
      thread.nodes.push_back({find_link(setup.robot, clamp.link, clamp.where), clamp_frame(clamp)});
    };
    if (!recorded) {
      add(between == 0 ? *routing.base_clamp : routing.clamps[between - 1].clamp);
      for (const RoutedRing& ring : rings)
        if (ring.span == k) {
          add({ring.ring.link, ring.ring.position, ring.ring.direction, {}, ring.ring.where});
          thread.rings_save += 2 * ring.clearance;
        }
      const pipeline::Clamp& end = last ? *routing.tool_clamp : routing.clamps[between].clamp;
      add(end);
      if (end.roll) thread.turn_at_mounting = 0;
    } else {
      thread.turn_at_mounting = 0;
    }
    list.push_back(std::move(thread));
  }
  return list;
}

/// Returns the overlap of points along a thread; near its ends the links that hold it are no obstacles.
double Screener::Parts::depth(const pipeline::Setup& setup, const Thread& thread, const Moment& moment,
                              const std::vector<Vector3>& points) const {
  const RodProperties& p = thread.span->properties;
  const double radius = p.diameter / 2, spacing = p.length / static_cast<double>(points.size());
  const auto held = static_cast<std::size_t>(std::ceil(1.5 * p.diameter / spacing));
  double deepest = unasked;
  const auto meet = [&](const auto& shapes, const Vector3& point) {
    deepest = std::max(deepest, radius - pipeline::distance_from(shapes.capsules, shapes.boxes, point));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (setup.simulation.floor) deepest = std::max(deepest, radius - points[i].z());
    if (!setup.simulation.contact) continue;
    meet(setup.cell, points[i]);
    for (const pipeline::Link& link : setup.robot.fixed_links) meet(link, points[i]);
    for (std::size_t link = 0; link < moment.links.size(); ++link) {
      const int of = static_cast<int>(link);
      if (i < held && of == thread.nodes.front().link) continue;
      if (i + held >= points.size() && of == thread.nodes.back().link) continue;
      const Frame& frame = moment.links[link];
      meet(setup.robot.links[link], frame.orientation.conjugate() * (points[i] - frame.position));
    }
  }
  return deepest;
}

void Screener::Parts::see(const pipeline::Setup& setup, const Thread& thread, Screening& screening) const {
  const auto keep = [&](ScreenedLimit limit, double g, double time) {
    const auto k = static_cast<std::size_t>(limit);
    if (g > screening.beyond[k]) screening.beyond[k] = g, screening.time[k] = time;
  };
  const RodProperties& p = thread.span->properties;
  double longest = 0, when = 0, turn = 0;
  std::vector<double> turns;
  for (std::size_t m = 0; m < moments.size(); ++m) {
    const Frames frames = frames_of(thread, moments[m]);
    if (const double way = way_of(thread, frames); m >= first && way > longest) longest = way, when = moments[m].time;
    turn = m == 0 ? turn_by_chords(frames) : near(turn_by_chords(frames), turn);
    turns.push_back(turn);
  }
  keep(ScreenedLimit::too_short, (longest - (1 - least_slack_share) * p.length) / p.length, when);  // (V1)
  keep(ScreenedLimit::too_long, ((1 - most_slack_share) * p.length - longest) / p.length, when);    // (V2)
  const double mounted = near(drawn(thread, frames_of(thread, moments.front())).turn, turns.front());
  const double untwisted =
      thread.turn_at_mounting ? *thread.turn_at_mounting + turns.front() - near(turns.front(), 0) : mounted;
  for (const std::size_t m : poses) {
    const Drawn curve = drawn(thread, frames_of(thread, moments[m]));
    const double time = moments[m].time;
    keep(ScreenedLimit::bend, std::log(thread.limits.least_bend_radius * std::max(curve.curvature, 1e-6)),
         time);  // (V3)
    const double twist = near(curve.turn, turns[m]) - untwisted + thread.pre_twist;
    keep(ScreenedLimit::twist, std::abs(twist) / (p.length * thread.limits.most_twist) - 1, time);  // (V4)
    keep(ScreenedLimit::overlap, depth(setup, thread, moments[m], curve.points) / p.diameter - overlap_share,
         time);  // (V5)
  }
}

std::vector<BracketBeyond> Screener::brackets(const pipeline::Setup& setup) const {
  std::vector<BracketBeyond> all;
  if (!parts_->surfaces) return all;
  for (std::size_t d = 0; d < setup.dresspacks.size(); ++d) {
    const pipeline::Routing& routing = setup.dresspacks[d].routing;
    const double diameter = setup.dresspacks[d].dresspack.diameter;
    const auto see = [&](const auto& place, double radius) {
      const BracketPlace on_link{find_link(setup.robot, place.link, place.where), place.position, radius};
      const BracketFit fit = bracket(on_link);
      all.push_back({d, on_link, fit.beyond(longest_bracket_of(routing), diameter), fit.moment});
    };
    for (const auto& clamp : {routing.base_clamp, routing.tool_clamp})
      if (clamp) see(*clamp, diameter / 2);
    for (const pipeline::IntermediateClamp& between : routing.clamps) see(between.clamp, diameter / 2);
    for (const pipeline::GuideRing& ring : routing.rings) see(ring, ring.radius);
  }
  return all;
}

BracketFit Screener::bracket(const BracketPlace& place) const {
  return fit_of(place, parts_->robot, *parts_->surfaces, parts_->carriers);
}
double Screener::time_of(std::size_t moment) const { return parts_->moments[moment].time; }

Screening Screener::screen(const pipeline::Setup& setup, std::span<const BracketBeyond> built) const {
  constexpr double same_place = 1e-3;  // [m]: no mounting is more exact
  constexpr double straight = 1e-6;    // [1/m]: its logarithm is finite
  Screening screening;
  screening.beyond.fill(unasked);
  screening.time.fill(0);
  for (const BracketBeyond& of : brackets(setup)) {
    const auto own = std::ranges::find_if(built, [&](const BracketBeyond& other) {
      return other.dresspack == of.dresspack && other.place.link == of.place.link &&
             (other.place.position - of.place.position).norm() < same_place;
    });
    const double g = of.beyond - (own == built.end() ? 0 : std::max(0.0, own->beyond));
    constexpr auto limit = static_cast<std::size_t>(ScreenedLimit::bracket);
    if (g > screening.beyond[limit]) screening.beyond[limit] = g, screening.time[limit] = time_of(of.moment);
  }
  if (parts_->surfaces)
    for (const WayOut& of : ways_out(setup, *parts_->surfaces)) {  // (V8)
      const double radius = limits_of(setup.dresspacks[of.dresspack].dresspack).least_bend_radius;
      double& bend = screening.beyond[static_cast<std::size_t>(ScreenedLimit::bend)];
      bend = std::max(bend, std::log(radius * std::max(of.curvature, straight)));
    }
  const Rod rod = rod_of(setup);
  for (const Thread& thread : parts_->threads(setup, rod)) parts_->see(setup, thread, screening);
  return screening;
}

double Screener::bend_at_rest(const pipeline::Setup& setup) const {
  constexpr std::size_t rests = 6;
  const Rod rod = rod_of(setup);
  double most = unasked;
  for (const Thread& thread : parts_->threads(setup, rod))
    for (std::size_t k = 0; k < rests; ++k) {
      const std::size_t pose = k * (parts_->poses.size() - 1) / (rests - 1);
      const Frames frames = frames_of(thread, parts_->moments[parts_->poses[pose]]);
      most = std::max(most, std::log(thread.limits.least_bend_radius * curvature_at_rest(thread, frames)));
    }
  return most;
}

std::vector<double> Screener::longest_ways(const pipeline::Setup& setup) const {
  const Rod rod = rod_of(setup);
  std::vector<double> ways(rod.spans().size(), 0.0);
  for (const Thread& thread : parts_->threads(setup, rod))
    for (std::size_t m = parts_->first; m < parts_->moments.size(); ++m) {
      double& longest = ways[static_cast<std::size_t>(thread.span - rod.spans().data())];
      longest = std::max(longest, way_of(thread, frames_of(thread, parts_->moments[m])));
    }
  return ways;
}

}  // namespace dresslife::sim
