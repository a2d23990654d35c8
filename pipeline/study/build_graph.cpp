#include "pipeline/study/build_graph.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>
#include <system_error>
#include <unordered_map>

#include "pipeline/base/joined.h"
#include "pipeline/base/threads.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/receipt.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct Stage {
  const char* name;
  JobPart part;
  const char* input;  ///< file name in the job's folder
  const char* output;
};
constexpr std::array<Stage, stage_count> stages{Stage{"sim", JobPart::sim, "job.yaml", "motion.h5"},
                                                Stage{"strain", JobPart::strain, "motion.h5", "strain.h5"},
                                                Stage{"fatigue", JobPart::fatigue, "strain.h5", "life.h5"}};

/// Returns the path, in the job's folder, of an internal file of a stage.
fs::path beside(const Stage& stage, const char* ending) {
  return fs::path(".stage") / (std::string(stage.name) + ending);
}
fs::path receipt_file(const Stage& stage) { return beside(stage, ".receipt"); }
fs::path log_file(const Stage& stage) { return beside(stage, ".log"); }
fs::path launcher_log(const Stage& stage) { return beside(stage, ".launcher"); }
constexpr const char* failure_file = ".stage/failure";
std::string program_name(const Stage& stage) { return std::string("dresslife-") + stage.name; }

/// (stage) path of the program, with links resolved. Errors: InputError when a program is missing.
using Programs = std::array<fs::path, stage_count>;
Programs found_programs(const StudyPlaces& places) {
  Programs programs;
  for (std::size_t k = 0; k < stage_count; ++k) {
    const fs::path program = places.programs / program_name(stages[k]);
    const bool may_run = ::access(program.c_str(), X_OK) == 0;
    if (!may_run && errno != ENOENT) throw DiskError(program.string(), errno);
    if (!may_run)
      throw InputError({program.string()}, "is not there (the stages stand beside dresslife)",
                       "build it: scripts/build");
    programs[k] = fs::canonical(program);
  }
  return programs;
}

/// Sets the recipe of each stage: digests of the settings, files and program that the stage reads. held: guards `digests`. The
/// texts of the settings take almost all the time and are made without it.
void set_recipes(JobState& state, const StudyJob& job, const Programs& programs, PieceTexts& texts, Digests& digests,
                 std::mutex& held) {
  const std::vector<fs::path> files = texts.files_beside(job.job);
  std::string all;
  for (std::size_t k = 0; k < stage_count; ++k) {
    const std::string text = texts.part_text(job.job, stages[k].part);
    const std::lock_guard lock(held);
    state.recipes[k] =
        recipe_of(text, stages[k].part == JobPart::sim ? files : std::vector<fs::path>{}, programs[k], digests);
    all += text;
  }
  constexpr std::size_t digits = 12;
  const std::lock_guard lock(held);
  state.settings = recipe_of(all, files, {}, digests).substr(0, digits);
}

/// Sets `next` to the first stage whose receipt does not name the present recipe, input and output.
void follow_receipts(JobState& state, const fs::path& folder) {
  state.inputs = {"-"};
  for (state.next = 0; state.next < stage_count; ++state.next) {
    const Stage& stage = stages[state.next];
    std::optional<Receipt> receipt = read_receipt(folder / receipt_file(stage));
    if (!receipt || receipt->recipe != state.recipes[state.next] || receipt->input != state.inputs[state.next]) return;
    // After a failure the bytes are always compared: a stage may have found damage that the file times do not show.
    if (!state.failure.empty()) receipt->state = {};
    const FileState now = state_of(folder / stage.output);
    const bool removed = !now.exists() && may_lack(state.keep, state.next);
    if (!removed && !is_as_noted(*receipt, folder / stage.output)) {
      if (now.exists()) state.damaged = stage.output;
      return;
    }
    if (!removed && (now != receipt->state || !receipt->state_suffices())) state.compared.push_back(state.next);
    if (state.next + 1 < stage_count) state.inputs[state.next + 1] = receipt->output;
    if (state.next + 1 == stage_count) state.results = std::move(receipt->results);
  }
}

