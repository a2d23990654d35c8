#include "sim/route/exercise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/constants.h"
#include "sim/robot/robot.h"

namespace dresslife::sim {
namespace {

constexpr double from_limits = 2 * degree;  // distance that the moves keep from the limits

std::vector<Axis> driven_axes(const pipeline::Robot& robot) {
  std::vector<Axis> axes = axes_of(robot);
  axes.resize(robot.axes());
  return axes;
}

double within(const Axis& axis, double angle) {
  const double margin = std::min(from_limits, (axis.upper - axis.lower) / 4);
  return std::clamp(angle, axis.lower + margin, axis.upper - margin);
}

/// Returns how vertical the upper arm and how horizontal and far forward the forearm is: at most 3.
double likeness(const RobotKinematics& kinematics, const std::vector<double>& joints, std::size_t axes) {
  std::vector<double> all = joints;
  all.resize(axes, 0.0);
  std::vector<Frame> links(kinematics.links());
  kinematics.link_frames(all, links);
  const Vector3 up = links[0].orientation * Vector3::UnitZ(), forward = links[0].orientation * Vector3::UnitX();
  const Vector3 upper = (links[3].position - links[2].position).normalized();
  const Vector3 forearm = (links.back().position - links[3].position).normalized();
  return upper.dot(up) + forearm.dot(forward) - std::abs(forearm.dot(up));
}

}  // namespace

std::vector<double> home_pose(const pipeline::Robot& robot) {
  constexpr double grid = 5 * degree;
  const std::vector<Axis> axes = driven_axes(robot);
  std::vector<double> home;
  for (const Axis& axis : axes) home.push_back(within(axis, 0));
  if (axes.size() < 5 || robot.links.size() < 5) return home;
  const RobotKinematics kinematics(robot);
  std::vector<double> tried = home;
  double best = likeness(kinematics, home, kinematics.axes());
  const auto first = [](const Axis& axis) { return std::ceil(std::max(axis.lower, -std::numbers::pi) / grid); };
  const auto last = [](const Axis& axis) { return std::floor(std::min(axis.upper, std::numbers::pi) / grid); };
  for (double a = first(axes[1]); a <= last(axes[1]); ++a)
    for (double b = first(axes[2]); b <= last(axes[2]); ++b) {
      tried[1] = within(axes[1], a * grid);
      tried[2] = within(axes[2], b * grid);
      const double found = likeness(kinematics, tried, kinematics.axes());
      if (found > best + 1e-9) best = found, home = tried;
    }
  return home;
}

pipeline::Motion exercise(const pipeline::Robot& robot) {
  const std::vector<Axis> axes = driven_axes(robot);
  const std::vector<double> home = home_pose(robot);
  const std::size_t count = axes.size(), wrist = count > 3 ? count - 3 : count;
  constexpr double body[] = {30 * degree, 15 * degree, 15 * degree}, hand[] = {45 * degree, 45 * degree, 60 * degree};
  pipeline::Motion motion;
  motion.name = "exercise";
  motion.source = "made by dresslife: no program, only what a wrist usually does";
  motion.speed_percent = 50;
  motion.acceleration_percent = 50;
  struct Posture {
    const char* text;
    double of_body;  ///< share of the ways of axes 1 to 3
    std::array<double, 3> of_hand;
  };
  constexpr Posture postures[] = {{"home", 0, {0, 0, 0}},
                                  {"hand down", 0, {0, 1, 0}},
                                  {"hand down, flange to the left", 0, {0, 1, -1}},
                                  {"hand down, flange to the right", 0, {0, 1, 1}},
                                  {"hand up", 0, {0, -0.75, 0}},
                                  {"forearm to the left", 1, {1, 0.75, -0.5}},
                                  {"forearm to the right", -1, {-1, 0.75, 0.5}},
                                  {"hand to the left", 0.5, {1, 1, 0}},
                                  {"hand to the right", -0.5, {-1, 1, 0}},
                                  {"home", 0, {0, 0, 0}}};
  for (const Posture& posture : postures) {
    pipeline::MotionStep step;
    step.text = posture.text;
    for (std::size_t k = 0; k < count; ++k) {
      const double way = k < wrist ? posture.of_body * body[std::min<std::size_t>(k, 2)]
                                   : posture.of_hand[k - wrist] * hand[k - wrist];
      step.joints.push_back(within(axes[k], home[k] + way));
    }
    motion.steps.push_back(std::move(step));
  }
  return motion;
}

}  // namespace dresslife::sim
