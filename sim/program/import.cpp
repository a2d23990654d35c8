#include "sim/program/import.h"

#include <algorithm>

#include "pipeline/job/document.h"
#include "sim/program/encoding.h"
#include "sim/program/fanuc.h"
#include "sim/program/krl.h"
#include "sim/program/rapid.h"
#include "sim/program/rapid_types.h"
#include "sim/program/tokens.h"
#include "sim/program/trajectory.h"

namespace dresslife::sim {
namespace {

Quaternion quaternion_of(const std::vector<double>& q) {
  return Quaternion(q[0], q[1], q[2], q[3]).normalized();
}
std::vector<double> numbers_of(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
std::vector<double> numbers_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::vector<NamedFrame> frames_of(const std::vector<pipeline::MotionFrame>& written) {
  std::vector<NamedFrame> frames;
  for (const pipeline::MotionFrame& frame : written)
    frames.push_back({frame.name, {frame.position, quaternion_of(frame.quaternion)}, frame.stationary});
  return frames;
}

std::vector<pipeline::MotionFrame> frames_of(const std::vector<NamedFrame>& read) {
  std::vector<pipeline::MotionFrame> frames;
  for (const NamedFrame& frame : read)
    frames.push_back(
        {frame.name, frame.frame.position, numbers_of(frame.frame.orientation), frame.stationary});
  return frames;
}

SourceFile source_of(const std::filesystem::path& file) {
  std::error_code failure;
  if (const auto size = std::filesystem::file_size(file, failure);
      !failure && size > ImportLimits::file_bytes)
    throw pipeline::InputError({file.string()},
                               fmt::format("has {} bytes (at most {})", size, ImportLimits::file_bytes),
                               "split the program");
  const std::filesystem::path shown = std::filesystem::proximate(file, failure);
  return {failure || shown.empty() ? file.string() : shown.string(), decoded_text(pipeline::read_text(file))};
}

/// "sill.mod:34 main: MoveL p20, v500, z10, gun;"
std::string step_text(const Instruction& instruction) {
  const std::string file = std::filesystem::path(instruction.where.file).filename().string();
  const std::string routine = instruction.routine.empty() ? "" : " " + instruction.routine;
  return fmt::format("{}:{}{}: {}", file, instruction.where.line, routine, instruction.text);
}

pipeline::MotionStep step_of(const Instruction& instruction, const Program& program) {
  pipeline::MotionStep step;
  step.text = step_text(instruction);
  step.where = instruction.where;
  if (instruction.kind == Instruction::Kind::dwell) {
    step.dwell = instruction.dwell;
    return step;
  }
  step.path = static_cast<pipeline::PathKind>(instruction.kind);
  step.joints = instruction.target.joints;
  if (step.joints.empty()) {
    step.position = numbers_of(instruction.target.pose.position);
    step.quaternion = numbers_of(instruction.target.pose.orientation);
    step.configuration = instruction.target.configuration.text();
    if (instruction.kind == Instruction::Kind::circular)
      step.via_position = numbers_of(instruction.via.position);
  }
  step.external_axes = instruction.target.external_axes;
  if (instruction.tool >= 0) step.tool = program.tools[instruction.tool].name;
  if (instruction.work_object >= 0) step.work_object = program.work_objects[instruction.work_object].name;
  step.speed_percent = instruction.speed.axis_percent;
  step.tool_speed = instruction.speed.tool;
  step.turn_speed = instruction.speed.orientation;
  step.duration = instruction.speed.duration;
  if (step.duration) step.speed_percent = step.tool_speed = step.turn_speed = std::nullopt;
  if (instruction.acceleration_percent != 100) step.acceleration_percent = instruction.acceleration_percent;
  if (instruction.zone.percent > 0)
    step.stop_zone = instruction.zone.percent;
  else
    step.tool_zone = instruction.zone.distance;
  return step;
}

}  // namespace

Language language_of(const std::filesystem::path& file) {
  static const std::pair<const char*, Language> ends[] = {{".mod", Language::rapid},
                                                          {".modx", Language::rapid},
                                                          {".prg", Language::rapid},
                                                          {".sys", Language::rapid},
                                                          {".sysx", Language::rapid},
                                                          {".src", Language::krl},
                                                          {".dat", Language::krl},
                                                          {".sub", Language::krl},
                                                          {".ls", Language::fanuc},
                                                          {".csv", Language::joint_columns},
                                                          {".yaml", Language::ros_trajectory},
                                                          {".yml", Language::ros_trajectory},
                                                          {".json", Language::ros_trajectory}};
  const std::string extension = lower_case(file.extension().string());
  for (const auto& [end, language] : ends)
    if (extension == end) return language;
  throw pipeline::InputError(
      {file.string()}, fmt::format("is no robot program by its name ('{}')", extension),
      "give RAPID (.mod, .prg, .sys), KRL (.src, .dat), Fanuc (.ls), joints (.csv) or ROS (.yaml, .json)");
}

Program read_program(Language language, std::deque<SourceFile> files, const ImportOptions& options,
                     const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                     Problems& problems) {
  Program program;
  if (files.empty()) return program;
  program.name = std::filesystem::path(files[0].name()).stem().string();
  switch (language) {
    case Language::rapid:
    case Language::krl: {
      Code code;
      code.files = std::move(files);
      if (language == Language::rapid) add_rapid_types(code);
      for (int file = 0; file < static_cast<int>(code.files.size()); ++file)
        language == Language::rapid ? parse_rapid(code, file, problems) : parse_krl(code, file, problems);
      code.index();
      if (!problems.empty()) return program;
      if (language == Language::rapid)
        run_rapid(code, options, tools, work_objects, program, problems);
      else
        run_krl(code, options, tools, work_objects, program, problems);
      break;
    }
    case Language::fanuc:
      read_fanuc(files, options, tools, work_objects, program, problems);
      break;
    case Language::joint_columns:
      read_joint_columns(files[0], program, problems);
      break;
    case Language::ros_trajectory:
      read_ros_trajectory(files[0], program, problems);
      break;
  }
  if (problems.empty() && program.instructions.empty())
    problems.add({files.empty() ? program.name : files[0].name()}, "moves the robot nowhere",
                 "name the routine that does");
  return program;
}

Program read_program(const pipeline::Motion& motion) {
  const Language language = language_of(motion.program);
  std::deque<SourceFile> files;
  files.push_back(source_of(motion.program));
  for (const pipeline::ProgramFile& module : motion.modules) files.push_back(source_of(module.file));
  ImportOptions options;
  options.routine = motion.routine;
  options.spot_time = motion.spot_time;
  for (const pipeline::BranchAssumption& assumption : motion.assume)
    options.assume[assumption.line] = assumption.take == pipeline::BranchAssumption::Take::then_branch
                                          ? Assumption::then_branch
                                          : Assumption::else_branch;
  if (language == Language::krl) {  // the data list of the same name belongs to the program
    for (const char* end : {".dat", ".DAT"}) {
      std::filesystem::path data = motion.program;
      std::error_code failure;
      const bool listed = std::any_of(motion.modules.begin(), motion.modules.end(), [&](const auto& m) {
        return lower_case(m.file.extension().string()) == ".dat";
      });
      if (data.replace_extension(end) != motion.program && !listed &&
          std::filesystem::is_regular_file(data, failure)) {
        files.push_back(source_of(data));
        break;
      }
    }
  }
  Problems problems;
  Program program = read_program(language, std::move(files), options, frames_of(motion.tools),
                                 frames_of(motion.work_objects), problems);
  problems.throw_if_any();
  return program;
}

pipeline::Motion motion_of(const Program& program, const pipeline::Motion& defaults) {
  pipeline::Motion motion = defaults;
  motion.program.clear();
  motion.modules.clear();
  motion.assume.clear();
  motion.routine.clear();
  if (motion.name.empty()) motion.name = program.name;
  motion.tools = frames_of(program.tools);
  motion.work_objects = frames_of(program.work_objects);
  motion.steps.clear();
  for (const Instruction& instruction : program.instructions) {
    const bool waits_at_start =
        motion.steps.empty() && instruction.kind == Instruction::Kind::dwell;  // somewhere
    if (!waits_at_start) motion.steps.push_back(step_of(instruction, program));
  }
  return motion;
}

pipeline::Motion resolved_motion(const pipeline::Motion& motion) {
  return motion.program.empty() ? motion : motion_of(read_program(motion), motion);
}

std::vector<std::string> skipped_lines(const Program& program) {
  std::vector<std::string> lines;
  for (const Skipped& skipped : program.skipped)
    lines.push_back(fmt::format("{}: {}: {}", skipped.where.text(),
                                skipped.may_move ? "warning: skipped" : "skipped", skipped.what));
  return lines;
}

}  // namespace dresslife::sim
