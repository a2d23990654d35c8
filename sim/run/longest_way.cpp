#include "sim/run/longest_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/job/setup.h"
#include "sim/robot/loops.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double most_moments = 1e6;
constexpr double rounding = 1e-9;  // [m]: of a way; far above the rounding error of a few metres

/// Returns the pieces without those that are equal to an earlier one.
std::vector<const MotionPiece*> different_pieces(const JointMotion& motion) {
  const std::vector<std::size_t> first = first_equal_pieces(motion);
  std::vector<const MotionPiece*> pieces;
  for (std::size_t k = 0; k < first.size(); ++k)
    if (first[k] == k) pieces.push_back(&motion.pieces()[k]);
  return pieces;
}

/// Returns an upper bound of the speed of each axis within a piece (M1) [rad/s or m/s].
VectorXd fastest(const MotionPiece& piece) {
  if (piece.jerk.size() > 0)
    return piece.velocity_before.cwiseAbs() +
           piece.duration * (piece.acceleration.cwiseAbs() + piece.duration / 2 * piece.jerk.cwiseAbs());
  return piece.velocity_before.cwiseAbs().cwiseMax((piece.velocity_before + piece.velocity_change).cwiseAbs());
}

/// The straight lines of the spans between links of a robot.
class Lines {
 public:
  Lines(const pipeline::Setup& setup, const Rod& rod, const RobotPath& path) : robot_(setup.robot), pose_(path.at(0)) {
    const std::vector<RoutedRing> rings = routed_rings(setup);
    for (int span = 0; span < static_cast<int>(rod.spans().size()); ++span) {
      VectorXd levers = VectorXd::Zero(static_cast<long>(robot_.axes()));
      int from = path.end_links()[static_cast<std::size_t>(2 * span)];
      for (std::size_t r = 0; r < rings.size(); ++r) {
        if (rings[r].span != span) continue;
        add_line(from, path.ring_links()[r], pose_.rings[r].position, levers);
        from = path.ring_links()[r];
      }
      const bool is_free = rod.spans()[static_cast<std::size_t>(span)].properties.tool_end == End::free;
      if (!is_free) add_line(from, path.end_links()[static_cast<std::size_t>(2 * span + 1)], pose_.clamps.end(2 * span + 1).position, levers);
      levers_.push_back(std::move(levers));
    }
  }

  /// Returns, (span), sum_j v_j r_j [m/s].
  double rate(std::size_t span, const VectorXd& speeds) const { return levers_[span].dot(speeds); }

 private:
  /// Adds r_j of the joints between two links. end: place on the link `to`, to which the distance counts. It has the same distance
  /// from the origin of its link in each pose, as have two successive origins.
  void add_line(int from, int to, const Vector3& end, VectorXd& levers) const {
    double reach = (end - origin(to)).norm();
    for (int link = to; link > from; --link) {
      add_joint(link, reach, levers);
      reach += (origin(link) - origin(link - 1)).norm();
    }
    for (int link = to + 1; link <= from; ++link) {
      reach += (origin(link) - origin(link - 1)).norm();
      add_joint(link, reach, levers);
    }
  }
  /// Adds the joint before a link to the axis that moves it.
  void add_joint(int link, double reach, VectorXd& levers) const {
    const pipeline::Joint& joint = robot_.joints[static_cast<std::size_t>(link) - 1];
    const bool follows = !joint.follows.empty();
    const std::string& driver = follows ? joint.follows : joint.name;
    long axis = 0;
    for (const pipeline::Joint& other : robot_.joints) {
      if (other.name == driver) break;
      axis += other.follows.empty();
    }
    levers[axis] += (follows ? std::abs(joint.ratio) : 1) * reach;
  }
  const Vector3& origin(int link) const { return pose_.links[static_cast<std::size_t>(link)].position; }

  const pipeline::Robot& robot_;
  Pose pose_;
  std::vector<VectorXd> levers_;  // (span) (axis) [m]
};

/// Extends the longest ways moment by moment.
class Longest {
 public:
  Longest(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path)
      : setup_(setup), rod_(rod), path_(path), ways_(rod.spans().size()) {}

  void see(double time) {
    const Pose pose = path_.at(time);
    now_ = shortest_ways(setup_, rod_, pose.clamps, pose.rings);
    for (std::size_t span = 0; span < ways_.size(); ++span)
      if (!is_free(span) && now_[span] > ways_[span].way) ways_[span] = {now_[span], time};
  }
  /// Returns the time after the last moment in which no way becomes the longest [s].
  double quiet(const Lines& lines, const VectorXd& speeds) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t span = 0; span < ways_.size(); ++span)
      if (const double rate = lines.rate(span, speeds); !is_free(span) && rate > 0)
        least = std::min(least, (ways_[span].way - now_[span] - rounding) / rate);
    return least;
  }
  const std::vector<LongestWay>& ways() const { return ways_; }

 private:
  bool is_free(std::size_t span) const { return rod_.spans()[span].properties.tool_end == End::free; }

  const pipeline::Setup& setup_;
  const Rod& rod_;
  const ClampPath& path_;
  std::vector<double> now_;       // (span)
  std::vector<LongestWay> ways_;  // (span)
};

}  // namespace

std::vector<LongestWay> longest_ways(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, double step) {
  Longest longest(setup, rod, path);
  const auto* robot = dynamic_cast<const RobotPath*>(&path);
  if (!robot) {
    step = std::max(step, path.duration() / most_moments);
    const auto steps = static_cast<int>(std::ceil(path.duration() / step));
    for (int k = 0; k <= steps; ++k) longest.see(std::min(k * step, path.duration()));
    return longest.ways();
  }
  const Lines lines(setup, rod, *robot);
  const std::vector<const MotionPiece*> pieces = different_pieces(robot->motion());
  double duration = 0;
  for (const MotionPiece* piece : pieces) duration += piece->duration;
  step = std::max(step, duration / most_moments);
  for (const MotionPiece* piece : pieces) {
    const VectorXd speeds = fastest(*piece);
    for (double k = 0; k * step < piece->duration;) {
      longest.see(piece->start + k * step);
      k += std::max(1.0, std::floor(longest.quiet(lines, speeds) / step));
    }
  }
  return longest.ways();
}

}  // namespace dresslife::sim