/// Finds an existing result of other settings: by its receipt, or by its own checksum if a stage began a new result and failed.
void find_last(JobState& state, const fs::path& folder) {
  state.has_last = false;
  state.changed.clear();
  if (state.done() || !state.damaged.empty()) return;
  const Stage& last = stages.back();
  const bool there = state_of(folder / last.output).exists();
  const std::optional<Receipt> receipt = read_receipt(folder / receipt_file(last));
  if (!receipt) {
    // A user's file with this name has no checksum, so it is not taken for a result.
    state.has_last =
        there && begins_with_checksum(folder / last.output) && checksum_of(folder / last.output).has_value();
    return;
  }
  state.has_last =
      there ? is_as_noted(*receipt, folder / last.output) : state.keep == Keep::lives && !receipt->results.empty();
  if (state.has_last) state.results = receipt->results;
}

std::string failure_key(const JobState& state) { return joined(state.recipes, " "); }

/// Returns the reason why the last attempt failed, if that attempt had the present recipes.
std::string noted_failure(const JobState& state, const fs::path& folder) {
  if (!state_of(folder / failure_file).exists()) return "";
  std::istringstream lines(read_text(folder / failure_file));
  std::string key, reason;
  std::getline(lines, key);
  std::getline(lines, reason);
  return key == failure_key(state) ? reason : "";
}

/// Returns the words in front of a stage's program, quoted for Ninja. The stage writes its log on the node where it runs.
/// Messages of launchers (srun also reports exit statuses) go to a separate file, because their order relative to the log is
/// unknown.
std::string launching(const std::string& launcher, const Stage& stage) {
  if (launcher.empty()) return "";
  std::string words = "env -u DRESSLIFE_PARENT ";
  for (const char letter : launcher) words += letter == '$' ? "$$" : std::string(1, letter);
  return words + fmt::format(" sh -c 'exec \"$$0\" \"$$@\" > $job/{} 2>&1' ", log_file(stage).string());
}

std::string rules(const StudyPlaces& places, const StageLimits& limits, const std::string& launcher) {
  std::string text = fmt::format("ninja_required_version = 1.8\nbuilddir = {}\n\n", places.notes().string());
  for (const Stage& stage : stages) {
    // Each stage after the first reads its settings from job.yaml, because the previous output is checked against the same job.
    const std::string job = stage.part == JobPart::sim ? "" : " --job $job/job.yaml";
    // `exec`: the process of the shell becomes the process of the stage, so the stage ends with Ninja. `3>&1`: Ninja takes the
    // end of its pipe for the end of the stage, so the pipe must stay open as long as the stage runs.
    text += fmt::format(
        "rule {0}\n  command = exec {9}\"$$DRESSLIFE_PROGRAMS/{1}\" $job/{2}{3} -o $job/{4} --receipt $job/{5} "
        "{10}--quiet --job-time {6} --job-memory {7}$same 3>&1 > $job/{8} 2>&1\n  description = {0} $job\n\n",
        stage.name, program_name(stage), stage.input, job, stage.output, receipt_file(stage).string(), limits.seconds,
        limits.megabytes, (launcher.empty() ? log_file(stage) : launcher_log(stage)).string(),
        launching(launcher, stage), replaces_files_of_others() ? "--force " : "");
  }
  return text;
}

std::string target_of(const Stage& stage, const std::string& job) { return job + "/" + beside(stage, ".ran").string(); }

/// (job, stage) folders of the other jobs that get the output, one per line.
using SameOutput = std::vector<std::array<std::string, stage_count>>;
SameOutput same_output_of(const Study& study, const std::vector<JobState>& states, const std::vector<Makers>& makers) {
  SameOutput same(states.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t stage = states[k].next; stage < stage_count; ++stage)
      if (makers[k][stage] != k) same[makers[k][stage]][stage] += study.jobs[k].name + '\n';
  return same;
}

/// Returns the build statements of the stages that a job runs itself, each after the stage that makes its input.
std::string chain_of(const Study& study, const StudyPlaces& places, const JobState& state, std::size_t k,
                     const std::vector<Makers>& makers, const SameOutput& same) {
  std::string text;
  const std::string& job = study.jobs[k].name;
  for (std::size_t stage = state.next; stage < stage_count; ++stage) {
    if (makers[k][stage] != k) continue;
    const std::string before =
        stage == state.next ? "" : ' ' + target_of(stages[stage - 1], study.jobs[makers[k][stage - 1]].name);
    text += fmt::format("build {}: {}{}\n  job = {}\n", target_of(stages[stage], job), stages[stage].name, before, job);
    if (same[k][stage].empty()) continue;
    const std::string list = job + '/' + beside(stages[stage], ".same").string();
    write_text_if_changed(places.folder / list, same[k][stage], Sync::never);
    text += fmt::format("  same = {}--same {}\n", "$ ", list);
  }
  return text;
}

