#include "sim/route/quick_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "pipeline/base/warning_words.h"
#include "pipeline/files/check_names.h"
#include "pipeline/job/setup.h"
#include "sim/run/cures.h"
#include "sim/run/equilibrium.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

namespace check_name = pipeline::check_name;
using pipeline::WarningKind;

constexpr double degree = EIGEN_PI / 180;
constexpr int most_moments = 100'000;  // of the program; a run looks at every step
constexpr int rest_moments = 1000;     // of the program; a span rests in those between which it has moved enough
constexpr int mounting_moments = 100;  // of the way from the mounting pose to the program
constexpr int most_segments = 32;      // of a span at rest: a bend radius within a few percent
// Between two rests: far below the half turn at which the shorter way around is the other one.
constexpr double rest_turn = 20 * degree;
constexpr double rest_way = 0.05;  // the same for displacements, of the length: a hose sags by as much

class QuickChecks {
 public:
  explicit QuickChecks(const pipeline::Setup& setup)
      : setup_(setup), rod_(rod_of(setup)), path_(path_of(setup)), robot_(dynamic_cast<const RobotPath*>(path_.get())) {}

  std::vector<pipeline::Warning> warnings() {
    std::vector<Check> checks;
    add_slack(checks);
    std::vector<pipeline::Warning> all = robot_ ? robot_->doubts() : std::vector<pipeline::Warning>{};
    add_rests(checks, all);
    add_winding(all);
    return pipeline::joined(
        std::move(all),
        check_warnings({setup_, [&](double time) { return moment(time); }, &rod_, path_.get()}, checks));
  }

 private:
  std::string moment(double time) const {
    const int step = path_->step(time);
    return fmt::format("at {:.3f} s, program step {} '{}'", time, step + 1,
                       path_->step_texts()[static_cast<std::size_t>(step)]);
  }
  const RodProperties& properties(std::size_t span) const { return rod_.spans()[span].properties; }
  bool is_free(std::size_t span) const { return properties(span).tool_end == End::free; }
  /// Of a place in the middle of a span, -1 of the only one.
  double middle(std::size_t span) const {
    const Span& of = rod_.spans()[span];
    const int count = rod_.first_span(of.dresspack + 1) - rod_.first_span(of.dresspack);
    return count == 1 ? -1 : of.first_arc + of.properties.length / 2;
  }

  /// Longest straight way of each span over the program, step by step as a run sees it.
  void add_slack(std::vector<Check>& checks) {
    const std::size_t spans = rod_.spans().size();
    longest_.assign(spans, 0.0);
    when_.assign(spans, 0.0);
    const double step = std::max(setup_.simulation.time_step, path_->duration() / most_moments);
    const auto steps = static_cast<int>(std::ceil(path_->duration() / step));
    for (int k = 0; k <= steps; ++k) {
      const double time = std::min(k * step, path_->duration());
      const Pose pose = path_->at(time);
      const std::vector<double> ways = shortest_ways(setup_, rod_, pose.clamps, pose.rings);
      for (std::size_t span = 0; span < spans; ++span)
        if (!is_free(span) && ways[span] > longest_[span]) longest_[span] = ways[span], when_[span] = time;
    }
    for (int d = 0; d < rod_.dresspacks(); ++d) {
      const auto first = static_cast<std::size_t>(rod_.first_span(d)), end = static_cast<std::size_t>(rod_.first_span(d + 1));
      const auto share = [&](std::size_t span) { return 1 - longest_[span] / properties(span).length; };
      std::size_t tight = end, loose = end;
      for (std::size_t span = first; span < end; ++span) {
        if (is_free(span)) continue;
        if (tight == end || share(span) < share(tight)) tight = span;
        if (loose == end || share(span) > share(loose)) loose = span;
      }
      if (tight == end || properties(tight).slider) continue;  // what is pulled out is known to a run only
      const auto add = [&](const char* name, std::size_t span, double limit, bool broken) {
        checks.push_back({WarningKind::slack, name, "m", share(span) * properties(span).length, limit, broken, when_[span],
                          middle(span), d});
      };
      add(check_name::too_short, tight, least_slack_share * properties(tight).length, share(tight) < least_slack_share);
      add(check_name::too_long, loose, most_slack_share * properties(loose).length, share(loose) > most_slack_share);
    }
  }

