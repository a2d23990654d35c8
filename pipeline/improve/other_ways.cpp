#include "pipeline/improve/other_ways.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>

#include "pipeline/errors.h"
#include "pipeline/job/job.h"

namespace dresslife::pipeline {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A line of the program: a step that is no block.
struct Line {
  const MotionStep* step;
  std::string path, name;
};

void add_lines(std::vector<Line>& lines, const std::vector<MotionStep>& steps, const std::string& path, const std::string& block) {
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const MotionStep& step = steps[k];
    const std::string here = fmt::format("{}.{}", path, k + 1);
    if (step.repeat > 0) {
      add_lines(lines, step.steps, here + ".steps", step.text.empty() ? block : block + step.text + ": ");
      continue;
    }
    const std::string file = std::filesystem::path(step.where.file).filename().string();
    lines.push_back({&step, here, fmt::format("{}:{} '{}{}'", file, step.where.line, block, step.text)});
  }
}

/// Whether its last three axes cross in one point, the outer two along each other.
bool has_wrist(const Robot& robot) {
  constexpr double exact = 1e-6;
  if (robot.joints.size() != 6 || robot.axes() != 6) return false;
  const Joint &four = robot.joints[3], &five = robot.joints[4], &six = robot.joints[5];
  const Vector3d axis = four.axis.normalized();
  const auto along = [&](const Vector3d& v) { return v.cross(axis).norm() < exact; };
  return five.orientation.norm() < exact && six.orientation.norm() < exact && along(six.axis) &&
         std::abs(five.axis.dot(axis)) < exact && along(five.origin) && along(six.origin);
}

using Turn = std::function<std::vector<double>(std::vector<double>)>;
struct NamedTurn {
  std::string name;
  Turn turn;
};

std::vector<NamedTurn> turns_of_wrist() {
  std::vector<NamedTurn> turns;
  const auto add = [&](std::string name, double four, bool flipped, double six) {
    turns.push_back({std::move(name), [=](std::vector<double> joints) {
                       joints[3] += four * degree;
                       joints[4] *= flipped ? -1 : 1;
                       joints[5] += six * degree;
                       return joints;
                     }});
  };
  for (const double four : {-180.0, 180.0})
    for (const double six : {-180.0, 180.0})
      add(fmt::format("wrist over: axis 4 {:+.0f}, axis 6 {:+.0f} deg, axis 5 to the other side", four, six), four, true, six);
  for (const double turn : {-360.0, 360.0}) add(fmt::format("axis 6 {:+.0f} deg", turn), 0, false, turn);
  for (const double turn : {-360.0, 360.0}) add(fmt::format("axis 4 {:+.0f} deg", turn), turn, false, 0);
  return turns;
}

bool within_limits(const Robot& robot, const std::vector<double>& joints) {
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (joints[k] < robot.joints[k].lower || joints[k] > robot.joints[k].upper) return false;
  return true;
}

std::string joints_set(const Line& line, const std::vector<double>& joints) {
  std::string list;
  for (const double angle : joints) list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", angle / degree);
  return fmt::format("{}.joints_deg=[{}]", line.path, list);
}

/// Absent: a line has no such way.
std::optional<std::vector<std::string>> turned(const Robot& robot, const std::vector<Line>& lines, const Turn& turn) {
  std::vector<std::string> sets;
  for (const Line& line : lines) {
    if (line.step->joints.size() != 6) continue;
    const std::vector<double> joints = turn(line.step->joints);
    if (!within_limits(robot, joints)) return std::nullopt;
    sets.push_back(joints_set(line, joints));
  }
  return sets.empty() ? std::nullopt : std::optional(sets);
}

std::optional<std::string> slower(const Job& job, const Line& line, double factor) {
  const MotionStep& step = *line.step;
  if (!step.is_move() || step.tool_speed || step.duration || step.turn_speed) return std::nullopt;
  if (step.speed) return fmt::format("{}.speed_deg_per_s={:.6g}", line.path, *step.speed * factor / degree);
  return fmt::format("{}.speed_percent={:.6g}", line.path, step.speed_percent.value_or(job.motion.speed_percent) * factor);
}

}  // namespace

std::vector<OtherWay> other_ways(const Job& job, const std::vector<double>& line_damage, std::size_t most_lines) {
  std::vector<Line> lines;
  add_lines(lines, job.motion.steps, "motion.steps", "");
  if (std::none_of(lines.begin(), lines.end(), [](const Line& line) { return !line.step->joints.empty(); }))
    throw InputError(job.motion.where, "the motion has no steps with joint targets",
                     "read the program into steps first: dresslife import PROGRAM");
  std::vector<std::size_t> costly(std::min(lines.size(), line_damage.size()));
  std::iota(costly.begin(), costly.end(), 0);
  std::stable_sort(costly.begin(), costly.end(), [&](auto a, auto b) { return line_damage[a] > line_damage[b]; });
  std::vector<OtherWay> ways;
  const std::vector<NamedTurn> turns = has_wrist(job.robot) ? turns_of_wrist() : std::vector<NamedTurn>();
  for (const NamedTurn& turn : turns)
    if (const auto sets = turned(job.robot, lines, turn.turn)) ways.push_back({turn.name, {}, *sets});
  for (std::size_t k = 0; k < std::min(costly.size(), most_lines); ++k) {
    const Line& line = lines[costly[k]];
    if (!(line_damage[costly[k]] > 0)) break;
    for (const NamedTurn& turn : turns)
      if (const auto sets = turned(job.robot, {line}, turn.turn)) ways.push_back({turn.name, {line.name}, *sets});
    for (const double factor : {0.7, 0.5})
      if (const auto set = slower(job, line, factor))
        ways.push_back({fmt::format("at {:.0f} % of its speed", 100 * factor), {line.name}, {*set}});
  }
  return ways;
}

}  // namespace dresslife::pipeline