/// Returns the first line with an error in a log; empty if no line has one.
std::string error_line(const fs::path& log) {
  std::istringstream lines(read_text(log));
  for (std::string line; std::getline(lines, line);)
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

/// Returns the inputs of a stage that changed after the start of the run: "cell.src was new".
std::string changed_since(const Receipt& receipt, const fs::path& folder, const Digests& before) {
  const auto whole = [](const fs::path& file) { return fs::absolute(file).lexically_normal(); };
  std::map<fs::path, std::string> digests, programs;
  for (const auto& [file, digest] : before.all()) {
    if (file.empty()) continue;  // an entry without a file is a digest of settings
    digests[whole(file)] = digest;
    programs[file.filename()] = digest;
  }
  for (const auto& [what, digest] : receipt.made_with) {
    if (what.starts_with("dresslife-")) {
      if (const auto was = programs.find(what); was != programs.end() && was->second != digest)
        return what + " was replaced by another program";
      continue;
    }
    const fs::path input = seen_file(folder, what);
    const auto was = digests.find(whole(input));
    if (was == digests.end()) return input.string() + " came beside the program";
    if (was->second != digest) return input.string() + " has changed";
  }
  return "job.yaml, or a file that the program reads, has changed or was removed";
}

/// Returns the reason why a job is not done after a run.
std::string reason_of(const JobState& state, const fs::path& folder, const BuildResult& result, const Digests& before) {
  const Stage& stage = stages[state.next];
  bool begun = false;
  for (const fs::path& log : {log_file(stage), launcher_log(stage)}) {
    if (!state_of(folder / log).exists()) continue;
    begun = true;
    const std::string line = error_line(folder / log);
    if (!line.empty())
      return log == log_file(stage) ? line : line + then_run_again;  // a launcher's message contains no advice on jobs
  }
  if (!begun)
    return result.words.empty() ? "it was not reached" : "it was not reached: " + result.words + "; run again";
  // Below this line the stage wrote no error. The receipt may be older than this run.
  if (!result.words.empty()) return fmt::format("{} was broken off: {}; run again", program_name(stage), result.words);
  const std::optional<Receipt> receipt = read_receipt(folder / receipt_file(stage));
  if (receipt && receipt->recipe != state.recipes[state.next])
    return fmt::format("{}: error: {} while the study ran; let nothing change it meanwhile{}", stage.output,
                       changed_since(*receipt, folder, before), then_run_again);
  return fmt::format("{} ended without a message (killed, or out of memory?)", program_name(stage));
}

/// Copies the logs of a stage to the folder of a job that shares its output.
void give_log(const fs::path& from, const fs::path& to, const Stage& stage) {
  for (const fs::path& log : {log_file(stage), launcher_log(stage)}) copy_if_there(from / log, to / log);
}

void join_logs(const fs::path& folder) {
  std::string text;
  for (const Stage& stage : stages) {
    if (state_of(folder / log_file(stage)).exists())
      text += fmt::format("== {}\n{}", program_name(stage), read_text(folder / log_file(stage)));
    if (state_of(folder / launcher_log(stage)).exists()) text += read_text(folder / launcher_log(stage));
  }
  write_text_if_changed(folder / "log", text, Sync::never);
}

/// A Ninja process and its output.
class Ninja {
 public:
  Ninja(const StudyPlaces& places, int parallel) {
    // their digests are computed once here, so that not every stage reads its whole program
    const Programs programs = found_programs(places);
    const std::string digests = note_digests({programs.begin(), programs.end()});
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    const SignalsHeld until_it_is_noted;
    process_ = ::fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process_ == 0) become_ninja(places, parallel, digests, ends[1]);
    ended_at_the_end_.emplace(process_);
    ::close(ends[1]);
    said_ = ::fdopen(ends[0], "r");
  }
  ~Ninja() {
    if (said_) std::fclose(said_);
    if (process_ > 0) {  // this program ends before Ninja has finished
      ::kill(process_, SIGTERM);
      ::waitpid(process_, nullptr, 0);
    }
  }
  Ninja(const Ninja&) = delete;
  Ninja& operator=(const Ninja&) = delete;

  bool next(std::string& line) {
    line.clear();
    for (int c = std::fgetc(said_); c != EOF; c = std::fgetc(said_)) {
      if (c == '\n') return true;
      line += static_cast<char>(c);
    }
    return !line.empty();
  }
  /// Waits for Ninja. Returns its status as from waitpid().
  int finish() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    ended_at_the_end_.reset();
    process_ = -1;
    return status;
  }

 private:
  static constexpr int not_installed = 127;

  [[noreturn]] static void become_ninja(const StudyPlaces& places, int parallel, const std::string& digests, int said) {
    const pid_t runner = ::getppid();
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);      // on SIGTERM Ninja ends its stages and waits for them
    if (::getppid() != runner) ::_exit(1);   // the parent process died before prctl()
    ::setenv("NINJA_STATUS", "@%f/%t ", 1);  // a line "@finished/total description" per stage
    // Environment variables can hold every path; the graph cannot.
    ::setenv("DRESSLIFE_PROGRAMS", fs::absolute(places.programs).c_str(), 1);
    ::setenv("DRESSLIFE_DIGESTS", digests.c_str(), 1);
    ::setenv("DRESSLIFE_PARENT", std::to_string(::getpid()).c_str(), 1);
    ::dup2(said, STDOUT_FILENO);
    ::dup2(said, STDERR_FILENO);
    const std::string jobs = std::to_string(parallel), graph = places.graph().string();
    release_signals();
    if (::chdir(places.folder.c_str()) == 0)
      ::execlp("ninja", "ninja", "-f", graph.c_str(), "-k", "0", "-j", jobs.c_str(), static_cast<char*>(nullptr));
    ::_exit(not_installed);
  }

  pid_t process_ = -1;
  std::optional<EndedAtTheEnd> ended_at_the_end_;
  std::FILE* said_ = nullptr;
};

}  // namespace