  /// The clamps of a span at a moment u: from -1 (mounting pose) over 0 to 1 (end of the program).
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

  /// In order: the mounting pose, where it is not the program's first one, and the program.
  std::vector<double> moments() const {
    std::vector<double> all;
    if (robot_ && robot_->mounting_pose() != robot_->motion().position(0))
      for (int k = 0; k < mounting_moments; ++k) all.push_back(-1 + static_cast<double>(k) / mounting_moments);
    for (int k = 0; k <= rest_moments; ++k) all.push_back(static_cast<double>(k) / rest_moments);
    return all;
  }

  /// A state whose segments follow the clamps, each by its share of the length.
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

  /// A span at rest in pose after pose, each found from the one before, so that whole turns of the hose count as in a run
  /// (R7). base_roll: of its base clamp; tool_roll: found at its tool clamp [rad]. Sets unfound where no rest is found [s].
  std::vector<Check> rests(std::size_t span, double base_roll, double& tool_roll, std::optional<double>& unfound) const {
    const Span& of = rod_.spans()[span];
    const pipeline::Routing& routing = setup_.dresspacks[static_cast<std::size_t>(of.dresspack)].routing;
    const auto between = span - static_cast<std::size_t>(rod_.first_span(of.dresspack));
    const bool last = between == routing.clamps.size();
    const bool twist_free =
        robot_ && !(last ? *routing.tool_clamp : routing.clamps[between].clamp).roll;
    RodProperties p = of.properties;
    p.segments = std::min(p.segments, most_segments);
    const Rod rod(p);
    EquilibriumSettings settings;
    settings.tolerance = 1e-4;  // of the forces: a picture's worth
    MotionChecks checks(rod, {limits_of(setup_.dresspacks[static_cast<std::size_t>(of.dresspack)].dresspack)});
    const std::vector<double> all = moments();
    const auto rolled_clamps = [&](std::size_t k, double roll) {
      const ClampFrames clamps = clamps_at(span, all[k]);
      return ClampFrames{rolled(clamps.base, base_roll), rolled(clamps.tool, roll)};
    };
    Equilibrium found;
    if (twist_free) {
      TwistFreeClamp clamped = twist_free_roll(rod, rolled_clamps(0, 0), settings);
      tool_roll = clamped.roll;
      found = std::move(clamped.equilibrium);
    } else {
      found = find_equilibrium(rod, rolled_clamps(0, 0), settings);
    }
    const auto follow = [&](const ClampFrames& clamps) {
      Equilibrium next = find_equilibrium(rod, clamps, moved_along(found.state, clamps), {}, settings);
      if (next.status != EquilibriumStatus::converged) return false;
      found = std::move(next);
      return true;
    };
    bool resting = found.status == EquilibriumStatus::converged;
    const double pre_twist = last ? routing.pre_twist : 0, untwisted = tool_roll;
    const int parts = static_cast<int>(std::ceil(std::abs(pre_twist) / rest_turn));
    for (int part = 1; part <= parts && resting; ++part)
      resting = follow(rolled_clamps(0, tool_roll = untwisted + pre_twist * part / parts));
    const auto look = [&](std::size_t k) {
      if (all[k] >= 0) checks.see(found.state, {}, all[k] * path_->duration());
    };
    if (resting) look(0);
    for (std::size_t now = 0; resting && now + 1 < all.size();) {
      const ClampFrames here = rolled_clamps(now, tool_roll);
      std::size_t next = now + 1;
      while (next + 1 < all.size() && all[next] != 0 && !moved(here, rolled_clamps(next, tool_roll), p.length)) ++next;
      while (!(resting = follow(rolled_clamps(next, tool_roll))) && next > now + 1) next = now + (next - now) / 2;
      if (resting) look(now = next);
      else unfound = std::max(0.0, all[next]) * path_->duration();
    }
    if (!resting && !unfound) unfound = 0;
    return unfound ? std::vector<Check>{} : checks.table();
  }

