#include "sim/route/preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/job/line_key.h"
#include "pipeline/job/setup.h"
#include "sim/rod/start_curve.h"
#include "sim/route/bracket.h"
#include "sim/route/proposal.h"
#include "sim/run/cures.h"
#include "sim/run/longest_way.h"
#include "sim/run/motion_file.h"
#include "sim/run/other_stiffness.h"
#include "sim/run/quick_checks.h"
#include "sim/run/routing.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {
namespace {

constexpr int most_shown = 240;  // moments of the program: 0.2 s of curves
constexpr int fewest_shown = 24;
constexpr double shown_a_second = 5;
// per span: 0.4 s of equilibria; steps of 2 %, as for remedies (sim/run/cures.cpp)
constexpr int tried_lengths = 16, tried_poses = 8;
constexpr double before_the_program = -1;  // time of the mounting pose [s]

struct ShownMoment {
  double time = 0;
  int step = 0;
  Pose pose;
};

/// Returns the values of a routing near the given one that keeps all limits; empty: none was found.
pipeline::Remedy remedy_near(const pipeline::Setup& setup) {
  if (setup.dresspacks.size() > 1) return {};
  std::optional<pipeline::Routing> found;
  try {
    found = routing_near(setup);
  } catch (const pipeline::InputError&) {  // the job's own errors are reported elsewhere
  }
  if (!found) return {};
  const pipeline::Routing& now = setup.dresspacks.front().routing;
  pipeline::Remedy remedy;
  const auto key_of = [&](const std::string& key) { return pipeline::line_key(setup, 0, "routing." + key); };
  const auto add_clamp = [&](const std::string& key, const pipeline::Clamp& from, const pipeline::Clamp& to) {
    const auto text = [](const Vector3& v, int digits) {
      return fmt::format("[{:.{}f}, {:.{}f}, {:.{}f}]", v.x(), digits, v.y(), digits, v.z(), digits);
    };
    if (from.position != to.position) remedy.values.push_back({key_of(key + ".position_m"), text(to.position, 3)});
    if (from.direction != to.direction) remedy.values.push_back({key_of(key + ".direction"), text(to.direction, 2)});
  };
  add_clamp("base_clamp", *now.base_clamp, *found->base_clamp);
  add_clamp("tool_clamp", *now.tool_clamp, *found->tool_clamp);
  if (now.free_length != found->free_length)
    remedy.values.push_back({key_of("free_length_m"), fmt::format("{:.3f}", found->free_length)});
  const double base = (found->base_clamp->position - now.base_clamp->position).norm(),
               tool = (found->tool_clamp->position - now.tool_clamp->position).norm();
  const std::string places =
      base + tool > 0 ? fmt::format("clamps {:.0f} and {:.0f} mm from their places, where a bracket can be built",
                                    1e3 * base, 1e3 * tool)
                      : "clamps at their places";
  remedy.words = fmt::format(" ({}; keeps the limits of the hose in a run with the job's own values)", places);
  return remedy;
}

class Previewer {
 public:
  explicit Previewer(const pipeline::Job& job)
      : job_(job),
        rod_(rod_of(job)),
        path_(path_of(job)),
        robot_(dynamic_cast<const RobotPath*>(path_.get())),
        longest_(longest_ways(job, rod_, *path_, job.simulation.time_step)) {
    if (robot_ && robot_->mounting_pose() != robot_->motion().position(0))
      moments_.push_back({before_the_program, 0, robot_->pose(robot_->mounting_pose())});
    const double duration = path_->duration();
    const int count = std::clamp(static_cast<int>(duration * shown_a_second), fewest_shown, most_shown);
    std::vector<double> times{0};
    for (int k = 1; k <= count && duration > 0; ++k) times.push_back(duration * k / count);
    for (const LongestWay& longest : longest_) times.push_back(longest.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    for (const double time : times) moments_.push_back({time, path_->step(time), path_->at(time)});
    find_ways();
  }

  void write(pipeline::FileWriter& file) {
    write_heads(file);
    for (std::size_t k = 0; k < moments_.size(); ++k) write_moment(file, k);
    if (robot_)
      file.dataset_attribute("/robot/link_pose", "links",
                             pipeline::joined(pipeline::mapped(job_.robot.links, &pipeline::Link::name), ","));
    write_spans(file);
    write_scan(file);
    std::optional<pipeline::Remedy> other_places;  // several warnings have the same remedy
    QuickWarnings quick = quick_warnings(job_, longest_, [&] {
      if (!other_places) other_places = remedy_near(job_);
      return *other_places;
    });
    // Without other limits to cure first: a run finds the same, after minutes.
    if (!quick.run.checks.empty() &&
        std::ranges::none_of(quick.run.checks, [](const Check& check) { return check.warning; }))
      quick.warnings = pipeline::joined(std::move(quick.warnings), other_stiffness_warnings(job_, quick.run));
    if (robot_ && !robot_->note().empty()) quick.notes.push_back(robot_->note());
    if (robot_)
      for (const std::string& assumed : robot_->assumed()) quick.notes.push_back(assumed);
    const auto space = robot_ ? unknown_tool_space(job_, robot_->tools()) : std::nullopt;
    if (space) quick.notes.push_back(tool_space_note(space));
    quick.warnings = pipeline::joined(std::move(quick.warnings), clamp_warnings(job_, space));
    write_refusal(quick.warnings, file);
    file.attribute("warnings", pipeline::warnings_text(quick.warnings));
    file.attribute("short_run", std::string(word(quick.followed)));
    file.attribute("notes", pipeline::joined(quick.notes, "\n"));
  }

 private:
  const RodProperties& properties(std::size_t span) const { return rod_.spans()[span].properties; }
  bool is_free(std::size_t span) const { return properties(span).tool_end == End::free; }
  double way(std::size_t moment, std::size_t span) const { return ways_[moment * rod_.spans().size() + span]; }

  void find_ways() {
    for (const ShownMoment& moment : moments_) {
      const std::vector<double> ways = shortest_ways(job_, rod_, moment.pose.clamps, moment.pose.rings);
      for (std::size_t span = 0; span < ways.size(); ++span) ways_.push_back(is_free(span) ? 0 : ways[span]);
    }
  }

  void write_heads(pipeline::FileWriter& file) const {
    const std::vector<int> before = clamp_segments(rod_);
    std::vector<double> lengths;
    std::vector<std::int32_t> dresspacks;
    for (int i = 0; i < rod_.segments(); ++i) {
      lengths.push_back(rod_.span_of(i).segment_length);
      dresspacks.push_back(rod_.span_of(i).dresspack);
    }
    file.set_axis("segment", lengths.size());
    file.set_axis("clamp", before.size());
    file.set_axis("dresspack", job_.dresspacks.size());
    file.set_axis("span", rod_.spans().size());
    if (robot_) {
      file.set_axis("joint", job_.robot.axes());
      file.set_axis("link", job_.robot.links.size());
    }
    file.append("/segment/length", lengths);
    file.append("/segment/dresspack", dresspacks);
    file.append("/dresspack/name", pipeline::mapped(job_.dresspacks, &pipeline::MountedDresspack::name));
    if (before.size() > 2) file.append("/clamp/segment", before);
    file.append("/program/text", path_->step_texts());
  }

  /// Returns the curve through the guide rings. The pieces between them share the segments in proportion to their straight
  /// distances.
  std::vector<Vector3> curve(std::size_t span, const Pose& pose) const {
    const Span& of = rod_.spans()[span];
    std::vector<Frame> ends{pose.clamps.end(static_cast<int>(2 * span))};
    const std::vector<RoutedRing> routed = routed_rings(job_);
    for (std::size_t r = 0; r < pose.rings.size(); ++r)
      if (routed[r].span == static_cast<int>(span)) ends.push_back(pose.rings[r]);
    ends.push_back(pose.clamps.end(static_cast<int>(2 * span) + 1));
    if (of.segments() < 2 * static_cast<int>(ends.size() - 1)) ends = {ends.front(), ends.back()};
    std::vector<double> so_far{0};
    for (std::size_t k = 1; k < ends.size(); ++k)
      so_far.push_back(so_far.back() + (ends[k].position - ends[k - 1].position).norm());
    std::vector<Vector3> line;
    const int pieces = static_cast<int>(ends.size()) - 1;
    int done = 0;
    for (int k = 1; k <= pieces; ++k) {
      const int wanted =
          so_far.back() > 0 ? static_cast<int>(std::lround(of.segments() * so_far[k] / so_far.back())) : 0;
      const int up_to = k == pieces ? of.segments() : std::clamp(wanted, done + 2, of.segments() - 2 * (pieces - k));
      RodProperties piece = of.properties;
      piece.slider.reset();
      piece.segments = up_to - done;
      piece.length = piece.segments * of.segment_length;
      if (k < pieces) piece.tool_end = End::clamped, piece.tip_mass = 0;
      const Rod rod(piece);
      const ClampFrames clamps{ends[k - 1], ends[k]};
      const RodState state = piece.tool_end == End::free ? rod.straight(clamps.base) : start_curve(rod, clamps).state;
      line.insert(line.end(), state.position.begin(), state.position.end());
      done = up_to;
    }
    return line;
  }

  void write_moment(pipeline::FileWriter& file, std::size_t k) const {
    const ShownMoment& moment = moments_[k];
    std::vector<double> centres, clamps, links, joints;
    std::vector<Vector3> last;
    Pose pose = moment.pose;
    for (std::size_t span = 0; span < rod_.spans().size(); ++span) {
      const std::vector<Vector3> line = curve(span, pose);
      for (const Vector3& centre : line) put(centres, centre);
      if (is_free(span)) pose.clamps.end(static_cast<int>(2 * span) + 1).position = line.back();
    }
    for (const Frame& clamp : listed_clamps(rod_, pose.clamps)) put(clamps, clamp.position);
    file.append("/time", std::array{path_->program_time(moment.time)});
    file.append("/segment/position", centres);
    file.append("/clamp/position", clamps);
    file.append("/program/step", std::array{moment.step});
    file.append("/span/way", std::span<const double>(&ways_[k * rod_.spans().size()], rod_.spans().size()));
    if (!robot_) return;
    for (const Frame& link : pose.links) {
      put(links, link.position);
      put(links, link.orientation);
    }
    file.append("/robot/link_pose", links);
    file.append("/robot/joint_position", std::span<const double>(pose.joints.data(), job_.robot.axes()));
  }

  void write_spans(pipeline::FileWriter& file) const {
    std::vector<std::string> names;
    std::vector<double> working;
    for (std::size_t span = 0; span < rod_.spans().size(); ++span) {
      const Span& of = rod_.spans()[span];
      const std::size_t piece = span - static_cast<std::size_t>(rod_.first_span(of.dresspack));
      names.push_back(pipeline::between_clamps(job_.dresspacks[static_cast<std::size_t>(of.dresspack)].routing, piece));
      for (const double longest : {way(0, span), std::max(longest_[span].way, way(0, span))}) {
        const WorkingLength here = working_length(longest);
        working.insert(working.end(), {here.least, here.most});
      }
    }
    file.append("/span/dresspack", pipeline::mapped(rod_.spans(), &Span::dresspack));
    file.append("/span/name", names);
    file.append("/span/length", pipeline::mapped(rod_.spans(), [](const Span& of) { return of.properties.length; }));
    file.append("/span/working_length", working);
  }

  /// Returns the first pose, those with the nearest and the farthest clamps, and others at equal distances between.
  std::vector<Pose> poses_to_try(std::size_t span) const {
    std::vector<Pose> poses{moments_.front().pose, path_->at(longest_[span].time)};
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < moments_.size(); ++k)
      if (way(k, span) < way(nearest, span)) nearest = k;
    poses.push_back(moments_[nearest].pose);
    for (int k = 1; k <= tried_poses - 3; ++k)
      poses.push_back(moments_[k * (moments_.size() - 1) / (tried_poses - 2)].pose);
    return poses;
  }

