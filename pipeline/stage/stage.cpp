#include "pipeline/stage/stage.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <sstream>
#include <system_error>

#include "pipeline/base/digest.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/threads.h"
#include "pipeline/base/words.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/receipt.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

std::string_view part_name(JobPart part) {
  return word_at({"robot, motion, dresspack, routing or simulation", "dresspack.components or strain",
                  "dresspack.materials or fatigue"},
                 part);
}

/// Options that only the command line of a stage has.
struct StageFlags {
  bool force = false;
  std::filesystem::path receipt;
  std::filesystem::path same;  ///< file with the folders of further jobs that this output belongs to, one per line
};

void check_output(const StageCall& call, const StageFlags& flags) {
  if (flags.force) let_replace_files_of_others();
  if (!flags.receipt.empty()) check_replaceable(flags.receipt, "name another file with --receipt");
  if (call.info.may_lack_output && call.output.empty()) return;
  const auto folder = call.output.parent_path();
  if (!folder.empty() && kind_of(folder) != FileKind::folder)
    throw InputError({call.output.string()}, "lies in a folder that does not exist",
                     fmt::format("make {} first", folder.string()));
  check_replaceable(call.output);
}

/// Returns the state of the file behind all links, because inputs may be in any folder.
FileState input_state(const std::filesystem::path& file) {
  std::error_code failure;
  const std::filesystem::path target = std::filesystem::canonical(file, failure);
  if (failure && failure != std::errc::no_such_file_or_directory) throw DiskError(file.string(), failure.value());
  return failure ? FileState{} : state_of(target);
}

/// Two changes in one tick of the file system's clock have the same state. So if a file was changed very recently, or in the
/// future, its bytes are compared.
StageInput input_as_it_is(const std::filesystem::path& file) {
  if (kind_of(file) == FileKind::other) PlainFile{file};  // refuses it
  note_input(file);
  constexpr auto tick = std::chrono::milliseconds(10);  // of the slowest kernels
  const FileState state = input_state(file);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t age = std::chrono::nanoseconds(now).count() - state.changed_ns;
  const bool young = age < std::chrono::nanoseconds(tick).count();
  return {file, state, stored_checksum(file), young};
}

/// A file that got or lost another name (hard link) has another change time, but the same bytes.
bool is_unchanged(const StageInput& input) {
  FileState now = input_state(input.file);
  if (now == input.state) return !input.young || stored_checksum(input.file) == input.checksum;
  now.changed_ns = input.state.changed_ns;
  return now == input.state && input.checksum && checksum_of(input.file) == input.checksum;
}

void check_inputs_unchanged(const StageCall& call) {
  for (const StageInput& input : call.inputs)
    if (!is_unchanged(input))
      throw MachineFault({input.file.string()}, fmt::format("has changed while {} ran", call.info.program),
                         "let nothing change it meanwhile");
}

Command command_of(const StageInfo& info, StageCall& call, StageFlags& flags) {
  std::vector<Option> options{
      {"input", "", info.input, &call.input, {.required = true}},
      {"-o,--output", "FILE", "where to write " + info.output, &call.output, {.required = !info.may_lack_output}}};
  if (!info.input_is_job)
    options.push_back(
        {"--job", "JOB.yaml", "take the settings from this job instead of the one in the input", &call.job_file});
  options.push_back({"--set", "KEY.PATH=VALUE",
                     "override a key of the job, for example simulation.segments=80; may be repeated", &call.sets});
  options.insert(options.end(), info.options.begin(), info.options.end());
  options.push_back(
      {"--force", "", "replace files that dresslife did not write; never one that it reads", &flags.force});
  if (info.part) {
    options.push_back({"--receipt",
                       "FILE",
                       "note there from what the output is made, and make it only when that has changed",
                       &flags.receipt,
                       {.needs = info.input_is_job ? "" : "--job"}});
    options.push_back({"--same",
                       "FILE",
                       "file with a list of folders that get the same output and receipt, each under its name",
                       &flags.same,
                       {.needs = "--receipt"}});
  }
  options.push_back({"--job-time", "SECONDS", "give up after so long", &call.limits.seconds, {.shown_default = ""}});
  options.push_back(
      {"--job-memory", "MB", "take no more memory than this", &call.limits.megabytes, {.shown_default = ""}});
  options.push_back({"--quiet", "", "no progress, no notes", &call.quiet});
  return {.name = info.program, .purpose = info.purpose, .options = options, .example = info.example};
}

