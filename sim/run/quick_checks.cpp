#include "sim/run/quick_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/files/check_names.h"
#include "pipeline/job/setup.h"
#include "pipeline/resolve/plausible_job.h"
#include "sim/robot/loops.h"
#include "sim/run/cures.h"
#include "sim/run/equilibrium.h"
#include "sim/run/other_side.h"
#include "sim/run/routing.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {
namespace {

namespace check_name = pipeline::check_name;
using pipeline::WarningKind;

constexpr double long_program = 300;   // [s]: a run then takes some minutes
constexpr int rest_moments = 1000;     // of the program; equilibria are computed only after enough motion
constexpr int mounting_moments = 100;  // of the move from the mounting pose to the program
// Rotation between two equilibria: far below half a turn, at which the direction of rotation would be ambiguous.
constexpr double rest_turn = 20 * degree;
constexpr double rest_way =
    0.05;  // displacement between two equilibria as a share of the length: the sag of a hose is as large
constexpr double short_run_work =
    5e6;  // 2.4 s of processor time, measured: two repeats of three minutes, 64 segments without contact
constexpr double lead_in_share = 0.5;  // share for the lead-in: a motion that takes longer runs once, from rest
constexpr double same_radius = 0.05;   // relative error of a bend radius with few segments
constexpr double coarse_radius = 0.1;  // ESTIMATE: relative error of a bend radius in a coarse run

pipeline::Setup with_segments(pipeline::Setup setup, int most) {
  setup.simulation.segments = std::min(setup.simulation.segments, most);
  return setup;
}

pipeline::Setup with_short_waits(pipeline::Setup setup) {
  setup.motion.longest_wait = settled_after;
  return setup;
}

/// The equilibria of a span over the program.
struct Rests {
  std::vector<Check> checks;
  RodState begin;                 // state at the first target
  double roll = 0;                // roll of its tool clamp [rad]
  std::optional<double> unfound;  // time without an equilibrium [s]; absent: all were found
};

class QuickChecks {
 public:
  explicit QuickChecks(const pipeline::Setup& setup, std::vector<LongestWay> longest = {})
      : setup_(with_short_waits(setup)),
        rod_(rod_of(setup)),
        short_rod_(rod_of(with_segments(setup, short_run_segments))),
        rest_rod_(rod_of(with_segments(setup, rest_segments))),
        path_(path_of(setup_)),
        robot_(dynamic_cast<const RobotPath*>(path_.get())),
        longest_(longest.empty() ? longest_ways(setup, rod_, *path_, setup.simulation.time_step) : std::move(longest)) {
  }

  QuickFindings findings() {
    QuickFindings found;
    add_slack(found.checks);
    if (robot_) found.others = robot_->doubts();
    const std::vector<pipeline::Warning> one_link = one_link_warnings(setup_);
    found.others = pipeline::joined(one_link, found.others);
    if (std::ranges::any_of(setup_.dresspacks,
                            [&](const auto& of) { return pipeline::clamps_exchanged(of.routing, setup_.robot); }) ||
        (robot_ && robot_->clamps_in_world()) ||
        (!one_link.empty() && std::ranges::any_of(found.checks, &Check::warning))) {
      found.checks.clear();
      found.followed = Followed::none;
      found.notes.push_back(
          "The short run of the checks was left out. Correct the clamps first: the other limits follow from them");
      return found;
    }
    if (std::ranges::any_of(found.checks, [](const Check& check) {
          return check.name == check_name::too_long && check.value > 2 * check.limit;
        })) {
      found.followed = Followed::none;
      found.notes.push_back(
          "The short run of the checks was left out, because the hose is far too long. Correct the length first");
      return found;
    }
    found.run = short_run(setup_, short_run_segments);
    add_rests(found, true);
    add_run(found);
    if (found.run.stopped_at) {
      found.followed = Followed::begin;
      found.notes.push_back(
          fmt::format("The short run of the checks ended after {:.3g} s of {:.6g} s, because the program is long "
                      "or the dresspack touches much. `dresslife run` checks all of it",
                      *found.run.stopped_at, path_->program_duration()));
    }
    add_rubbing(found.run, found.notes);
    if (found.run.refusal.empty() && !found.run.stopped_at) {
      pipeline::Setup few = with_segments(setup_, short_run_segments);
      few.simulation.most_repeats = std::min(few.simulation.most_repeats, 2);  // as in the short run
      found.others = pipeline::joined(
          std::move(found.others),
          other_side_warnings(few, found.run.time_step, {*found.run.begin, found.run.end}, short_run_work));
    }
    add_winding(found.others);
    add_zero_pose(found.notes);
    if (const double lasts = path_->program_duration(); lasts > long_program)
      found.notes.push_back(fmt::format(
          "The program lasts {:.0f} s, with all passes of its main loop. A run simulates it several times, also "
          "with other stiffnesses of the hose. For first trials motion.passes: 1 shortens an endless loop",
          lasts));
    return found;
  }