  void write_scan(pipeline::FileWriter& file) const {
    constexpr int segments = 32;  // enough for a bend radius with an error of a few percent
    std::vector<std::int32_t> spans;
    std::vector<double> lengths, radii;
    for (std::size_t span = 0; span < rod_.spans().size(); ++span) {
      const std::vector<RoutedRing> rings = routed_rings(job_);
      const bool ringed = std::any_of(rings.begin(), rings.end(),
                                      [&](const RoutedRing& ring) { return ring.span == static_cast<int>(span); });
      if (is_free(span) || ringed || properties(span).slider || !(longest_[span].way > 0)) continue;
      const WorkingLength range = working_length(std::max(longest_[span].way, way(0, span)));
      const std::vector<Pose> poses = poses_to_try(span);
      for (int k = 0; k < tried_lengths; ++k) {
        RodProperties of = properties(span);
        of.segments = std::min(of.segments, segments);
        of.length = range.least * std::pow(range.most / range.least, static_cast<double>(k) / (tried_lengths - 1));
        double most = 0;
        for (const Pose& pose : poses)
          most = std::max(most, curvature_at_rest(of, {pose.clamps.end(static_cast<int>(2 * span)),
                                                       pose.clamps.end(static_cast<int>(2 * span) + 1)}));
        spans.push_back(static_cast<std::int32_t>(span));
        lengths.push_back(of.length);
        radii.push_back(1 / most);  // 0: no equilibrium was found
      }
    }
    if (spans.empty()) return;
    file.append("/scan/span", spans);
    file.append("/scan/length", lengths);
    file.append("/scan/bend_radius", radii);
  }