std::string StateWords::line() const { return reason.empty() ? state : fmt::format("{:<8} {}", state, reason); }

StateWords JobState::words() const {
  if (done()) return {"done"};
  if (!failure.empty()) return {"failed", failure};
  if (!damaged.empty() && foreign)
    return {"foreign", damaged + " was not written by dresslife; move it away, or run with --force"};
  if (!damaged.empty()) return {"damaged", damaged + " is not what its stage wrote; run makes it again"};
  if (!has_results) return {"to do"};
  return {"stale", changed};
}

StageFiles files_of_stage(std::size_t stage) {
  return {stages[stage].output, receipt_file(stages[stage]), log_file(stages[stage])};
}

bool may_lack(Keep keep, std::size_t stage) {
  switch (keep) {
    case Keep::all:
      return false;
    case Keep::histories:
      return stages[stage].part == JobPart::sim;
    case Keep::lives:
      return true;
  }
  return false;
}

void forget_damaged(const fs::path& folder) {
  for (const Stage& stage : stages) {
    const std::optional<Receipt> receipt = read_receipt(folder / receipt_file(stage));
    const fs::path output = folder / stage.output;
    if (receipt && state_of(output).exists() && checksum_of(output) != receipt->output)
      remove_ours(folder / receipt_file(stage));
  }
}

void look_at(JobState& state, const fs::path& folder) {
  state.damaged.clear();
  state.foreign = false;
  state.compared.clear();
  state.results.clear();
  if (kind_of(folder) == FileKind::absent) {  // quick return for thousands of new jobs
    state.failure.clear();
    state.changed.clear();
    state.has_results = state.has_last = false;
    state.inputs = {"-"};
    state.next = 0;
    return;
  }
  state.failure = noted_failure(state, folder);
  state.has_results = std::ranges::any_of(stages, [&](const Stage& stage) {
    return state_of(folder / stage.output).exists() ||
           (state.keep == Keep::lives && state_of(folder / receipt_file(stage)).exists());
  });
  follow_receipts(state, folder);
  find_last(state, folder);
  // The next stage reads the output of the previous stage, which may have been removed. Then that stage runs again.
  while (!state.done() && state.next > 0 && !state_of(folder / stages[state.next - 1].output).exists()) --state.next;
  // A run replaces no file of the user.
  for (std::size_t k = state.next; k < stage_count && !state.foreign; ++k)
    if (const fs::path output = folder / stages[k].output; kind_of_name(output) != FileKind::absent && !is_ours(output))
      state.damaged = stages[k].output, state.foreign = true;
}

