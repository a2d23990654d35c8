#include "sim/program/import.h"

#include <algorithm>
#include <array>
#include <set>

#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/program_files.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/settings/document.h"
#include "sim/program/backup.h"
#include "sim/program/fanuc/backup.h"
#include "sim/program/fanuc/fanuc.h"
#include "sim/program/inform/inform.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/request.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/krl/krl.h"
#include "sim/program/rapid/rapid.h"
#include "sim/program/rapid/types.h"
#include "sim/program/trajectory.h"
#include "sim/program/urscript/urscript.h"

namespace dresslife::sim {
namespace {

Quaternion quaternion_of(const std::vector<double>& q) { return Quaternion(q[0], q[1], q[2], q[3]).normalized(); }
std::vector<double> numbers_of(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
std::vector<double> numbers_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::vector<NamedFrame> frames_of(const std::vector<pipeline::MotionFrame>& written) {
  return pipeline::mapped(written, [](const pipeline::MotionFrame& frame) {
    return NamedFrame{frame.name, {frame.position, quaternion_of(frame.quaternion)}, frame.stationary};
  });
}

std::vector<pipeline::MotionFrame> frames_of(const std::vector<NamedFrame>& read) {
  return pipeline::mapped(read, [](const NamedFrame& frame) {
    return pipeline::MotionFrame{frame.name, frame.frame.position, numbers_of(frame.frame.orientation),
                                 frame.stationary};
  });
}

SourceFile source_of(const std::filesystem::path& file, const std::map<std::string, std::string>& instead) {
  const pipeline::PlainFile source(file);
  if (source.size() > ImportLimits::file_bytes)
    throw pipeline::InputError({file.string()},
                               fmt::format("has {} bytes (at most {})", source.size(), ImportLimits::file_bytes),
                               "split the program");
  const std::filesystem::path shown = std::filesystem::proximate(file);
  const std::string name = shown.empty() ? file.string() : shown.string();
  const auto other = instead.find(name);
  return {name, decoded_text(other == instead.end() ? source.text() : other->second)};
}

/// Returns "sill.mod:34 main: MoveL p20, v500, z10, gun;".
std::string step_text(const Instruction& instruction) {
  const std::string file = std::filesystem::path(instruction.where.file).filename().string();
  const std::string routine = instruction.routine.empty() ? "" : " " + instruction.routine;
  return fmt::format("{}:{}{}: {}", file, instruction.where.line, routine, instruction.text);
}

pipeline::MotionStep step_of(const Instruction& instruction, const Program& program) {
  pipeline::MotionStep step;
  step.text = step_text(instruction);
  step.where = instruction.where;
  for (const Origin& origin : instruction.origins) {
    if (std::string_view(origin.part) == "speed") step.speed_where = origin.where;
    if (std::string_view(origin.part) == "acceleration") step.acceleration_where = origin.where;
    if (std::string_view(origin.part) == "tool") step.tool_where = origin.where;
    if (std::string_view(origin.part) == "work object") step.object_where = origin.where;
  }
  if (instruction.kind == Instruction::Kind::dwell) {
    step.dwell = instruction.dwell;
    return step;
  }
  step.path = static_cast<pipeline::PathKind>(instruction.kind);
  step.joints = instruction.target.joints;
  if (instruction.kind == Instruction::Kind::circular) step.circle_joints = instruction.target.circle_joints;
  if (step.joints.empty()) {
    step.position = numbers_of(instruction.target.pose.position);
    step.quaternion = numbers_of(instruction.target.pose.orientation);
    step.configuration = instruction.target.configuration.text();
    if (instruction.kind == Instruction::Kind::circular) step.via_position = numbers_of(instruction.via.position);
  }
  step.external_axes = instruction.target.external_axes;
  if (instruction.tool >= 0) step.tool = program.tools[instruction.tool].name;
  if (instruction.work_object >= 0) step.work_object = program.work_objects[instruction.work_object].name;
  step.speed_percent = instruction.speed.axis_percent;
  step.speed = instruction.speed.axis;
  step.acceleration = instruction.speed.axis_acceleration;
  step.tool_acceleration = instruction.speed.tool_acceleration;
  step.tool_speed = instruction.speed.tool;
  step.turn_speed = instruction.speed.orientation;
  step.duration = instruction.speed.duration;
  if (step.duration) step.speed_percent = step.speed = step.tool_speed = step.turn_speed = std::nullopt;
  if (instruction.acceleration_percent != 100) step.acceleration_percent = instruction.acceleration_percent;
  if (instruction.jerk_percent != 100) step.jerk_percent = instruction.jerk_percent;
  if (instruction.zone.percent > 0)
    step.stop_zone = instruction.zone.percent;
  else
    step.tool_zone = instruction.zone.distance;
  if (instruction.zone.distance > 0) step.turn_zone = instruction.zone.turn;
  return step;
}

}  // namespace

Language language_of(const std::filesystem::path& file) {
  static const std::pair<Language, pipeline::WordSet> ends[] = {
      {Language::rapid, pipeline::word_set(".mod .modx .prg .sys .sysx .pgf")},
      {Language::krl, pipeline::word_set(".src .dat .sub")},
      {Language::fanuc, pipeline::word_set(".ls .va")},
      {Language::inform, pipeline::word_set(".jbi .cnd")},
      {Language::urscript, pipeline::word_set(".script .urscript")},
      {Language::joint_columns, {".csv"}},
      {Language::ros_trajectory, pipeline::word_set(".yaml .yml .json")}};
  const std::string extension = lower_case(file.extension().string());
  for (const auto& [language, of_language] : ends)
    if (of_language.contains(extension)) return language;
  throw pipeline::InputError(
      {file.string()}, fmt::format("is no robot program by its name ('{}')", extension),
      "rename it by its language: RAPID (.mod, .prg, .sys, .pgf), KRL (.src, .dat), Fanuc (.ls), INFORM "
      "(.jbi), URScript (.script), joints (.csv), ROS (.yaml, .json); or name the folder of a backup");
}

namespace {

/// The parts of a language that the interpreter runs.
struct Interpreted {
  Language language;
  Grammar grammar;  ///< of the answers
  void (*add_types)(Code&);
  void (*parse)(Code&, int file, Problems&);
  void (*run)(const Code&, const ImportOptions&, const std::vector<NamedFrame>& tools,
              const std::vector<NamedFrame>& work_objects, Program&, Problems&);
};
constexpr Interpreted interpreted[] = {
    {Language::rapid, Grammar::rapid, add_rapid_types, parse_rapid, run_rapid},
    {Language::krl, Grammar::krl, add_krl_types, parse_krl, run_krl},
    {Language::inform, Grammar::rapid, add_inform_types, parse_inform, run_inform},
    {Language::urscript, Grammar::urscript, add_urscript_types, parse_urscript, run_urscript}};

/// Parses the files. An error in a routine is reported only if the routine runs, an error outside of routines only if
/// the program fails. With too many errors the parser stops in the file; then all errors are reported, because
/// routines and data are missing.
void parse_files(Code& code, const Interpreted& language, Problems& problems) {
  for (int file = 0; file < static_cast<int>(code.files.size()); ++file) {
    Problems found;
    language.parse(code, file, found);
    if (!found.full())
      code.sort_problems(file, found);
    else
      for (const Problem& problem : found.list()) problems.add(problem.where, problem.what, problem.remedy);
  }
}

constexpr int listed_reasons = 5;

/// Reports a program without a move. Executed statements that were skipped may be the cause.
void report_nothing(const Program& program, const ImportOptions& options, Problems& problems) {
  std::string left_out;
  int listed = 0;
  for (const bool may_move : {true, false})
    for (const Skipped& skipped : program.skipped)
      if (skipped.may_move == may_move && ++listed <= listed_reasons)
        left_out += fmt::format("{}{} ({}:{})", left_out.empty() ? "" : ", ", skipped.what,
                                std::filesystem::path(skipped.where.file).filename().string(), skipped.where.line);
  const std::string routine = options.routine.empty() ? "the routine that it starts with" : "'" + options.routine + "'";
  problems.add(
      program.start.file.empty() ? pipeline::Where{program.name} : program.start,
      fmt::format("moves the robot nowhere: {} runs to its end{}", routine,
                  left_out.empty() ? ""
                                   : fmt::format("; {} lines were left out: {}{}", listed, left_out,
                                                 listed > listed_reasons ? ", ..." : "")),
      "name the routine that moves it in motion.routine, or give what it asks for with motion.values, motion.assume "
      "or motion.modules");
}

/// Notes external axes that move, and the data that the job's robot needs for them: programs only give positions.
void report_external_axes(Program& program) {
  struct Way {
    double low = INFINITY, high = -INFINITY;
  };
  std::vector<Way> ways;
  for (const Instruction& instruction : program.instructions)
    for (std::size_t i = 0; i < instruction.target.external_axes.size(); ++i) {
      if (ways.size() <= i) ways.resize(i + 1);
      ways[i].low = std::min(ways[i].low, instruction.target.external_axes[i]);
      ways[i].high = std::max(ways[i].high, instruction.target.external_axes[i]);
    }
  if (std::ranges::none_of(ways, [](const Way& way) { return way.high > way.low; })) return;
  std::string moving, entries;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Way& way = ways[i];
    moving += fmt::format("{}{} from {:.6g} to {:.6g}", i ? ", " : "", i + 1, way.low, way.high);
    entries += fmt::format(
        "{}{{name: external_{}, kind: linear, carries: robot, axis: [1, 0, 0], lower_mm: {:.6g}, upper_mm: {:.6g}, "
        "speed_mm_per_s: 1000, acceleration_mm_per_s2: 1000}}",
        i ? ", " : "", i + 1, std::min(way.low, 0.0), std::max(way.high, way.low + 1));
  }
  program.skipped.push_back(
      {program.start,
       fmt::format(
           "note: external axes move: {} (mm or deg). A job simulates them with robot: {{external_axes: [{}]}}. The "
           "direction, the speed and the acceleration are estimates: write those of the axis; kind: rotary for one "
           "that turns, carries: nothing for one that does not move the robot",
           moving, entries)});
}

/// Removes the frames that no move uses (frames of passes that are not part of the motion).
void drop_unused(std::vector<NamedFrame>& frames, int Instruction::*index, std::vector<Instruction>& instructions) {
  std::vector<int> now(frames.size(), -1);
  for (const Instruction& instruction : instructions)
    if (instruction.*index >= 0) now[static_cast<std::size_t>(instruction.*index)] = 0;
  std::vector<NamedFrame> used;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (now[i] == 0) {
      now[i] = static_cast<int>(used.size());
      used.push_back(std::move(frames[i]));
    }
  for (Instruction& instruction : instructions)
    if (instruction.*index >= 0) instruction.*index = now[static_cast<std::size_t>(instruction.*index)];
  frames = std::move(used);
}

bool moves_anywhere(const Program& program) {
  return std::ranges::any_of(program.instructions,
                             [](const Instruction& i) { return i.kind != Instruction::Kind::dwell; });
}

}  // namespace

Program read_program(Language language, std::deque<SourceFile> files, const ImportOptions& options,
                     const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                     Problems& problems) {
  Program program;
  if (files.empty()) return program;
  program.name = std::filesystem::path(files[0].name()).stem().string();
  switch (language) {
    case Language::rapid:
    case Language::krl:
    case Language::inform:
    case Language::urscript: {
      Code code;
      code.files = std::move(files);
      code.written_beside = options.written_beside;
      const Interpreted& of = *std::ranges::find(interpreted, language, &Interpreted::language);
      of.add_types(code);
      parse_files(code, of, problems);
      add_requests(code, options, of.grammar, problems);
      if (language == Language::inform) name_inform_values(code);
      if (language == Language::krl) stop_at_signals(code);
      code.index();
      if (!problems.empty()) return program;
      of.run(code, options, tools, work_objects, program, problems);
      for (const Problem& unread : code.problems)  // a possible cause
        if (problems.empty())
          program.skipped.push_back({unread.where, "not read: " + unread.what, true});
        else
          problems.add(unread.where, unread.what, unread.remedy);
      break;
    }
    case Language::fanuc:
      read_fanuc(files, options, tools, work_objects, program, problems);
      break;
    case Language::joint_columns:
      read_joint_columns(files[0], options, program, problems);
      break;
    case Language::ros_trajectory:
      read_ros_trajectory(files[0], options, program, problems);
      break;
  }
  drop_unused(program.tools, &Instruction::tool, program.instructions);
  drop_unused(program.work_objects, &Instruction::work_object, program.instructions);
  if (problems.empty() && !moves_anywhere(program)) report_nothing(program, options, problems);
  report_external_axes(program);
  return program;
}

ImportOptions options_of(const pipeline::Motion& motion) {
  ImportOptions options;
  options.routine = motion.routine;
  options.spot_time = motion.spot_time;
  options.passes = motion.passes;
  for (const pipeline::BranchAssumption& assumption : motion.assume)
    if (assumption.take.empty())
      continue;  // an empty answer
    else if (assumption.take == "then" || assumption.take == "else")
      options.assume[assumption.line] = assumption.take == "then" ? Assumption::then_branch : Assumption::else_branch;
    else
      options.choose[assumption.line] = assumption.take;
  for (const pipeline::ProgramValue& given : motion.values)
    if (!given.value.empty()) options.values[given.name] = given.value;
  return options;
}

namespace {

/// Adds the modules, each once. beside: also adds the other files in the folders of the program and of its modules,
/// which KRL and INFORM programs see on the controller.
void add_modules(const pipeline::Motion& motion, bool beside, const std::map<std::string, std::string>& instead,
                 std::deque<SourceFile>& files) {
  std::vector<std::filesystem::path> wanted = pipeline::mapped(motion.modules, &pipeline::ProgramFile::file);
  const auto add_folder_of = [&](const std::filesystem::path& file) {
    const std::vector<std::filesystem::path> files_beside = pipeline::program_files(file);
    wanted.insert(wanted.end(), files_beside.begin(), files_beside.end());
  };
  if (beside) {
    add_folder_of(motion.program);
    for (const pipeline::ProgramFile& module : motion.modules) add_folder_of(module.file);
  }
  std::set<std::filesystem::path> known;
  known.insert(std::filesystem::weakly_canonical(motion.program));
  for (const std::filesystem::path& file : wanted)
    if (known.insert(std::filesystem::weakly_canonical(file)).second) files.push_back(source_of(file, instead));
}

}  // namespace

Language language_of(const pipeline::Motion& motion) {
  return is_backup(motion.program) ? backup_of(motion.program, motion.routine).language : language_of(motion.program);
}

Program read_program(const pipeline::Motion& motion, const FlangeAt& flange,
                     const std::map<std::string, std::string>& instead) {
  ImportOptions options = options_of(motion);
  options.flange = flange;
  Language language = Language::rapid;
  std::deque<SourceFile> files;
  std::vector<std::string> missing;
  if (is_backup(motion.program)) {
    const Backup backup = backup_of(motion.program, motion.routine);
    language = backup.language;
    options.routine = backup.routine;
    options.written_beside = backup.written_beside;
    for (const std::filesystem::path& file : backup.files) files.push_back(source_of(file, instead));
    if (files.empty())
      throw pipeline::InputError({motion.program.string()}, "holds none of the files that its lists name",
                                 "name the folder or the file that holds the program");
    missing = backup.missing;
  } else {
    language = language_of(motion.program);
    options.first_file_counts = true;
    files.push_back(source_of(motion.program, instead));
  }
  const bool sees_its_folder = language == Language::krl || language == Language::inform;
  add_modules(motion, sees_its_folder && !is_backup(motion.program), instead, files);
  if (language == Language::fanuc &&
      !is_backup(motion.program))  // called programs and registers are in the same folder
    for (const std::filesystem::path& beside : fanuc_files_beside(motion.program)) {
      const bool listed = std::ranges::any_of(motion.modules, [&](const auto& m) {
        return pipeline::inode_of(m.file) == pipeline::inode_of(beside) ||
               lower_case(m.file.filename().string()) == lower_case(beside.filename().string());
      });
      if (!listed) files.push_back(source_of(beside, instead));
    }
  Problems problems;
  Program program = read_program(language, std::move(files), options, frames_of(motion.tools),
                                 frames_of(motion.work_objects), problems);
  problems.throw_if_any();
  for (const std::string& file : missing)
    program.skipped.push_back(
        {{motion.program.string()}, file + ": the list of modules names it, it is not there", true});
  if (is_backup(motion.program))
    program.name = std::filesystem::absolute(motion.program).lexically_normal().stem().string();
  return program;
}

pipeline::Motion motion_of(const Program& program, const pipeline::Motion& defaults) {
  pipeline::Motion motion = defaults;
  motion.program.clear();
  motion.modules.clear();
  motion.assume.clear();
  motion.routine.clear();
  motion.values.clear();
  motion.passes = 0;
  if (motion.name.empty()) motion.name = program.name;
  motion.tools = frames_of(program.tools);
  motion.work_objects = frames_of(program.work_objects);
  motion.steps.clear();
  std::vector<pipeline::Warning> left_out = moves_left_out(program);
  for (pipeline::Warning& warning : left_out)  // independent of the program's folder
    warning.where = std::filesystem::path(warning.where).filename().string();
  motion.left_out = pipeline::joined(std::move(motion.left_out), left_out);
  for (const Instruction& instruction : program.instructions) motion.steps.push_back(step_of(instruction, program));
  // A motion begins at the target of its first move: the robot stands there during dwells before that move.
  const auto first_move = std::ranges::find_if(motion.steps, [](const auto& step) { return step.is_move(); });
  if (first_move != motion.steps.end()) std::rotate(motion.steps.begin(), first_move, first_move + 1);
  return motion;
}

namespace {

/// Returns notes about the unit of speeds and the duration of spot welds that are assumed.
std::vector<std::string> assumed_of(const Program& program, const pipeline::Motion& motion) {
  std::vector<std::string> assumed;
  for (const Skipped& skipped : program.skipped)
    if (!skipped.may_move && skipped.what.starts_with(unit_of_speeds))
      assumed.push_back(fmt::format("{}: {}",
                                    std::filesystem::path(skipped.where.file).filename().string() +
                                        (skipped.where.line > 0 ? fmt::format(":{}", skipped.where.line) : ""),
                                    skipped.what.substr(std::string_view("note: ").size())));
  const auto welds = std::ranges::count_if(program.instructions, [&](const Instruction& instruction) {
    const std::string line = lower_case(
        instruction.text.substr(std::min(instruction.text.find_first_not_of(" \t"), instruction.text.size())));
    return instruction.kind == Instruction::Kind::dwell && instruction.dwell == motion.spot_time &&
           (line.starts_with("spot") || line.starts_with("svspot") || line.find("spot[") != std::string::npos);
  });
  if (welds > 0 && motion.spot_time > 0 && motion.spot_time_where.line == 0)
    assumed.push_back(fmt::format("ESTIMATE, not in the job: motion.spot_time_s: {:g} ({} in the program)",
                                  motion.spot_time,
                                  welds == 1 ? "1 spot weld" : fmt::format("each of {} spot welds", welds)));
  return assumed;
}

}  // namespace

RunMotion run_motion_of(const pipeline::Motion& motion, const FlangeAt& flange) {
  if (motion.program.empty()) return {motion, ""};
  const Program program = read_program(motion, flange);
  return {motion_of(program, motion), waits_note(program), assumed_of(program, motion)};
}

namespace {

/// Splits "SetDO: input, output or logic" into "SetDO" and "input, output or logic".
std::pair<std::string, std::string> name_and_reason(const std::string& what) {
  const std::size_t colon = what.find(": ");
  return colon == std::string::npos ? std::pair(std::string(), what)
                                    : std::pair(what.substr(0, colon), what.substr(colon + 2));
}

struct SkippedGroup {
  pipeline::Where first;
  std::string name, reason;
  int more = 0;
  std::string lines;  // "14, 20, door.mod:3"
};

void add_to_group(SkippedGroup& group, const Skipped& skipped) {
  ++group.more;
  const std::string file = std::filesystem::path(skipped.where.file).filename().string();
  const bool same_file = skipped.where.file == group.first.file;
  group.lines +=
      fmt::format("{}{}{}", group.lines.empty() ? "" : ", ", same_file ? "" : file + ":", skipped.where.line);
}

}  // namespace

std::string waits_note(const Program& program) {
  static const pipeline::WordSet waits =
      pipeline::word_set("wait waitdi waitdo waitgi waitgo waitai waitao waitsynctask waituntil");
  const auto count = std::ranges::count_if(program.skipped, [](const Skipped& skipped) {
    return waits.contains(lower_case(name_and_reason(skipped.what).first));
  });
  if (count == 0) return "";
  return fmt::format(
      "{} {} 0 s: the cycle is shorter than in the plant. Count no waits in fatigue.operating_hours_per_week, or write their "
      "times into a copy of the program",
      count, count == 1 ? "wait for signals counts" : "waits for signals count");
}

namespace {

/// Cause and remedy of a doubtful number or frame, by the first words of the reason.
struct NumberDoubt {
  const char *reason, *cause, *remedy;
};
constexpr std::array<NumberDoubt, 14> doubts{
    {{beyond_range, "a digit too many or another unit", "a number within this range"},
     {other_frame, "a called program chose another frame, or the line before the move that chooses it is missing",
      "UFRAME_NUM= or UTOOL_NUM= before the move, with the number of the position"},
     {above_all_speed, "a digit too many", "a percentage up to 100"},
     {doubled_label, "a block of lines that was copied with its label", "another number for one of the labels"},
     {unread_rest, "an operator that is not read, or a slip",
      "numbers joined by + - * / DIV MOD, positions by + and -, in several lines"},
     {other_speed, "a move that became another kind, with its old speed", "a speed in a unit of this kind of move"},
     {two_robholds, "robhold is TRUE in both; a controller stops here",
      "robhold FALSE in the work object that stands in the cell, or FALSE in the tool that stands there"},
     {no_robhold, "robhold is FALSE in both, or the move has no \\WObj; a controller stops here",
      "\\WObj with a work object whose robhold is TRUE, or robhold TRUE in a tool that the robot holds"},
     {given_twice, "a component that is written twice, where another one was meant", "each component once"},
     {unlike_turns,
      "the swivel of the tool has another limit than its turn about itself, and the two are not read apart",
      "$VEL.ORI1 and $VEL.ORI2 alike, in a copy of the program, to choose the limit"},
     {reduced_speed, "$RED_VEL slows all moves of the program",
      "$OV_PRO with the same percentage in a copy of the program"},
     {turn_acceleration, "a soft start of turns, which the simulation takes as fast as the robot allows",
      "a smaller $VEL.ORI1 in a copy of the program if the turns are slow"},
     {fast_path, "mm/s or % instead of m/s", "a thousandth of this number if it is mm/s"},
     {tiny_move, "metres instead of millimetres", "a thousand times these numbers if they were metres"}}};

}  // namespace

std::vector<pipeline::Warning> moves_left_out(const Program& program) {
  std::vector<SkippedGroup> groups;
  std::map<std::string, std::size_t> known;
  for (const Skipped& skipped : program.skipped) {
    if (!skipped.may_move) continue;
    const auto [name, reason] = name_and_reason(skipped.what);
    const auto [at, is_new] = known.emplace(skipped.what, groups.size());
    if (is_new)
      groups.push_back({skipped.where, name, reason, 0, ""});
    else
      add_to_group(groups[at->second], skipped);
  }
  std::vector<pipeline::Warning> warnings;
  for (const SkippedGroup& group : groups) {
    const std::string more = fmt::format(" (and {} more: line {})", group.more, group.lines);
    const std::string what = fmt::format("skipped: {}{}{}", group.name.empty() ? "" : fmt::format("{}: ", group.name),
                                         group.reason, group.more == 0 ? "" : more);
    const auto warn = [&](const std::string& words, const char* cause, const std::string& remedy) {
      warnings.push_back(
          pipeline::warning_of(pipeline::WarningKind::program, group.first.text(), words, cause, remedy));
    };
    const std::string without_skipped = what.substr(what.find(": ") + 2);
    const auto doubt =
        std::ranges::find_if(doubts, [&](const NumberDoubt& of) { return group.reason.starts_with(of.reason); });
    if (what.find("motion.values") != std::string::npos) {  // the text contains the remedy
      warnings.push_back({pipeline::WarningKind::program, group.first.text(), what});
    } else if (what.find(later_passes_differ) != std::string::npos) {
      warn(without_skipped, "a counter, or an order, that decides in a later pass",
           "motion.passes: N, with the number of passes of one cycle of the cell");
    } else if (group.reason.starts_with(unread_word)) {
      const std::size_t nearest = group.reason.find(nearest_known);
      const std::string word =
          nearest == group.reason.npos ? "" : group.reason.substr(nearest + std::string(nearest_known).size());
      warn(without_skipped, "a mistyped word, or a word of an option that the importer does not know",
           (word.empty() ? "" : fmt::format("write {} if this is meant; else ", word)) +
               "take the word out of a copy of the program if it does not change the motion");
    } else if (doubt != doubts.end()) {
      warn(without_skipped, doubt->cause, doubt->remedy);
    } else {
      warn(what, "an instruction that the importer does not run and that may move the robot",
           "describe what it does by motion.values or motion.assume, or take it out of a copy of the program if it "
           "moves nothing (dresslife import --explain lists every move)");
    }
  }
  return warnings;
}

std::vector<std::string> skipped_lines(const Program& program) {
  std::vector<std::string> lines = pipeline::mapped(moves_left_out(program), &pipeline::Warning::line);
  std::map<std::string, std::map<std::string, int>> harmless;  // reason -> name -> count
  for (const Skipped& skipped : program.skipped) {
    if (skipped.may_move) continue;
    const auto [name, reason] = name_and_reason(skipped.what);
    if (name.empty() || name == "note")
      lines.push_back(fmt::format("{}: note: {}", skipped.where.text(), reason));
    else
      ++harmless[reason][name];
  }
  for (const auto& [reason, names] : harmless) {
    std::string list;
    for (const auto& [name, count] : names)
      list += fmt::format("{}{}{}", list.empty() ? "" : ", ", name, count > 1 ? fmt::format(" x{}", count) : "");
    lines.push_back(fmt::format("skipped: {}: {}", reason, list));
  }
  if (std::string note = waits_note(program); !note.empty()) lines.push_back("note: " + note);
  return lines;
}

}  // namespace dresslife::sim