  QuickFindings findings_unless(const std::function<bool(const QuickFindings&)>& rejects, double useless_below,
                                int dresspack) {
    QuickFindings found;
    add_slack(found.checks);
    const std::vector<Check> slack = found.checks;
    if (rejects(found)) return found;
    found.run = coarse_run(useless_below, dresspack);
    const double work = found.run.work;
    add_run(found);
    for (Check& check : found.checks)
      if (check.name == check_name::tension ||
          (check.name == check_name::bend_radius && check.value > (1 - coarse_radius) * check.limit))
        check.warning = false;
    if (!found.run.refusal.empty() || rejects(found)) return found;
    found.checks = slack;
    found.run = short_run(setup_, short_run_segments, useless_below, dresspack);
    found.run.work += work;
    add_run(found);
    if (!found.run.refusal.empty() || rejects(found)) return found;
    found.checks = slack;
    add_rests(found, false);
    add_run(found);
    return found;
  }

  QuickWarnings warnings(const std::function<pipeline::Remedy()>& other_places) {
    QuickFindings found = findings();
    const CheckedMotion motion{setup_, [&](double time) { return moment(time); }, &rod_, path_.get(), other_places};
    // A bend that exists at rest is not reported a second time for the motion. Remedies consider both.
    std::vector<Check> said = found.checks;
    for (Check& check : said)
      if (check.name == check_name::bend_radius && std::ranges::any_of(said, [&](const Check& other) {
            return other.name == check_name::bend_radius_at_rest && other.warning && other.dresspack == check.dresspack;
          }))
        check.warning = false;
    std::vector<pipeline::Warning> cured = check_warnings(motion, said);
    if (found.run.taut_at) cured.push_back(taut_warning(motion, found.run));
    if (!cured.empty() && std::ranges::any_of(found.others, [](const pipeline::Warning& other) {
          return other.words.find(" instead of ") != std::string::npos;
        }))
      found.notes.push_back(
          "Correct the doubtful numbers first: the limits that the dresspack passes may follow from them");
    return {pipeline::joined(std::move(found.others), cured), std::move(found.notes), std::move(found.run),
            found.followed};
  }

 private:
  /// Returns one repeat from rest with twice the step and few segments. Half of the segments, half of the steps and no
  /// lead-in: about a sixth of the work of a short run.
  ShortRun coarse_run(double useless_below, int dresspack) const {
    pipeline::Setup coarse = setup_;
    pipeline::SimulationSettings& settings = coarse.simulation;
    if (settings.choose_time_step) settings.time_step = first_step(settings.sample_rate);
    settings.choose_time_step = false;
    settings.time_step *= 2;
    settings.sample_rate /= 2;
    settings.most_repeats = 1;
    return short_run(std::move(coarse), rest_segments, (1 - coarse_radius) * useless_below, dresspack);
  }
  /// Adds bend radius and tension of the short run.
  static void add_run(QuickFindings& found) {
    for (const Check& check : found.run.checks) {
      if (check.name == check_name::tension) found.checks.push_back(check);
      if (check.name != check_name::bend_radius) continue;
      // At rest the hose hangs without contact to the robot, on which it may lie in reality. So a bend that the short run does
      // not have is not reported.
      for (Check& other : found.checks)
        if (other.name == check_name::bend_radius_at_rest && other.dresspack == check.dresspack)
          other.warning &= check.warning || found.run.stopped_at.has_value();
      found.checks.push_back(check);
    }
  }
  std::string moment(double time) const { return path_->moment(time); }
  const RodProperties& properties(std::size_t span) const { return rod_.spans()[span].properties; }
  bool is_free(std::size_t span) const { return properties(span).tool_end == End::free; }
  /// Returns the middle of a span; -1 if it is the only one.
  double middle(std::size_t span) const {
    const Span& of = rod_.spans()[span];
    const int count = rod_.first_span(of.dresspack + 1) - rod_.first_span(of.dresspack);
    return count == 1 ? -1 : of.first_arc + of.properties.length / 2;
  }