std::vector<Makers> makers_of(const Study& study, const std::vector<JobState>& states) {
  std::vector<Makers> makers(states.size());
  std::unordered_map<std::string, std::size_t> firsts;
  for (std::size_t k = 0; k < states.size(); ++k) {
    makers[k].fill(k);
    if (!study.jobs[k].failure.empty() || states[k].done()) continue;
    std::string key = fmt::format("{} {}", states[k].next, states[k].inputs[states[k].next]);
    for (std::size_t stage = states[k].next; stage + 1 < stage_count; ++stage) {
      if (states[k].foreign && states[k].damaged == stages[stage].output) break;  // the stage fails for this job only
      key += ' ' + states[k].recipes[stage];
      makers[k][stage] = firsts.try_emplace(key, k).first->second;
    }
  }
  return makers;
}

std::uintmax_t remove_unkept(const JobState& state, const fs::path& folder) {
  std::uintmax_t freed = 0;
  for (std::size_t k = 0; state.done() && k < stage_count; ++k) {
    const fs::path output = folder / stages[k].output;
    const FileState file = state_of(output);
    if (!may_lack(state.keep, k) || !file.exists()) continue;
    // A file that other jobs also have a link to does not free space.
    const bool is_last_name = fs::hard_link_count(output) == 1;
    if (remove_ours(output) && is_last_name) freed += static_cast<std::uintmax_t>(file.size);
  }
  return freed;
}

std::vector<JobState> states_of(const Study& study, const StudyPlaces& places) {
  Digests digests;
  return states_of(study, places, digests);
}

std::vector<JobState> states_of(const Study& study, const StudyPlaces& places, Digests& digests) {
  const Programs programs = found_programs(places);
  std::vector<JobState> states(study.jobs.size());
  std::mutex held;
  Sources* const sources = Sources::of_this_thread();
  const std::size_t parts = std::min(thread_count(), states.size());
  in_parallel(parts, [&](std::size_t part) {
    const Sources::Guest guest(sources);
    PieceTexts texts;
    for (std::size_t k = part * states.size() / parts; k < (part + 1) * states.size() / parts; ++k) {
      const fs::path folder = places.job(study.jobs[k].name);
      states[k].keep = study.keep;
      if (!study.jobs[k].failure.empty()) {
        find_last(states[k], folder);
        continue;
      }
      set_recipes(states[k], study.jobs[k], programs, texts, digests, held);
      look_at(states[k], folder);
    }
  });
  return states;
}

void renew_receipts(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states) {
  for (std::size_t k = 0; k < states.size(); ++k)
    for (const std::size_t stage : states[k].compared) {
      const fs::path folder = places.job(study.jobs[k].name);
      renew_receipt(folder / receipt_file(stages[stage]), folder / stages[stage].output);
    }
}