  /// Of each dresspack's worst spans at rest. Spans with rings or a retraction unit are left to a run.
  void add_rests(std::vector<Check>& checks, std::vector<pipeline::Warning>& all) {
    const std::vector<RoutedRing> rings = routed_rings(setup_);
    for (int d = 0; d < rod_.dresspacks(); ++d) {
      std::optional<Check> bend, twist, net;
      double roll = 0;
      for (auto span = static_cast<std::size_t>(rod_.first_span(d)); span < static_cast<std::size_t>(rod_.first_span(d + 1)); ++span) {
        const bool ringed = std::any_of(rings.begin(), rings.end(), [&](const RoutedRing& ring) {
          return ring.span == static_cast<int>(span);
        });
        const double base_roll = std::exchange(roll, 0);
        if (is_free(span) || ringed || properties(span).slider || longest_[span] >= properties(span).length) continue;
        std::optional<double> unfound;
        const std::vector<Check> table = rests(span, base_roll, roll, unfound);
        if (unfound) all.push_back(no_rest(d, *unfound));
        std::optional<Check> net_here;
        for (Check check : table) {
          check.dresspack = d;
          check.position = middle(span);
          if (check.name == check_name::net_twist) net_here = check;
          if (check.name == check_name::bend_radius && (!bend || check.value < bend->value)) bend = check;
          if (check.name == check_name::twist && (!twist || std::abs(check.value) > std::abs(twist->value)))
            twist = check, net.reset();
        }
        if (!net) net = net_here;
      }
      if (bend) bend->name = check_name::bend_radius_at_rest, checks.push_back(*bend);
      if (twist) twist->name = "largest twist at rest", checks.push_back(*twist);
      if (net) checks.push_back(*net);
    }
  }

  pipeline::Warning no_rest(int dresspack, double time) const {
    return pipeline::warning_of(
        WarningKind::bend_radius, "",
        fmt::format("{} has no shape at rest that was found, {}", pipeline::dresspack_words(setup_, dresspack), moment(time)),
        "its clamps turn it so far that it snaps, or it is too short for its way around the robot",
        fmt::format("`dresslife run`, which follows its motion in time; or more {}",
                    setup_.dresspacks.size() > 1 ? "free length" : "routing.free_length_m"));
  }

  /// A turn of an axis between the pose in which the dresspack was clamped and the program's first one is in the
  /// dresspack for the whole program.
  void add_winding(std::vector<pipeline::Warning>& all) const {
    if (!robot_) return;
    const Eigen::VectorXd start = robot_->motion().position(0), mounting = robot_->mounting_pose();
    for (std::size_t axis = 0; axis < setup_.robot.joints.size() && static_cast<long>(axis) < start.size(); ++axis) {
      const double turn = start[static_cast<long>(axis)] - mounting[static_cast<long>(axis)];
      if (std::abs(turn) <= 180 * degree) continue;
      all.push_back(pipeline::warning_of(
          WarningKind::twist, "",
          fmt::format("{} turns by {:.0f} deg (limit 180 deg) from routing.mounting_pose_deg to the first target of the program",
                      setup_.robot.joints[axis].name, turn / degree),
          "the pose in which the dresspack was clamped is a turn away from the program",
          fmt::format("routing.mounting_pose_deg with {:.1f} for {}, or leave it out: then the first target counts",
                      start[static_cast<long>(axis)] / degree, setup_.robot.joints[axis].name)));
    }
  }

  const pipeline::Setup& setup_;
  Rod rod_;
  std::unique_ptr<ClampPath> path_;
  const RobotPath* robot_;
  std::vector<double> longest_, when_;  // (span) [m], [s]
};

}  // namespace

std::vector<pipeline::Warning> quick_warnings(const pipeline::Setup& setup) { return QuickChecks(setup).warnings(); }

}  // namespace dresslife::sim