  /// Adds the least and the most slack of the spans of each dresspack at the largest straight way over the program.
  void add_slack(std::vector<Check>& checks) const {
    for (int d = 0; d < rod_.dresspacks(); ++d) {
      const auto first = static_cast<std::size_t>(rod_.first_span(d)),
                 end = static_cast<std::size_t>(rod_.first_span(d + 1));
      const auto share = [&](std::size_t span) { return 1 - longest_[span].way / properties(span).length; };
      std::size_t tight = end, loose = end;
      for (std::size_t span = first; span < end; ++span) {
        if (is_free(span)) continue;
        if (tight == end || share(span) < share(tight)) tight = span;
        if (loose == end || share(span) > share(loose)) loose = span;
      }
      if (tight == end || properties(tight).slider) continue;  // only a run knows the travel of the retraction unit
      const auto add = [&](const char* name, std::size_t span, double limit, bool broken) {
        checks.push_back({WarningKind::slack, name, "m", share(span) * properties(span).length, limit, broken,
                          longest_[span].time, middle(span), d});
      };
      add(check_name::too_short, tight, least_slack_share * properties(tight).length, share(tight) < least_slack_share);
      add(check_name::too_long, loose, most_slack_share * properties(loose).length, share(loose) > most_slack_share);
    }
  }

  /// Returns the clamps of a span at the moment u: from -1 (mounting pose) over 0 to 1 (end of the program).
  ClampFrames clamps_at(std::size_t span, double u) const {
    Pose pose;
    if (u >= 0) {
      pose = path_->at(u * path_->duration());
    } else {
      const Eigen::VectorXd from = robot_->mounting_pose();
      pose = robot_->pose(from + (1 + u) * (robot_->motion().position(0) - from));
    }
    return {pose.clamps.end(static_cast<int>(2 * span)), pose.clamps.end(static_cast<int>(2 * span) + 1)};
  }

  /// Returns the duration of all rounds of a loop but the first two: equilibria of equal poses are equal after one round [s].
  static double left_out(const MotionLoop& loop) { return (loop.rounds - 2) * loop.round; }

  /// Returns the moments in order: the mounting pose, if it is not the program's first pose, and the program.
  std::vector<double> moments() const {
    std::vector<double> all;
    if (robot_ && robot_->mounting_pose() != robot_->motion().position(0))
      for (int k = 0; k < mounting_moments; ++k) all.push_back(-1 + static_cast<double>(k) / mounting_moments);
    all.push_back(0);
    if (path_->duration() == 0) return all;
    const std::vector<MotionLoop> loops = robot_ ? loops_of(robot_->motion()) : std::vector<MotionLoop>{};
    double followed = path_->duration();
    for (const MotionLoop& loop : loops) followed -= left_out(loop);
    for (int k = 1; k <= rest_moments; ++k) {
      double time = followed * k / rest_moments;
      for (const MotionLoop& loop : loops)
        if (time > loop.end() - left_out(loop)) time += left_out(loop);
      all.push_back(time / path_->duration());
    }
    return all;
  }

