#include "sim/route/quick_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/warning_words.h"
#include "pipeline/files/check_names.h"
#include "pipeline/job/setup.h"
#include "sim/route/screening.h"
#include "sim/run/cures.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

namespace check_name = pipeline::check_name;
using pipeline::WarningKind;

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double degree = EIGEN_PI / 180;
constexpr int most_moments = 100'000;  // of the program; a run looks at every step
constexpr int resting_poses = 8;       // 0.2 s of equilibria for each span

class QuickChecks {
 public:
  explicit QuickChecks(const pipeline::Setup& setup)
      : setup_(setup), rod_(rod_of(setup)), path_(path_of(setup)), robot_(dynamic_cast<const RobotPath*>(path_.get())) {}

  std::vector<pipeline::Warning> warnings() {
    std::vector<Check> checks;
    add_slack(checks);
    add_bend(checks);
    add_twist(checks);
    std::vector<pipeline::Warning> all = robot_ ? robot_->doubts() : std::vector<pipeline::Warning>{};
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

  /// Of each dresspack's worst span at rest. Spans with rings or a retraction unit are left to a run.
  void add_bend(std::vector<Check>& checks) {
    const std::vector<RoutedRing> rings = routed_rings(setup_);
    for (int d = 0; d < rod_.dresspacks(); ++d) {
      double most = 0, time = 0, place = -1;
      for (auto span = static_cast<std::size_t>(rod_.first_span(d)); span < static_cast<std::size_t>(rod_.first_span(d + 1)); ++span) {
        const bool ringed = std::any_of(rings.begin(), rings.end(), [&](const RoutedRing& ring) {
          return ring.span == static_cast<int>(span);
        });
        if (is_free(span) || ringed || properties(span).slider || longest_[span] >= properties(span).length) continue;
        for (int k = 0; k < resting_poses; ++k) {
          const double moment = path_->duration() * k / (resting_poses - 1);
          const Pose pose = path_->at(moment);
          const double curvature = curvature_at_rest(properties(span), {pose.clamps.end(static_cast<int>(2 * span)),
                                                                        pose.clamps.end(static_cast<int>(2 * span) + 1)});
          if (std::isfinite(curvature) && curvature > most) most = curvature, time = moment, place = middle(span);
        }
      }
      if (most == 0) continue;
      const double limit = limits_of(setup_.dresspacks[static_cast<std::size_t>(d)].dresspack).least_bend_radius;
      checks.push_back({WarningKind::bend_radius, "smallest bend radius at rest", "m", 1 / most, limit, most * limit > 1, time,
                        place, d});
    }
  }

  /// By what geometry says of the whole job (V4): the worst of all dresspacks.
  void add_twist(std::vector<Check>& checks) {
    const Screening screening = Screener(setup_).screen(setup_);
    const auto k = static_cast<std::size_t>(ScreenedLimit::twist);
    if (!(screening.beyond[k] > 0) || rod_.dresspacks() > 1) return;
    const double limit = limits_of(setup_.dresspacks[0].dresspack).most_twist;
    const double twist = (1 + screening.beyond[k]) * limit, length = setup_.dresspacks[0].routing.free_length;
    checks.push_back({{}, check_name::net_twist, "rad", twist * length, unlimited, false, screening.time[k], -1, 0});
    checks.push_back({WarningKind::twist, "largest twist at rest", "rad/m", twist, limit, true, screening.time[k], -1, 0});
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
