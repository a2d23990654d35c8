// dresslife-import: a robot program in, the same motion as YAML out; or what its lines could do instead; or a log of joint angles as
// a study and a duty.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/stage/stage.h"
#include "sim/program/answers.h"
#include "sim/program/explain.h"
#include "sim/program/import.h"
#include "sim/recording/log_study.h"
#include "sim/reprogram/ways_file.h"

namespace {

using namespace dresslife;

/// What the options of this program ask for.
struct Request {
  std::string routine, answers, frames;
  std::vector<std::string> assume, modules, values;
  std::optional<int> passes;
  bool explain = false;
  std::string ways;  ///< life.h5 of the job; empty: not asked
  int lines = 4;
  std::string log;  ///< job whose robot the log is of; empty: not a log
  double smooth_deg = 0.1, alike_deg = 2, warp_percent = 10;
  int recordings = 8;
};

constexpr double shortest_cycle = 5;  // [s] of motion: shorter cycles count as several together

/// "NAME=VALUE" cut at its first or last '='.
std::pair<std::string, std::string> halves(const std::string& option, const std::string& written, std::size_t equals,
                                           const std::string& example) {
  if (equals == std::string::npos || equals == 0 || equals + 1 == written.size())
    throw pipeline::InputError({option + " " + written}, "has nothing before or behind '='",
                               "write for example " + option + " " + example);
  return {written.substr(0, equals), written.substr(equals + 1)};
}

pipeline::Motion motion_asked_for(const Request& request, const std::filesystem::path& program) {
  pipeline::Motion motion;
  if (!request.frames.empty()) motion = pipeline::motion_from(pipeline::read_yaml(request.frames));
  if (!request.answers.empty() && std::filesystem::exists(request.answers)) sim::add_answers(request.answers, motion);
  motion.program = program;
  const std::filesystem::path input = std::filesystem::absolute(program).lexically_normal();
  motion.source = "imported from " + (input.has_filename() ? input : input.parent_path()).filename().string();
  if (!request.routine.empty()) motion.routine = request.routine;
  for (const std::string& written : request.assume) {
    const auto [line, take] = halves("--assume", written, written.rfind('='), "main.mod:12=then");
    motion.assume.push_back({line, take});
  }
  for (const std::string& file : request.modules) motion.modules.push_back({file});
  for (const std::string& written : request.values) {
    const auto [name, text] = halves("--value", written, written.find('='), "di5=1");
    motion.values.push_back({name, text});
  }
  if (request.passes) motion.passes = *request.passes;
  return motion;
}

std::string counted(std::size_t questions) {
  return questions == 1 ? "this question" : fmt::format("these {} questions", questions);
}

/// Whether the file of answers holds each of the questions, without an answer.
bool all_are_empty(const std::vector<sim::Problem>& problems, const pipeline::Motion& asked) {
  for (const sim::Problem& problem : problems)
    for (const sim::Question& question : problem.questions)
      if (std::ranges::none_of(asked.values,
                               [&](const auto& v) { return v.value.empty() && v.name == question.name; }) &&
          std::ranges::none_of(asked.assume, [&](const auto& a) { return a.take.empty() && a.line == question.name; }))
        return false;
  return true;
}

/// The file itself, else with the first number behind its name that no file has.
std::filesystem::path free_name(const std::filesystem::path& wanted) {
  std::filesystem::path name = wanted;
  for (int number = 2; std::filesystem::exists(std::filesystem::symlink_status(name)); ++number)
    name = wanted.parent_path() / fmt::format("{}-{}{}", wanted.stem().string(), number, wanted.extension().string());
  return name;
}

/// Reads the program. Where it asks, the questions go to a file of answers, if there is to be one.
sim::Program program_of(const pipeline::Motion& asked, const std::filesystem::path& file) {
  try {
    return sim::read_program(asked);
  } catch (const sim::Unread& unread) {
    const std::size_t count = sim::question_count(unread.problems);
    if (count == 0) throw;
    if (file.empty())
      throw unread.with(fmt::format("--answers FILE writes {} to a file, to be filled in", counted(count)));
    if (std::filesystem::exists(file) && all_are_empty(unread.problems, asked))
      throw unread.with(fmt::format("{}: no answer is written there to {}", file.string(), counted(count)));
    const std::filesystem::path written = free_name(file);
    pipeline::write_text_if_changed(
        written, pipeline::with_mark(sim::answers_text(unread.problems, asked), pipeline::Mark::yaml));
    throw unread.with(fmt::format("{}: holds {}: fill it in, and import with --answers {}", written.string(),
                                  counted(count), written.string()));
  }
}

/// Refuses options that this kind of work does not use.
void refuse_unused(const Request& request, const pipeline::StageCall& call) {
  const bool of_job = !request.ways.empty(), of_log = !request.log.empty();
  if (!of_job && !of_log && !call.sets.empty())
    throw pipeline::InputError({"--set " + call.sets.front()}, "changes a job, and the input is a program",
                               "give --routine, --assume, --value or --passes, or set it in a job with this program");
  const std::pair<const char*, bool> others[] = {{"--log", of_job && of_log},
                                                 {"--routine", !request.routine.empty()},
                                                 {"--answers", !request.answers.empty()},
                                                 {"--assume", !request.assume.empty()},
                                                 {"--module", !request.modules.empty()},
                                                 {"--frames", !request.frames.empty()},
                                                 {"--value", of_job && !request.values.empty()},
                                                 {"--passes", request.passes.has_value()},
                                                 {"--explain", request.explain}};
  for (const auto& [option, given] : others)
    if (given && (of_job || of_log))
      throw pipeline::InputError({option}, of_job ? "does nothing with --ways" : "does nothing with --log",
                                 of_job ? "write it into the job (motion)" : "leave it out");
}

/// What the lines of a job's program could do instead.
void note_ways(const Request& request, const pipeline::StageCall& call) {
  if (call.output.empty())
    throw pipeline::InputError({"--ways"}, "has no file to write to", "name one with -o ways.h5");
  const pipeline::Job job = pipeline::read_job(call.input, call.sets);
  pipeline::FileWriter file(call.output, pipeline::ways_format());
  sim::write_ways(job, request.ways, static_cast<std::size_t>(request.lines), file);
  pipeline::stamp(file, call, job, "");
  file.commit();
}

pipeline::Node job_of_log(const std::filesystem::path& file) {
  pipeline::note_input(file);
  pipeline::Node job = pipeline::read_yaml(file);
  pipeline::apply_lines(job);
  return job;
}

/// Keys of the mounting poses that a job does not give.
std::vector<std::string> open_mounting(const pipeline::Node& job) {
  const auto is_open = [](const pipeline::Node& of) {
    const pipeline::Node* const routing = of.find("routing");
    return routing && !routing->find("mounting_pose_deg");
  };
  std::vector<std::string> keys;
  if (is_open(job)) keys.emplace_back("routing.mounting_pose_deg");
  if (const pipeline::Node* const packs = job.find("dresspacks"))
    for (std::size_t k = 0; k < packs->items.size(); ++k)
      if (is_open(packs->items[k])) keys.push_back(fmt::format("dresspacks.{}.routing.mounting_pose_deg", k + 1));
  return keys;
}

/// A motion of its own is not needed.
pipeline::Robot robot_of(const pipeline::Node& job) {
  const pipeline::Node* const robot = job.find("robot");
  if (!robot) throw pipeline::InputError(job.where, "robot is missing", "name a job, as dresslife new writes it");
  pipeline::Node alone;
  alone.where = job.where;
  alone["robot"] = *robot;
  pipeline::resolve_job(alone);
  pipeline::Robot made;
  pipeline::read_fields(*alone.find("robot"), made);
  return made;
}

sim::LogOptions log_options(const Request& request) {
  sim::LogOptions options;
  options.still = request.smooth_deg * std::numbers::pi / 180;
  for (const std::string& written : request.values) {
    const auto [name, text] = halves("--value", written, written.find('='), "unit=deg");
    const pipeline::Where where{"--value " + written};
    if (name == "unit" && (text == "deg" || text == "rad")) {
      options.unit = text;
    } else if (name == "joints") {
      options.joints = text;
    } else if (name == "rate_Hz") {
      options.rate = pipeline::number_in(text).value_or(0);
      if (!(options.rate > 0 && std::isfinite(options.rate)))
        throw pipeline::InputError(where, "is no rate", "give the rows per second: --value rate_Hz=10");
    } else {
      throw pipeline::InputError(where, "is no value of a log",
                                 "give unit=deg, unit=rad, joints=NAME,NAME,.. or rate_Hz=10");
    }
  }
  return options;
}

/// Writes DUTY.yaml and a folder of its name with the study and its motions.
void note_log(const Request& request, const pipeline::StageCall& call, pipeline::Progress& progress) {
  const std::string name = call.output.stem().string();
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  if (call.output.empty())
    throw pipeline::InputError({"--log"}, "needs a file of duties to write", "name it: -o shift.yaml");
  if (call.output.extension() != ".yaml" || !std::ranges::all_of(name, fits))
    throw pipeline::InputError({call.output.string()}, "is no name for a file of duties",
                               "name it with letters, digits, - and _: -o shift.yaml");
  if (!call.sets.empty())
    throw pipeline::InputError({"--set " + call.sets.front()}, "does not change a log", "give it to dresslife duty");
  const pipeline::Node job = job_of_log(request.log);
  const pipeline::Robot robot = robot_of(job);
  const double degree = std::numbers::pi / 180;
  const sim::LogOptions options = log_options(request);
  progress.note(sim::estimate_words(call.input, sim::size_of_log(call.input, robot, options)));
  const sim::Recording log =
      sim::read_log(call.input, robot, options, [&](double share) { progress.show(share, "reads the log"); });
  const sim::Course course(log, robot, options.still);
  const sim::Cycles cycles =
      sim::cycles_of(course, {request.alike_deg * degree, request.warp_percent / 100, shortest_cycle},
                     [&](double share) { progress.show(share, "finds cycles"); });
  std::vector<sim::LogMotion> motions = sim::motions_of(course, cycles, options.still, request.recordings);
  pipeline::SimulationSettings simulation;
  if (const pipeline::Node* const settings = job.find("simulation")) pipeline::read_fields(*settings, simulation);
  sim::end_at_samples(motions, simulation.sample_rate);
  progress.clear();
  if (!call.quiet)
    for (const std::string& line : sim::read_words(log, course)) fmt::print("{}\n", line);
  if (motions.empty())
    throw pipeline::InputError({call.input.string()},
                               fmt::format("the robot does not move by more than {} deg", request.smooth_deg),
                               "name a log of a robot that moves");
  const std::filesystem::path beside = call.output.parent_path(), folder = beside / name;
  std::vector<std::pair<std::filesystem::path, std::string>> files;
  for (const sim::LogMotion& motion : motions)
    files.emplace_back(folder / (motion.name + ".csv"), sim::motion_csv(motion));
  const std::filesystem::path base = ".." / pipeline::as_seen_from(beside.empty() ? "." : beside, request.log);
  files.emplace_back(folder / "study.yaml", sim::study_text(name, base, log, open_mounting(job), motions));
  files.emplace_back(call.output, sim::duty_text(name, name + "/study.yaml", course, motions));
  for (const auto& [file, text] : files) pipeline::check_replaceable(file);
  std::filesystem::create_directories(folder);
  for (const auto& [file, text] : files)
    pipeline::write_text_if_changed(file, pipeline::with_mark(text, pipeline::Mark::yaml));
  if (call.quiet) return;
  for (const std::string& line : sim::log_words(log, course, cycles, motions)) fmt::print("{}\n", line);
  fmt::print("Next: dresslife duty {}\n", call.output.string());
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  const pipeline::StageInfo info{
      .program = "dresslife-import",
      .purpose =
          "Reads a robot program (RAPID, KRL, Fanuc, INFORM, URScript, joint columns, ROS), or the folder of a "
          "controller's backup, and writes its motion as YAML. A log of joint angles becomes a study and a duty (--log). "
          "Messages name keys of a job, which options give, too: motion.values by --value, motion.assume by --assume, "
          "motion.modules by --module, motion.tools and motion.work_objects by --frames, motion.routine by --routine, "
          "motion.passes by --passes.",
      .input = "PROGRAM or FOLDER; with --ways JOB.yaml; with --log LOG.csv",
      .output = "motion.yaml; with --ways ways.h5; with --log DUTY.yaml",
      .example = "dresslife-import config/programs/side_panel.mod -o motion.yaml",
      .input_is_job = true,
      .may_lack_output = true,
      .options = {
          {"--routine", "NAME",
           "where to start, with arguments where it takes some: 'name(1, p20)'; without it "
           "main, or the first routine",
           &request.routine},
          {"--answers", "FILE.yaml", "what the program asks: written there to be filled in, read where the file exists",
           &request.answers},
          {"--assume", "LINE=then|else|VALUE",
           "one answer: how a branch goes that depends on inputs, or the value by which a "
           "choice of several goes; LINE may be FILE:LINE",
           &request.assume},
          {"--module", "FILE", "a further module, data file or called program", &request.modules},
          {"--frames", "FILE.yaml", "answers: tools and work_objects that lie in the controller", &request.frames},
          {"--value", "NAME=VALUE",
           "one answer: an input, register, variable or position that only the running robot knows", &request.values},
          pipeline::number_option("--passes", "N",
                                  "of an endless main loop; without it until the program repeats itself",
                                  &request.passes, 1, 1'000'000'000),
          {"--explain", "", "print each move with tool, work object, speed and zone, and where each comes from",
           &request.explain},
          {"--ways", "life.h5",
           "instead: what the lines of the job's program could do instead, as its dresspack's life says what each "
           "costs, with patches",
           &request.ways},
          pipeline::number_option("--lines", "COUNT", "with --ways: those that cost most", &request.lines, 0, 1000,
                                  {.needs = "--ways"}),
          {"--log", "JOB.yaml",
           "instead: the cycles and the rest of a log as a study and a duty of this job's robot, dresspack and routing",
           &request.log},
          pipeline::number_option("--smooth", "DEG",
                                  "with --log: largest distance of the motion from a row, and of rows of a standstill",
                                  &request.smooth_deg, 1e-4, 5, {.needs = "--log"}),
          pipeline::number_option("--alike", "DEG", "with --log: largest difference of cycles that count as one",
                                  &request.alike_deg, 1e-3, 20, {.needs = "--log"}),
          pipeline::number_option("--warp", "PERCENT", "with --log: largest difference of their times",
                                  &request.warp_percent, 0, 50, {.needs = "--log"}),
          pipeline::number_option(
              "--recordings", "COUNT",
              "with --log: motions of one cycle that are simulated, at most, and at most three if they take more than 600 s together; their damages show how well its damage is known",
              &request.recordings, 1, 20, {.needs = "--log"})}};
  return pipeline::run_stage(
      info, argc, argv, [&request](const pipeline::StageCall& call, pipeline::Progress& progress) {
        refuse_unused(request, call);
        if (!request.ways.empty()) return note_ways(request, call);
        if (!request.log.empty()) return note_log(request, call, progress);
        if (call.output.empty() && !request.explain)
          throw pipeline::InputError({call.input.string()}, "has no output",
                                     "name a file with -o, or ask for --explain");
        const pipeline::Motion asked = motion_asked_for(request, call.input);
        const sim::Program program = program_of(asked, request.answers);
        progress.clear();
        if (request.explain)
          for (const std::string& line : sim::explanation(program)) fmt::print("{}\n", line);
        if (!call.quiet)
          for (const std::string& line : sim::skipped_lines(program)) pipeline::write_stderr(line + "\n");
        if (call.output.empty()) return;
        pipeline::write_text_if_changed(
            call.output,
            pipeline::with_mark(pipeline::motion_text(sim::motion_of(program, asked)), pipeline::Mark::yaml));
        progress.note(fmt::format("{}: {} moves and dwells", call.output.string(), program.instructions.size()));
      });
}