  /// Returns a state whose segments follow the clamps, each in proportion to its position along the length.
  static RodState moved_along(RodState state, const ClampFrames& to) {
    const Quaternion base = to.base.orientation * state.clamps.base.orientation.conjugate();
    const Quaternion tool = to.tool.orientation * state.clamps.tool.orientation.conjugate();
    const std::size_t segments = state.position.size();
    for (std::size_t i = 0; i < segments; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(segments);
      const Vector3 with_base = to.base.position + base * (state.position[i] - state.clamps.base.position);
      const Vector3 with_tool = to.tool.position + tool * (state.position[i] - state.clamps.tool.position);
      state.position[i] = (1 - share) * with_base + share * with_tool;
      state.orientation[i] = (base.slerp(share, tool) * state.orientation[i]).normalized();
    }
    state.clamps = to;
    return state;
  }

  static bool moved(const ClampFrames& from, const ClampFrames& to, double length) {
    const Quaternion base = to.base.orientation * from.base.orientation.conjugate();
    const Quaternion tool = to.tool.orientation * from.tool.orientation.conjugate();
    const Vector3 way = to.tool.position - to.base.position - base * (from.tool.position - from.base.position);
    return base.angularDistance(tool) > rest_turn || base.angularDistance(Quaternion::Identity()) > rest_turn ||
           way.norm() > rest_way * length;
  }

  /// A span for the computation of its equilibria.
  struct Resting {
    RodProperties properties;
    std::size_t span;
    double base_roll;  // roll of its base clamp [rad]
    double pre_twist;  // pre-twist of its tool clamp [rad]
    MotionLimits limits;
  };

  static EquilibriumSettings rest_settings() {
    EquilibriumSettings settings;
    settings.tolerance = 1e-4;  // of the forces: accurate enough for a picture
    return settings;
  }

  ClampFrames rolled_clamps(const Resting& of, double moment, double roll) const {
    const ClampFrames clamps = clamps_at(of.span, moment);
    return {rolled(clamps.base, of.base_roll), rolled(clamps.tool, roll)};
  }

  /// Returns the equilibria of a span in successive poses, each found from the previous one, so that full turns of the hose count
  /// as in a run (R7).
  Rests rests(const Resting& of, const TwistFreeClamp& start, const std::vector<double>& all) const {
    const Rod rod(of.properties);
    MotionChecks checks(rod, {of.limits});
    Rests result;
    result.roll = start.roll;
    RodState found = start.equilibrium.state;
    const auto follow = [&](const ClampFrames& clamps) {
      Equilibrium next = find_equilibrium(rod, clamps, moved_along(found, clamps), {}, rest_settings());
      if (next.status != EquilibriumStatus::converged) return false;
      found = std::move(next.state);
      return true;
    };
    bool resting = true;
    const int parts = static_cast<int>(std::ceil(std::abs(of.pre_twist) / rest_turn));
    for (int part = 1; part <= parts && resting; ++part)
      resting = follow(rolled_clamps(of, all.front(), result.roll = start.roll + of.pre_twist * part / parts));
    const auto look = [&](std::size_t k) {
      if (all[k] < 0) return;
      if (all[k] == 0) result.begin = found;
      checks.see(found, {}, all[k] * path_->duration());
    };
    if (resting)
      look(0);
    else
      result.unfound = 0;
    for (std::size_t now = 0; resting && now + 1 < all.size();) {
      const ClampFrames here = rolled_clamps(of, all[now], result.roll);
      std::size_t next = now + 1;
      while (next + 1 < all.size() && all[next] != 0 &&
             !moved(here, rolled_clamps(of, all[next], result.roll), of.properties.length))
        ++next;
      while (!(resting = follow(rolled_clamps(of, all[next], result.roll))) && next > now + 1)
        next = now + (next - now) / 2;
      if (resting)
        look(now = next);
      else
        result.unfound = std::max(0.0, all[next]) * path_->duration();
    }
    if (!result.unfound) result.checks = checks.table();
    return result;
  }