void write_build_graph(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states,
                       const StageLimits& limits, const std::string& launcher) {
  // Check now that the files that are written after the stages can be replaced.
  for (const char* result : {"ranking.csv", "report.html"}) check_replaceable(places.folder / result);
  const fs::path notes = places.folder / places.notes();
  make_notes(places.folder / ".stage");
  fs::create_directories(notes);
  check_notes(places.folder / ".stage");
  check_notes(notes);
  for (const char* memory : {".ninja_log", ".ninja_deps"})  // they record times, which this graph does not use
    remove_ours(notes / memory);
  renew_receipts(study, places, states);
  const std::vector<Makers> makers = makers_of(study, states);
  const SameOutput same = same_output_of(study, states, makers);
  std::vector<std::string> chains(states.size());
  const auto prepare = [&](std::size_t k, PieceTexts& texts) {
    const StudyJob& job = study.jobs[k];
    if (!job.failure.empty()) return;
    const fs::path folder = places.job(job.name);
    const bool is_new = fs::create_directory(folder);
    if (!states[k].done()) make_notes(folder / ".stage");
    write_text_if_changed(folder / "job.yaml", with_mark(texts.stored_job_text(job.job, job.name), Mark::yaml),
                          Sync::never);
    if (states[k].done()) return;
    // Size and times of a damaged file may be those in its receipt. Then its stage would take it for complete.
    if (!states[k].damaged.empty() && !states[k].foreign) forget_damaged(folder);
    if (!is_new) {
      check_notes(folder / ".stage");
      for (const char* result : {"log", "page.html", "preview.html"}) check_replaceable(folder / result);
      for (std::size_t stage = states[k].next; stage < stage_count; ++stage)
        for (const fs::path& log : {log_file(stages[stage]), launcher_log(stages[stage])}) remove_ours(folder / log);
    }
    chains[k] = chain_of(study, places, states[k], k, makers, same);
  };
  const std::size_t parts = std::min(thread_count(), states.size());
  in_parallel(parts, [&](std::size_t part) {
    PieceTexts texts(places.folder);
    for (std::size_t k = part * states.size() / parts; k < (part + 1) * states.size() / parts; ++k) prepare(k, texts);
  });
  std::string graph = rules(places, limits, launcher);
  for (const std::string& chain : chains) graph += chain;
  write_text_if_changed(places.folder / places.graph(), graph);
}

BuildResult run_build_graph(const StudyPlaces& places, int parallel,
                            const std::function<void(const BuildEvent&)>& on_event) {
  BuildResult result;
  Ninja ninja(places, parallel);
  std::string said;
  for (std::string line; ninja.next(line);) {
    BuildEvent event;
    char stage[32] = "", job[512] = "";
    if (std::sscanf(line.c_str(), "@%d/%d %31s %511s", &event.finished, &event.total, stage, job) == 4) {
      event.what = fmt::format("{} {}", stage, job);
      while (event.stage + 1 < stage_count && stages[event.stage].name != std::string_view(stage)) ++event.stage;
      ++result.executed;
      if (on_event) on_event(event);
    } else if (line.starts_with("ninja: ")) {
      said = line;
    }
  }
  const int status = ninja.finish();
  if (WIFSIGNALED(status)) result.words = fmt::format("ninja was ended by signal {}", WTERMSIG(status));
  if (!WIFEXITED(status)) return result;
  constexpr int done = 0, some_failed = 1, not_installed = 127;
  if (WEXITSTATUS(status) == not_installed)
    throw InputError({"ninja"}, "is not installed", "install it: apt-get install ninja-build");
  if (WEXITSTATUS(status) != done && (WEXITSTATUS(status) != some_failed || result.executed == 0))
    result.words = fmt::format("ninja stopped ({})", said.empty() ? "no reason given" : said);
  return result;
}

void close_run(const Study& study, const StudyPlaces& places, const BuildResult& result, std::vector<JobState>& states,
               const Digests& before) {
  const std::vector<Makers> makers = makers_of(study, states);
  std::vector<std::size_t> unfinished;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (study.jobs[k].failure.empty() && !states[k].done()) unfinished.push_back(k);
  for (const std::size_t k : unfinished) {
    const fs::path folder = places.job(study.jobs[k].name);
    for (std::size_t stage = states[k].next; stage < stage_count; ++stage)
      if (makers[k][stage] != k) give_log(places.job(study.jobs[makers[k][stage]].name), folder, stages[stage]);
    remove_ours(folder / failure_file);
    look_at(states[k], folder);
    remove_leftovers(folder);
    join_logs(folder);
  }
  for (
      const std::size_t k :
      // in a second loop, after all states are known, because removing a hard link changes the times of the other links
      unfinished) {
    const fs::path folder = places.job(study.jobs[k].name);
    if (study.removes_unkept) remove_unkept(states[k], folder);
    if (states[k].done()) continue;
    states[k].failure = reason_of(states[k], folder, result, before);
    write_text_if_changed(folder / failure_file, failure_key(states[k]) + "\n" + states[k].failure + "\n", Sync::never);
  }
}

}  // namespace dresslife::pipeline