/// The settings on which the stage's result depends, and the files beside the job.
struct Settings {
  std::string text;
  std::vector<std::filesystem::path> files;
};
Settings settings_of(const StageCall& call) {
  const Job job = read_job(call.info.input_is_job ? call.input : call.job_file, call.sets);
  if (*call.info.part != JobPart::sim) return {part_text(job, *call.info.part), {}};
  for (const std::filesystem::path& file : {job.motion.clamp_poses, job.motion.deformation})
    if (kind_of(file) == FileKind::folder) PlainFile{file};  // refuses it
  return {part_text(job, *call.info.part), files_beside(job)};
}

void say(const StageCall& call, Progress& progress, const Warning& warning) {
  if (call.of_a_study)
    write_stderr(warning.line() + "\n");
  else
    progress.note(warning.line());
}

std::vector<Warning> warnings_in(const FileReader& file) {
  return file.has_attribute("warnings") ? warnings_from(file.text_attribute("warnings")) : std::vector<Warning>{};
}

const Format& format_of_output(JobPart part) {
  return part == JobPart::sim ? motion_format() : part == JobPart::strain ? strain_format() : life_format();
}

/// Prints the warnings of the stage into the log also if the output is from an earlier run.
void say_known_warnings(const StageCall& call) {
  std::vector<Warning> before;
  if (*call.info.part != JobPart::sim) {
    const Format& format = format_of_output(*call.info.part == JobPart::strain ? JobPart::sim : JobPart::strain);
    before = warnings_in(FileReader(call.input, format, FileReader::Scope::attributes));
  }
  Progress silent(call.info.program, true);
  for (const Warning& warning :
       warnings_in(FileReader(call.output, format_of_output(*call.info.part), FileReader::Scope::attributes)))
    if (std::ranges::find(before, warning) == before.end()) say(call, silent, warning);
}

/// Gives the output to the jobs of a study that are equal up to this stage, by a second name for each. The names are made before
/// the receipts, because each new name changes the state of the file.
void share_output(const StageCall& call, const StageFlags& flags, const Receipt& receipt) {
  if (flags.same.empty()) return write_receipt(flags.receipt, receipt, call.output);
  const std::filesystem::path name = call.output.filename(),
                              note = flags.receipt.lexically_relative(call.output.parent_path());
  std::vector<std::filesystem::path> folders;
  std::istringstream lines(read_text(flags.same));
  for (std::string line; std::getline(lines, line);) folders.push_back(line);
  for (const std::filesystem::path& folder : folders) {
    remove_ours(folder / note);  // it describes a file that will be replaced
    give_second_name(call.output, folder / name);
  }
  write_receipt(flags.receipt, receipt, call.output);
  for (const std::filesystem::path& folder : folders) write_receipt(folder / note, receipt, folder / name);
}

/// Runs the body unless the receipt shows that the output is up to date.
void run_with_receipt(const StageCall& call, const StageFlags& flags, const Settings& settings,
                      const std::function<void()>& body) {
  Digests digests;
  if (const char* const noted = std::getenv("DRESSLIFE_DIGESTS")) digests.believe(noted);
  Receipt wanted;
  wanted.recipe = recipe_of(settings.text, settings.files, program_file(), digests);
  wanted.made_with.emplace_back(call.info.program, digests.of(program_file()));
  for (const std::filesystem::path& file : settings.files)
    wanted.made_with.emplace_back(as_seen_from(call.output.parent_path(), file).string(), digests.of(file));
  wanted.input = call.info.input_is_job ? "-" : stored_checksum(call.input).value_or("damaged");
  const std::optional<Receipt> known = read_receipt(flags.receipt);
  const bool made =
      known && known->recipe == wanted.recipe && known->input == wanted.input && is_as_noted(*known, call.output);
  if (made) {
    say_known_warnings(call);
    wanted.output = known->output;
    wanted.results = known->results;
  } else {
    remove_ours(flags.receipt);  // it describes a file that will be replaced
    body();
    wanted.output = stored_checksum(call.output).value_or("damaged");
    if (call.info.results) wanted.results = call.info.results(call.output);
  }
  check_inputs_unchanged(call);
  share_output(call, flags, wanted);
}