  /// Returns the equilibria for the shapes of a span; the first shape is the one nearest to the start of a run. all_shapes: whether
  /// the others are followed, too.
  std::vector<Rests> all_rests(std::size_t span, double base_roll, const std::optional<RodState>& begin,
                               bool all_shapes) const {
    const Span& of = rod_.spans()[span];
    const pipeline::MountedDresspack& mounted = setup_.dresspacks[static_cast<std::size_t>(of.dresspack)];
    const auto between = span - static_cast<std::size_t>(rod_.first_span(of.dresspack));
    const bool last = between == mounted.routing.clamps.size();
    const bool twist_free =
        robot_ && !(last ? *mounted.routing.tool_clamp : mounted.routing.clamps[between].clamp).roll;
    const Span &few = rest_rod_.spans()[span], &run = short_rod_.spans()[span];
    const Resting resting{few.properties, span, base_roll, last ? mounted.routing.pre_twist : 0,
                          limits_of(mounted.dresspack)};
    const std::vector<double> all = moments();
    const std::vector<double> mounting(all.begin(), std::ranges::find(all, 0.0) + 1);
    std::vector<TwistFreeClamp> shapes =
        rest_shapes(few.properties, rolled_clamps(resting, all.front(), 0), twist_free, rest_settings());
    if (shapes.empty()) return {{{}, {}, 0, 0.0}};
    if (begin && shapes.size() > 1) {
      std::vector<double> distances;
      for (const TwistFreeClamp& shape : shapes)
        distances.push_back(shape_distance(rests(resting, shape, mounting).begin, few, *begin, run));
      std::swap(shapes.front(), shapes[std::ranges::min_element(distances) - distances.begin()]);
      if (!all_shapes) shapes.resize(1);
    }
    return pipeline::mapped(shapes, [&](const TwistFreeClamp& shape) { return rests(resting, shape, all); });
  }

  /// Returns the largest distance of the segments of a span at rest from those beside them in the state of a run [m]; infinite: no
  /// shape.
  static double shape_distance(const RodState& rest, const Span& few, const RodState& begin, const Span& run) {
    if (rest.position.empty()) return std::numeric_limits<double>::infinity();
    double most = 0;
    for (int i = 0; i < few.segments(); ++i) {
      const int beside = run.first_segment + static_cast<int>((i + 0.5) * run.segments() / few.segments());
      most = std::max(
          most, (rest.position[static_cast<std::size_t>(i)] - begin.position[static_cast<std::size_t>(beside)]).norm());
    }
    return most;
  }

  /// Adds the checks at rest of the worst spans of each dresspack. Spans with rings or a retraction unit are left to a run.
  void add_rests(QuickFindings& result, bool all_shapes) {
    const std::vector<RoutedRing> rings = routed_rings(setup_);
    for (int d = 0; d < rod_.dresspacks(); ++d) {
      std::optional<Check> bend, twist, net;
      double roll = 0;
      for (auto span = static_cast<std::size_t>(rod_.first_span(d));
           span < static_cast<std::size_t>(rod_.first_span(d + 1)); ++span) {
        const bool ringed =
            std::ranges::any_of(rings, [&](const RoutedRing& ring) { return ring.span == static_cast<int>(span); });
        const double base_roll = std::exchange(roll, 0);
        if (is_free(span) || ringed || properties(span).slider || longest_[span].way >= properties(span).length)
          continue;
        const std::vector<Rests> shapes = all_rests(span, base_roll, result.run.begin, all_shapes);
        roll = shapes.front().roll;
        // If a short run has followed the motion, a missing equilibrium is no fault.
        if (shapes.front().unfound && !result.run.refusal.empty())
          result.others.push_back(no_rest(d, *shapes.front().unfound));
        add_shapes_note(d, shapes, result.notes);
        std::optional<Check> net_here;
        for (Check check : shapes.front().checks) {
          check.dresspack = d;
          check.position = middle(span);
          if (check.name == check_name::net_twist) net_here = check;
          if (check.name == check_name::bend_radius && (!bend || check.value < bend->value)) bend = check;
          if (check.name == check_name::twist && (!twist || std::abs(check.value) > std::abs(twist->value)))
            twist = check, net.reset();
        }
        if (!net) net = net_here;
      }
      if (bend) bend->name = check_name::bend_radius_at_rest, result.checks.push_back(*bend);
      if (twist) twist->name = "largest twist at rest", result.checks.push_back(*twist);
      if (net) result.checks.push_back(*net);
    }
  }