  /// Writes the refusal in the words of the simulation; if a span is too short, with the moment of the largest lack.
  /// Without a second search for a remedy if a warning of slack exists.
  void write_refusal(const std::vector<pipeline::Warning>& warnings, pipeline::FileWriter& file) const {
    const bool warns_of_slack = std::any_of(warnings.begin(), warnings.end(), [](const pipeline::Warning& warning) {
      return warning.kind == pipeline::WarningKind::slack;
    });
    std::string refusal;
    try {
      const Simulation simulation(job_);
    } catch (const RoutingRefusal& problem) {
      refusal = pipeline::InputError(problem.where, problem.problem,
                                     warns_of_slack ? "see the remedy of the warning" : refusal_remedy(job_, problem))
                    .what();
    } catch (const pipeline::InputError& problem) {
      refusal = problem.what();
    }
    file.attribute("refusal", refusal);
    if (refusal.empty()) return;
    double most = 0;
    std::optional<double> when;
    for (std::size_t span = 0; span < longest_.size(); ++span) {
      const double missing = longest_[span].way - properties(span).length;
      if (!is_free(span) && missing > most) most = missing, when = longest_[span].time;
    }
    if (when) file.attribute("refusal_time", path_->program_time(*when));
  }

  const pipeline::Job& job_;
  Rod rod_;
  std::unique_ptr<ClampPath> path_;
  const RobotPath* robot_;
  std::vector<LongestWay> longest_;  // (span) over the program; it may occur between the shown moments
  std::vector<ShownMoment> moments_;
  std::vector<double> ways_;  // (moment, span)
};

}  // namespace

void write_preview(const pipeline::Job& job, pipeline::FileWriter& file) { Previewer(job).write(file); }

}  // namespace dresslife::sim
