#include "sim/reprogram/patched_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "pipeline/base/limits.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"
#include "pipeline/settings/document.h"
#include "sim/robot/inverse_kinematics.h"

namespace dresslife::sim {
namespace {

namespace fs = std::filesystem;

/// Rounding of numbers that are written with six decimals of a millimetre or a degree [m, rad], and with Fanuc's three [rad].
constexpr double written = 1e-8, written_by_fanuc = 1e-5;
/// Rounding of Fanuc's speeds, which are integers.
constexpr double rounded_speed = 0.5;

double largest(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return INFINITY;
  double off = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
  return off;
}

bool same_speed(const std::optional<double>& before, const std::optional<double>& after, double factor, double unit) {
  if (before.has_value() != after.has_value()) return false;
  return !before ||
         std::abs(*before * factor - *after) <= (factor == 1 ? 1e-9 * *before : rounded_speed * unit + 1e-6 * *before);
}

const pipeline::MotionFrame* frame_of(const std::vector<pipeline::MotionFrame>& list, const std::string& name) {
  for (const pipeline::MotionFrame& frame : list)
    if (frame.name == name) return &frame;
  return nullptr;
}

bool same_frame(const std::vector<pipeline::MotionFrame>& a, const std::string& name,
                const std::vector<pipeline::MotionFrame>& b, const std::string& other) {
  const pipeline::MotionFrame *x = frame_of(a, name), *y = frame_of(b, other);
  if (!x || !y) return !x == !y;
  return x->position == y->position && x->quaternion == y->quaternion && x->stationary == y->stationary;
}

/// Returns the difference between two steps apart from a change of the first one's line; empty: none.
std::string difference(const pipeline::Motion& before, const pipeline::MotionStep& a, const pipeline::Motion& after,
                       const pipeline::MotionStep& b, const LineChange* change) {
  constexpr double mm_per_s = 1e-3, deg_per_s = 0.0174532925199433;
  const double factor = change && change->speed ? *change->speed : 1;
  if (a.path != b.path || a.is_move() != b.is_move()) return "path";
  if (a.dwell != b.dwell) return "dwell";
  if (!a.is_move()) return "";
  const std::vector<double>& joints =
      change && !change->joints.empty() && !a.joints.empty() ? change->joints : a.joints;
  if (largest(joints, b.joints) > (&joints == &a.joints ? 0 : written_by_fanuc)) return "joint angles";
  if (largest(a.position, b.position) > written || largest(a.via_position, b.via_position) > written ||
      largest(a.circle_joints, b.circle_joints) > 0)
    return "position";
  double aligned = a.quaternion.empty() ? 1 : 0;
  for (std::size_t i = 0; i < std::min(a.quaternion.size(), b.quaternion.size()); ++i)
    aligned += a.quaternion[i] * b.quaternion[i];
  if (a.quaternion.size() != b.quaternion.size() || std::abs(std::abs(aligned) - 1) > written) return "orientation";
  const std::string configuration =
      change && change->configuration && a.joints.empty() ? change->configuration->text() : a.configuration;
  if (configuration != b.configuration) return "configuration";
  if (a.external_axes != b.external_axes) return "external axes";
  if (!same_frame(before.tools, a.tool, after.tools, b.tool)) return "tool";
  if (!same_frame(before.work_objects, a.work_object, after.work_objects, b.work_object)) return "work object";
  if (!same_speed(a.speed_percent, b.speed_percent, factor, 1) || !same_speed(a.speed, b.speed, factor, 0) ||
      !same_speed(a.tool_speed, b.tool_speed, factor, mm_per_s) ||
      !same_speed(a.turn_speed, b.turn_speed, factor, deg_per_s))
    return "speed";
  if (a.duration != b.duration || a.acceleration_percent != b.acceleration_percent ||
      a.jerk_percent != b.jerk_percent || a.acceleration != b.acceleration ||
      a.tool_acceleration != b.tool_acceleration)
    return "time or acceleration";
  if (a.zone != b.zone || a.tool_zone != b.tool_zone || a.turn_zone != b.turn_zone || a.stop_zone != b.stop_zone)
    return "zone";
  return "";
}

}  // namespace

std::string other_difference(const pipeline::Motion& before, const pipeline::Motion& after,
                             const std::vector<LineChange>& changes) {
  std::size_t next = 0;
  for (const pipeline::MotionStep& step : before.steps) {
    const auto change = std::ranges::find_if(changes, [&](const LineChange& c) {
      return c.where.file == step.where.file && c.where.line == step.where.line && c.where.column == step.where.column;
    });
    const LineChange* own = change == changes.end() ? nullptr : &*change;
    if (own && !own->point.empty() && step.is_move()) {
      if (next >= after.steps.size() || largest(own->point, after.steps[next].joints) > written_by_fanuc)
        return fmt::format("{}:{}: the point on the way", step.where.file, step.where.line);
      ++next;
    }
    if (next >= after.steps.size()) return "it ends earlier";
    const std::string what = difference(before, step, after, after.steps[next], own);
    if (!what.empty()) return fmt::format("{}:{}: {}", step.where.file, step.where.line, what);
    ++next;
  }
  return next == after.steps.size() ? "" : "it has more moves";
}

namespace {

/// Returns the name of an answer, "fa.ls:7" or "main.mod:12:di5", with the line's number in the changed files. A number
/// alone means a line of any file: the answer then gets a name for each of the program's files.
std::vector<std::string> names_in(const std::map<std::string, std::vector<int>>& numbers,
                                  const std::set<std::string>& files, const std::string& name) {
  const auto short_name = [](const std::string& file) { return fs::path(file).filename().string(); };
  const auto moved = [&](const std::string& file, int line) {
    const auto changed = numbers.find(file);
    const bool known = changed != numbers.end() && line >= 1 && line <= static_cast<int>(changed->second.size());
    return known ? changed->second[static_cast<std::size_t>(line) - 1] : line;
  };
  if (const auto line = pipeline::whole_number_in<int>(std::string_view(name))) {
    std::vector<std::string> made;
    for (const std::string& file : files) made.push_back(fmt::format("{}:{}", file, moved(file, *line)));
    return made;
  }
  for (const auto& [file, lines] : numbers)
    for (const std::string& begin : {file + ":", short_name(file) + ":"}) {
      if (!pipeline::same_word(std::string_view(name).substr(0, begin.size()), begin)) continue;
      const std::size_t end = std::min(name.find(':', begin.size()), name.size());
      const auto line = pipeline::whole_number_in<int>(std::string_view(name).substr(begin.size(), end - begin.size()));
      if (line) return {fmt::format("{}{}{}", begin, moved(file, *line), name.substr(end))};
    }
  return {name};
}

/// Returns the motion with its answers at the lines of the changed files.
pipeline::Motion at_changed_lines(pipeline::Motion motion, const ReadProgram& read,
                                  const std::map<std::string, std::vector<int>>& numbers) {
  std::set<std::string> files{read.program.start.file};
  for (const Instruction& instruction : read.program.instructions) files.insert(instruction.where.file);
  std::vector<pipeline::BranchAssumption> assume;
  for (const pipeline::BranchAssumption& one : motion.assume)
    for (const std::string& name : names_in(numbers, files, one.line)) assume.push_back({name, one.take});
  motion.assume = std::move(assume);
  for (pipeline::ProgramValue& value : motion.values)
    if (value.name.find(':') != std::string::npos) value.name = names_in(numbers, files, value.name).front();
  return motion;
}

/// Returns the nearest folder that contains the program and all these files. patch and git apply refuse names that begin with `..`.
fs::path folder_of(const fs::path& program, const std::set<std::string>& files) {
  const bool is_folder = pipeline::kind_of(program) == pipeline::FileKind::folder;
  fs::path folder = fs::weakly_canonical(program);
  if (!is_folder) folder = folder.parent_path();
  for (const std::string& file : files)
    while (*fs::weakly_canonical(file).lexically_relative(folder).begin() == "..") folder = folder.parent_path();
  return folder;
}

}  // namespace

PatchedProgram patched(const pipeline::Job& job, const ReadProgram& read, const ProgramWay& way) {
  std::set<std::string> files;
  for (const LineChange& change : way.changes) files.insert(change.where.file);
  std::map<std::string, std::string> instead;
  std::map<std::string, std::vector<int>> numbers;
  PatchedProgram made;
  const fs::path folder = folder_of(job.motion.program, files);
  made.patch = fmt::format("for patch -p1 in {}\n", pipeline::shown(fs::proximate(folder).string()));
  for (const std::string& file : files) {
    const Rewritten changed = rewritten(read.language, file, pipeline::read_text(file), read.program, way.changes,
                                        fs::weakly_canonical(file).lexically_relative(folder).generic_string());
    instead[file] = changed.text;
    numbers[file] = changed.numbers;
    made.patch += changed.patch;
  }
  made.motion =
      motion_of(read_program(at_changed_lines(job.motion, read, numbers), flange_at(job.robot), instead), job.motion);
  const std::string other = other_difference(read.motion, made.motion, way.changes);
  if (!other.empty())
    throw pipeline::InputError(way.changes.front().where,
                               fmt::format("cannot be changed by itself: another difference comes with it ({})", other),
                               "change it by hand");
  return made;
}

}  // namespace dresslife::sim
