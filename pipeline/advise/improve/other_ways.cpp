#include "pipeline/advise/improve/other_ways.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "pipeline/advise/improve/set_text.h"
#include "pipeline/arm/other_turns.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/job/job.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

/// A line of the program: a step that is not a block.
struct Line {
  const MotionStep* step;
  std::string path, name;
  const MotionStep* from =
      nullptr;  ///< the previous move; for the first line of a block the last line of the block; null: none
};

bool leads_joints(const MotionStep& step) { return step.repeat == 0 && !step.joints.empty(); }

void add_lines(std::vector<Line>& lines, const std::vector<MotionStep>& steps, const std::string& path,
               const std::string& block, const MotionStep* from) {
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const MotionStep& step = steps[k];
    const std::string here = fmt::format("{}.{}", path, k + 1);
    if (step.repeat > 0) {
      const auto last = std::find_if(step.steps.rbegin(), step.steps.rend(), leads_joints);
      const MotionStep* const end = last == step.steps.rend() ? from : &*last;
      add_lines(lines, step.steps, here + ".steps", step.text.empty() ? block : block + step.text + ": ",
                step.repeat > 1 ? end : from);
      from = end;
      continue;
    }
    const std::string file = std::filesystem::path(step.where.file).filename().string();
    lines.push_back({&step, here, fmt::format("{}:{} '{}{}'", file, step.where.line, block, step.text), from});
    if (leads_joints(step)) from = &step;
  }
}

std::string joints_set(const Line& line, const std::vector<double>& joints) {
  const auto in_degrees = mapped(joints, [](double angle) { return fmt::format("{:.6g}", angle / degree); });
  return fmt::format("{}.joints_deg=[{}]", line.path, joined(in_degrees, ", "));
}

/// Returns the changes for a turn; absent: a line cannot be turned in this way.
std::optional<std::vector<std::string>> turned(const std::vector<Line>& lines, const NamedTurn& named) {
  std::vector<std::string> sets;
  for (const Line& line : lines) {
    if (line.step->joints.size() != 6) continue;
    const std::optional<std::vector<double>> joints = named.turn(line.step->joints);
    if (!joints) return std::nullopt;
    sets.push_back(joints_set(line, *joints));
  }
  return sets.empty() ? std::nullopt : std::optional(sets);
}

std::optional<std::string> slower(const Job& job, const Line& line, double factor) {
  const MotionStep& step = *line.step;
  if (!step.is_move() || step.tool_speed || step.duration || step.turn_speed) return std::nullopt;
  if (step.speed) return fmt::format("{}.speed_deg_per_s={:.6g}", line.path, *step.speed * factor / degree);
  return fmt::format("{}.speed_percent={:.6g}", line.path,
                     step.speed_percent.value_or(job.motion.speed_percent) * factor);
}

/// Returns alternatives for a line's move through a point: arm and wrist one after the other. The line becomes a block of two
/// lines.
std::vector<OtherWay> by_a_point(const Robot& robot, const Line& line) {
  std::vector<OtherWay> ways;
  const MotionStep& step = *line.step;
  if (!line.from || line.from->joints.size() != 6 || step.joints.size() != 6 || step.duration) return ways;
  constexpr double none = degree,
                   rounded = 30;  // smallest movement of a part; [deg] rounding of the corner
  for (const bool arm_first : {true, false}) {
    std::vector<double> point = arm_first ? step.joints : line.from->joints;
    const std::vector<double>& wrist = arm_first ? line.from->joints : step.joints;
    std::copy(wrist.begin() + 3, wrist.end(), point.begin() + 3);
    const auto far = [&](const std::vector<double>& from) {
      double most = 0;
      for (std::size_t k = 0; k < from.size(); ++k) most = std::max(most, std::abs(from[k] - point[k]));
      return most > none;
    };
    if (!far(step.joints) || !far(line.from->joints) || !within_limits(robot, point)) continue;
    MotionStep on_the_way = step;
    on_the_way.joints = point;
    on_the_way.text += " (on the way)";
    on_the_way.zone = rounded * degree;
    on_the_way.tool_zone.reset();
    on_the_way.stop_zone.reset();
    ways.push_back({fmt::format("by a point: {} first", arm_first ? "axes 1 to 3" : "axes 4 to 6"),
                    {line.name},
                    {fmt::format("{}={{repeat: 1, steps: [{}, {}]}}", line.path, set_text(echo_fields(on_the_way)),
                                 set_text(echo_fields(step)))}});
  }
  return ways;
}

/// Returns, (line), the damage of moves. The damage while the robot stands is added to the previous move.
std::vector<double> cost_of_moves(const std::vector<Line>& lines, const std::vector<double>& line_damage) {
  std::vector<double> cost(lines.size(), 0.0);
  std::size_t move = 0;
  for (std::size_t k = 0; k < std::min(lines.size(), line_damage.size()); ++k) {
    if (lines[k].step->is_move()) move = k;
    cost[move] += line_damage[k];
  }
  return cost;
}

}  // namespace

std::vector<OtherWay> other_ways(const Job& job, const std::vector<double>& line_damage, std::size_t most_lines) {
  std::vector<Line> lines;
  add_lines(lines, job.motion.steps, "motion.steps", "", nullptr);
  if (std::none_of(lines.begin(), lines.end(), [](const Line& line) { return !line.step->joints.empty(); }))
    throw InputError(job.motion.where, "the motion has no steps with joint targets",
                     "read the program into steps first: dresslife import PROGRAM");
  const std::vector<double> cost = cost_of_moves(lines, line_damage);
  const std::vector<std::size_t> costly = largest_first(cost);
  std::vector<OtherWay> ways;
  const std::vector<NamedTurn> turns = other_turns(job.robot);
  for (const NamedTurn& turn : turns)
    if (const auto sets = turned(lines, turn)) ways.push_back({turn.name, {}, *sets});
  for (std::size_t k = 0; k < std::min(costly.size(), most_lines); ++k) {
    const Line& line = lines[costly[k]];
    if (!(cost[costly[k]] > 0)) break;
    for (const NamedTurn& turn : turns)
      if (const auto sets = turned({line}, turn)) ways.push_back({turn.name, {line.name}, *sets});
    for (OtherWay& way : by_a_point(job.robot, line)) ways.push_back(std::move(way));
    for (const double factor : {0.7, 0.5})
      if (const auto set = slower(job, line, factor))
        ways.push_back({fmt::format("at {:.0f} % of its speed", 100 * factor), {line.name}, {*set}});
  }
  return ways;
}

}  // namespace dresslife::pipeline