  void add_shapes_note(int dresspack, const std::vector<Rests>& shapes, std::vector<std::string>& notes) const {
    std::vector<double> radii;
    for (const Rests& shape : shapes)
      for (const Check& check : shape.checks)
        if (check.name == check_name::bend_radius &&
            std::ranges::none_of(radii, [&](double r) { return std::abs(r - check.value) <= same_radius * r; }))
          radii.push_back(check.value);
    if (radii.size() < 2) return;
    std::string others;
    for (std::size_t k = 1; k < radii.size(); ++k)
      others += fmt::format("{}{:.0f}", k == 1 ? "" : ", ", 1e3 * radii[k]);
    const double limit = limits_of(setup_.dresspacks[static_cast<std::size_t>(dresspack)].dresspack).least_bend_radius;
    notes.push_back(fmt::format(
        "Between these clamps {} can rest in {} different shapes. A run begins in the first one. There its smallest bend radius "
        "over the program is {:.0f} mm, in the other{} {} mm (limit {:.4g} mm). After mounting, bring the hose into the first shape: "
        "dresslife preview draws it",
        pipeline::dresspack_words(setup_, dresspack), radii.size(), 1e3 * radii.front(), radii.size() > 2 ? "s" : "",
        others, 1e3 * limit));
  }

  pipeline::Warning no_rest(int dresspack, double time) const {
    return pipeline::warning_of(
        WarningKind::bend_radius, "",
        fmt::format("{} has no shape at rest that was found, {}", pipeline::dresspack_words(setup_, dresspack),
                    moment(time)),
        "clamps that are exchanged or turned the wrong way, or a length that is too short for the way around the robot",
        fmt::format("the links, positions and directions of the clamps as they are built; or more {}",
                    setup_.dresspacks.size() > 1 ? "free length" : "routing.free_length_m"));
  }

  /// Adds a warning for a rotation of an axis by 180 deg or more between the mounting pose and the program's first pose,
  /// because the dresspack keeps this rotation for the whole program.
  void add_winding(std::vector<pipeline::Warning>& all) const {
    if (!robot_) return;
    const Eigen::VectorXd start = robot_->motion().position(0), mounting = robot_->mounting_pose();
    const std::vector<Axis> axes = axes_of(setup_.robot);
    for (std::size_t axis = 0; axis < setup_.robot.axes(); ++axis) {
      const double turn = start[static_cast<long>(axis)] - mounting[static_cast<long>(axis)];
      if (std::abs(turn) < 179.99 * degree) continue;  // half a turn that is rounded
      all.push_back(pipeline::warning_of(
          WarningKind::twist, "",
          fmt::format(
              "{} turns by {:.0f} deg (limit less than 180 deg) from routing.mounting_pose_deg to the first target of the program",
              axes[axis].name, turn / degree),
          "the pose in which the dresspack was clamped is a turn away from the program",
          fmt::format("routing.mounting_pose_deg with {:.1f} for {}, or leave it out: then the first target counts",
                      start[static_cast<long>(axis)] / degree, axes[axis].name)));
    }
  }

  /// Adds a note for each dresspack that rubs, with the obstacle on which it rubs most.
  void add_rubbing(const ShortRun& run, std::vector<std::string>& notes) const {
    for (int d = 0; d < rod_.dresspacks() && run.seconds > 0; ++d) {
      std::vector<double> work(run.obstacles.size());
      const RubbedPatch* most = nullptr;
      for (const RubbedPatch& patch : run.rubbed)
        if (patch.dresspack == d) work[patch.obstacle] += patch.work;
      const auto worst = static_cast<std::size_t>(std::ranges::max_element(work) - work.begin());
      if (worst == work.size() || work[worst] < least_rubbing_power * run.seconds) continue;
      for (const RubbedPatch& patch : run.rubbed)
        if (patch.dresspack == d && patch.obstacle == worst && (!most || patch.work > most->work)) most = &patch;
      const std::string& name = run.obstacles[worst];
      const std::string on = name == "cell" || name == "floor" ? "the " + name
                             : name == "dresspack"             ? "a dresspack"
                                                               : name;
      notes.push_back(fmt::format(
          "In the short run {} rubs on {} with {:.2g} W (mean of normal force times sliding speed), most {:.0f} mm from the base clamp, {}. "
          "{} A routing without this contact avoids the wear",
          pipeline::dresspack_words(setup_, d), on, work[worst] / run.seconds, 1e3 * most->position, moment(most->time),
          setup_.simulation.self_contact
              ? "`dresslife run` predicts the hours until the hose is worn through, which may be the shortest life."
              : "With simulation.self_contact=false `dresslife run` does not evaluate this wear."));
    }
  }