/// Memory limit until a stage knows the need of its job (pipeline/stage/memory.h). It is enough to read the job and the input.
constexpr std::uint64_t enough_to_begin_mb = 64;

void run_body(StageCall& call, const StageFlags& flags, const std::function<void(const StageCall&, Progress&)>& body) {
  limit_time(call.info.program, call.limits.seconds);
  limit_memory(call.limits.megabytes > 0 ? std::max(call.limits.megabytes, enough_to_begin_mb) : 0);
  Progress progress(call.info.program, call.quiet);
  const Sources documents;  // the receipt and the stage use the same text of a file, which is read once
  const auto watch = [&](const std::filesystem::path& file) { call.inputs.push_back(input_as_it_is(file)); };
  watch(call.input);
  if (!call.job_file.empty()) watch(call.job_file);
  std::optional<Settings> settings;
  if (call.info.part && (call.info.input_is_job || !call.job_file.empty())) settings = settings_of(call);
  if (settings)
    for (const std::filesystem::path& file : settings->files) watch(file);
  check_output(call, flags);
  if (!call.info.input_is_job)  // job files are short
    call.input_sha256 = beside<std::string>([file = call.input] { return sha256_as_checked(file); }).share();
  if (flags.receipt.empty()) return body(call, progress);
  run_with_receipt(call, flags, *settings, [&] { body(call, progress); });
}

}  // namespace

int run_stage(const StageInfo& info, int argc, char** argv,
              const std::function<void(const StageCall&, Progress&)>& body) {
  settle_streams();
  end_with_parent();
  StageCall call;
  StageFlags flags;
  call.info = info;
  return guarded(info.program, [&] {
    if (const auto status = read_command_line(command_of(info, call, flags), argc, argv)) return *status;
    call.of_a_study = !flags.receipt.empty();
    run_body(call, flags, body);
    return 0;
  });
}

namespace {
int output_error = 0;
}

void note_failed_output(int error) { output_error = error; }

int finish_output(int status) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.good()) return status;
  if (errno != 0) note_failed_output(errno);
  // Libraries do not store the reason of a failed write; writing one more byte fails with the same reason.
  if (output_error == 0 && ::write(STDOUT_FILENO, "\n", 1) < 0) note_failed_output(errno);
  write_stderr(fmt::format("standard output: error: cannot be written{}; free space or name another place\n",
                           output_error == 0 ? "" : fmt::format(" ({})", std::strerror(output_error))));
  return std::max(status, 1);
}

int guarded(const std::string& program, const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& problem) {
    write_stderr(fmt::format("{}\n", problem.what()));
    return 1;
  } catch (const DiskError& problem) {
    write_stderr(fmt::format("{}\n", problem.what()));
    return 1;
  } catch (const std::filesystem::filesystem_error& problem) {
    write_stderr(fmt::format("{}: error: {}; check the folder and its permissions{}\n",
                             problem.path1().empty() ? program : problem.path1().string(), problem.code().message(),
                             then_run_again));
    return 1;
  } catch (const std::bad_alloc&) {
    write_stderr(fmt::format("{}: {}", program, out_of_memory_words));
    return 1;
  } catch (const std::system_error& problem) {
    write_stderr(fmt::format("{}: error: the system refuses ({}); run fewer jobs at a time or raise its limits{}\n",
                             program, problem.what(), then_run_again));
    return 1;
  } catch (const std::exception& problem) {
    write_stderr(
        fmt::format("{}: error: internal fault ({}); please report it with the job\n", program, problem.what()));
    return 3;
  }
}