  /// Adds a question for a mounting pose of zeros, which may be a placeholder. The dresspack may also have been clamped there.
  void add_zero_pose(std::vector<std::string>& notes) const {
    if (!robot_ || !robot_->mounting_pose().isZero() || robot_->motion().position(0).isZero()) return;
    notes.push_back(
        "routing.mounting_pose_deg is 0 for all axes: the dresspack counts as clamped without twist in that pose. If the zeros are "
        "no pose of the robot in which it was clamped, leave the key out: then the first target counts");
  }

  const pipeline::Setup setup_;
  Rod rod_, short_rod_, rest_rod_;
  std::unique_ptr<ClampPath> path_;
  const RobotPath* robot_;
  std::vector<LongestWay> longest_;  // (span)
};

}  // namespace

ShortRun short_run(pipeline::Setup setup, int segments, double useless_below, int of) {
  ShortRun result;
  // One lead-in repeat and one evaluated repeat: twist that remains after the first may pull the hose taut in the second.
  setup.simulation.most_repeats = std::min(setup.simulation.most_repeats, 2);
  try {
    const Simulation simulation(with_segments(std::move(setup), segments));
    result.begin = simulation.start();
    RunSinks sinks{[&](const Sample& sample) { result.end = sample.state; }};
    if (!simulation.setup().simulation.choose_time_step)
      sinks.wanted = Wanted::checks;  // a choice needs the error of the step
    sinks.goes_on = [&](double work, bool leads_in) {
      return (result.work += work) <= (leads_in ? lead_in_share : 1) * short_run_work;
    };
    sinks.still_of_use = [&](const MotionChecks& checks) {
      for (int j = 0; j < simulation.rod().links(); ++j)
        if (simulation.rod().span_of_link(j).dresspack == of && checks.curvature()[j].value * useless_below > 1)
          return false;
      return true;
    };
    RunSummary summary = simulation.run(sinks);
    result.checks = std::move(summary.checks);
    result.rubbed = std::move(summary.rubbed);
    result.obstacles = std::move(summary.obstacles);
    result.seconds = summary.seconds;
    if (summary.stopped_at) result.stopped_at = simulation.path().program_time(*summary.stopped_at);
    result.periodic = !summary.returns || summary.periodic;
    result.distance = summary.distance;
    result.time_step = summary.time_step;
  } catch (const RoutingRefusal& refusal) {
    result.refusal = refusal.problem;
    result.taut = refusal.taut;
    result.dresspack = refusal.dresspack;
    result.work += refusal.work;
    if (result.begin) result.taut_at = refusal.time;
  } catch (const pipeline::InputError& problem) {
    result.refusal = problem.what();
  }
  return result;
}

QuickFindings quick_findings(const pipeline::Setup& setup) { return QuickChecks(setup).findings(); }
QuickFindings findings_unless(const pipeline::Setup& setup, const std::function<bool(const QuickFindings&)>& rejects,
                              double useless_below, int dresspack) {
  return QuickChecks(setup).findings_unless(rejects, useless_below, dresspack);
}
QuickWarnings quick_warnings(const pipeline::Setup& setup, std::vector<LongestWay> longest,
                             const std::function<pipeline::Remedy()>& other_places) {
  return QuickChecks(setup, std::move(longest)).warnings(other_places);
}

}  // namespace dresslife::sim