namespace {

/// Lines of a history: the files beside a job that its simulation reads, with digests of their bytes.
constexpr std::string_view reads = "\n  reads ";
std::string files_read(const Job& job) {
  std::string lines;
  Digests digests;
  for (const std::filesystem::path& file : files_beside(job))
    lines += fmt::format("{}{} xxh3-128 {}", reads, file.filename().string(), digests.of(file));
  return lines;
}

/// Returns these lines of a file's history; std::nullopt if it has none, for example in files of older programs.
std::optional<std::string> files_read(const FileReader& file) {
  std::istringstream history(file.text_attribute("history"));
  std::string lines;
  for (std::string line; std::getline(history, line);)
    if (("\n" + line).starts_with(reads)) lines += '\n' + line;
  return lines.empty() ? std::nullopt : std::optional(lines);
}

}  // namespace

Job job_of(const StageCall& call, const FileReader& input, const std::vector<JobPart>& before) {
  const std::string own_text = input.text_attribute("job");
  const std::string own_name = input.where().file + " (attribute job)";
  // In a study the two texts are equal, and parsing one is enough.
  if (!call.job_file.empty() && call.sets.empty() && without_mark(read_source(call.job_file)) == own_text)
    return read_job(call.job_file);
  const Job own = job_from(parse_yaml(own_text, own_name));
  const Job job =
      call.job_file.empty() ? job_from(parse_yaml(own_text, own_name), call.sets) : read_job(call.job_file, call.sets);
  for (JobPart part : before)
    if (part_text(own, part) != part_text(job, part))
      throw InputError(
          input.where(), fmt::format("was made with other settings of {} than this job has", part_name(part)),
          fmt::format("run the stage before again with the same --job and --set, then {}", call.info.program));
  if (const auto lines = files_read(input); lines && !call.job_file.empty() && *lines != files_read(job))
    throw InputError(input.where(), "was made with other files beside the job than this job has",
                     fmt::format("run the stage before again with the same --job, then {}", call.info.program));
  return job;
}

namespace {

/// Returns the warnings of a study's job with paths of keys as their places. Its file is the resolved job, which has other lines than
/// the user's files, and jobs with equal results share them.
std::vector<Warning> placed_by_key(std::vector<Warning> warnings, const StageCall& call) {
  const std::filesystem::path& job = call.info.input_is_job ? call.input : call.job_file;
  const auto in_job = [&](const Warning& warning) { return warning.where.starts_with(job.string() + ":"); };
  if (!call.of_a_study || std::ranges::none_of(warnings, in_job)) return warnings;
  const Node document = read_yaml(job);
  for (Warning& warning : warnings)
    if (in_job(warning)) warning.where = key_at(document, warning.where);
  return warnings;
}

}  // namespace

void note_warnings(FileWriter& file, const StageCall& call, Progress& progress, const std::vector<Warning>& of_stage,
                   const FileReader* before) {
  const std::vector<Warning> own = placed_by_key(of_stage, call);
  for (const Warning& warning : own) say(call, progress, warning);
  if (before && !before->has_attribute("warnings")) return;
  file.attribute("warnings", warnings_text(joined(before ? warnings_in(*before) : std::vector<Warning>{}, own)));
}

void stamp(FileWriter& file, const StageCall& call, const Job& job, const std::string& earlier) {
  check_inputs_unchanged(call);
  // The history does not contain the output's name, so that one input gives the same bytes under any name.
  std::string line =
      fmt::format("{} {}: {} {}", call.info.program, version(), call.info.program, call.input.filename().string());
  if (!call.job_file.empty()) line += " --job " + call.job_file.filename().string();
  for (const std::string& set : call.sets) line += " --set " + set;
  if (call.info.part == JobPart::sim) line += files_read(job);
  const std::filesystem::path& described_by = call.job_file.empty() ? call.input : call.job_file;
  file.attribute("job", stored_job_text(job, described_by.parent_path()));
  file.attribute("history", earlier.empty() ? line : earlier + "\n" + line);
  file.attribute("input_sha256", call.input_sha256.valid() ? call.input_sha256.get() : sha256_as_checked(call.input));
}

}  // namespace dresslife::pipeline
