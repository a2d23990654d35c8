#include "pipeline/study/build_graph.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

#include "pipeline/files/receipt.h"
#include "pipeline/job/job_text.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct Stage {
  const char* name;
  Part part;
  const char* input;  ///< in the job's folder
  const char* output;
};
constexpr std::array<Stage, stage_count> stages{Stage{"sim", Part::sim, "job.yaml", "motion.h5"},
                                                Stage{"strain", Part::strain, "motion.h5", "strain.h5"},
                                                Stage{"fatigue", Part::fatigue, "strain.h5", "life.h5"}};

/// In the job's folder: what is not for people.
fs::path beside(const Stage& stage, const char* ending) {
  return fs::path(".stage") / (std::string(stage.name) + ending);
}
fs::path receipt_file(const Stage& stage) { return beside(stage, ".receipt"); }
fs::path log_file(const Stage& stage) { return beside(stage, ".log"); }
constexpr const char* failure_file = ".stage/failure";
constexpr const char* memory_file = ".stage/memory";  // of the study: who may take how much (pipeline/memory.h)
std::string program_name(const Stage& stage) { return std::string("dresslife-") + stage.name; }

void check_programs(const StudyPlaces& places) {
  for (const Stage& stage : stages) {
    const fs::path program = places.programs / program_name(stage);
    if (::access(program.c_str(), X_OK) != 0)
      throw InputError({program.string()}, "is not there (the stages stand beside dresslife)",
                       "build it: scripts/build");
  }
}

/// What a job's stages are to be made from.
void set_recipes(JobState& state, const Job& job, const StudyPlaces& places, Digests& digests) {
  const std::vector<fs::path> files = files_beside(job);
  std::string all;
  for (std::size_t k = 0; k < stage_count; ++k) {
    const std::string text = part_text(job, stages[k].part);
    state.recipes[k] = recipe_of(text, stages[k].part == Part::sim ? files : std::vector<fs::path>{},
                                 fs::canonical(places.programs / program_name(stages[k])), digests);
    all += text;
  }
  constexpr std::size_t digits = 12;
  state.settings = recipe_of(all, files, {}, digests).substr(0, digits);
}

/// Whether an output may be absent of a job that is done.
bool may_lack(Keep keep, std::size_t stage) {
  switch (keep) {
    case Keep::all:
      return false;
    case Keep::histories:
      return stages[stage].part == Part::sim;
    case Keep::lives:
      return true;
  }
  return false;
}

/// Receipts tell that all stages have made their outputs, one from the other, as far as these are there.
void follow_receipts(JobState& state, const fs::path& folder) {
  std::string made_before = "-";
  for (state.next = 0; state.next < stage_count; ++state.next) {
    const Stage& stage = stages[state.next];
    std::optional<Receipt> receipt = read_receipt(folder / receipt_file(stage));
    if (!receipt || receipt->recipe != state.recipes[state.next] || receipt->input != made_before) return;
    // After a failure no state spares the look at the bytes: a stage may have found what no time shows.
    if (!state.failure.empty()) receipt->state = {};
    const FileState now = state_of(folder / stage.output);
    const bool removed = !now.exists() && may_lack(state.keep, state.next);
    if (!removed && !is_as_noted(*receipt, folder / stage.output)) {
      if (now.exists()) state.damaged = stage.output;
      return;
    }
    if (!removed && (now != receipt->state || !receipt->state_suffices())) state.compared.push_back(state.next);
    made_before = receipt->output;
    state.told = std::move(receipt->told);
  }
}

std::string failure_key(const JobState& state) { return fmt::format("{}", fmt::join(state.recipes, " ")); }

/// The reason of the last attempt, if it was one with these recipes.
std::string noted_failure(const JobState& state, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / failure_file, ignored)) return "";
  std::istringstream lines(read_text(folder / failure_file));
  std::string key, reason;
  std::getline(lines, key);
  std::getline(lines, reason);
  return key == failure_key(state) ? reason : "";
}

/// The words before a stage's program: as Ninja reads them.
std::string launching(const std::string& launcher) {
  if (launcher.empty()) return "";
  std::string words = "env -u DRESSLIFE_PARENT -u DRESSLIFE_MEMORY ";
  for (const char letter : launcher) words += letter == '$' ? "$$" : std::string(1, letter);
  return words + ' ';
}

std::string rules(const StageLimits& limits, const std::string& launcher) {
  std::string text = "ninja_required_version = 1.8\nbuilddir = .stage\n\n";
  for (const Stage& stage : stages) {
    // The stage before is checked against the same job, so the settings come from job.yaml at every stage.
    const std::string job = stage.part == Part::sim ? "" : " --job $job/job.yaml";
    // `exec`: the shell's process becomes the stage's, which then ends with Ninja. `3>&1`: Ninja takes the end of
    // its pipe for the end of the stage and waits for that stage alone, so the pipe must live as long as the stage.
    text += fmt::format(
        "rule {0}\n  command = exec {9}\"$$DRESSLIFE_PROGRAMS/{1}\" $job/{2}{3} -o $job/{4} --receipt $job/{5} "
        "--force "
        "--quiet --job-time {6} --job-memory {7} 3>&1 > $job/{8} 2>&1\n  description = {0} $job\n\n",
        stage.name, program_name(stage), stage.input, job, stage.output, receipt_file(stage).string(),
        limits.seconds, limits.megabytes, log_file(stage).string(), launching(launcher));
  }
  return text;
}

/// The chain of a job from the first stage that is to run.
std::string chain_of(const std::string& job, std::size_t first) {
  std::string text, before;
  for (std::size_t k = first; k < stage_count; ++k) {
    const std::string target = job + "/" + beside(stages[k], ".ran").string();
    text += fmt::format("build {}: {}{}\n  job = {}\n", target, stages[k].name, before, job);
    before = " " + target;
  }
  return text;
}

/// The first line of a log that tells an error, else nothing.
std::string error_line(const fs::path& log) {
  std::istringstream lines(read_text(log));
  for (std::string line; std::getline(lines, line);)
    if (line.find(": error: ") != std::string::npos) return line;
  return "";
}

/// Why a job is not done after a run.
std::string reason_of(const JobState& state, const fs::path& folder, const BuildResult& result) {
  const Stage& stage = stages[state.next];
  std::error_code ignored;
  if (!fs::is_regular_file(folder / log_file(stage), ignored))
    return result.words.empty() ? "it was not reached"
                                : "it was not reached: " + result.words + "; run again";
  if (const std::string line = error_line(folder / log_file(stage)); !line.empty()) return line;
  // From here on the stage said nothing; a receipt may be older than this run.
  if (!result.words.empty())
    return fmt::format("{} was broken off: {}; run again", program_name(stage), result.words);
  const std::optional<Receipt> receipt = read_receipt(folder / receipt_file(stage));
  if (receipt && receipt->recipe != state.recipes[state.next])
    return fmt::format("{}: error: its files or programs changed while the study ran; run again",
                       stage.output);
  return fmt::format("{} ended without a word (killed, or out of memory?)", program_name(stage));
}

void join_logs(const fs::path& folder) {
  std::string text;
  for (const Stage& stage : stages) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / log_file(stage), ignored))
      text += fmt::format("== {}\n{}", program_name(stage), read_text(folder / log_file(stage)));
  }
  write_text_if_changed(folder / "log", text, Sync::never);
}

/// A Ninja process and what it says.
class Ninja {
 public:
  Ninja(const StudyPlaces& places, int parallel) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    process_ = ::fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process_ == 0) become_ninja(places, parallel, ends[1]);
    ::close(ends[1]);
    said_ = ::fdopen(ends[0], "r");
  }
  ~Ninja() {
    if (said_) std::fclose(said_);
    if (process_ > 0) {  // this program gives up before Ninja is through
      ::kill(process_, SIGKILL);
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
  /// The status of waitpid().
  int finish() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

 private:
  static constexpr int not_installed = 127;

  [[noreturn]] static void become_ninja(const StudyPlaces& places, int parallel, int said) {
    const pid_t runner = ::getppid();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != runner) ::_exit(1);   // it died before that was said
    ::setenv("NINJA_STATUS", "@%f/%t ", 1);  // a line "@finished/total description" per stage
    // Through the environment goes whatever a folder may be named.
    ::setenv("DRESSLIFE_PROGRAMS", fs::absolute(places.programs).c_str(), 1);
    ::setenv("DRESSLIFE_MEMORY", (fs::absolute(places.folder) / memory_file).c_str(), 1);
    ::setenv("DRESSLIFE_PARENT", std::to_string(::getpid()).c_str(), 1);
    ::dup2(said, STDOUT_FILENO);
    ::dup2(said, STDERR_FILENO);
    const std::string jobs = std::to_string(parallel);
    if (::chdir(places.folder.c_str()) == 0)
      ::execlp("ninja", "ninja", "-k", "0", "-j", jobs.c_str(), static_cast<char*>(nullptr));
    ::_exit(not_installed);
  }

  pid_t process_ = -1;
  std::FILE* said_ = nullptr;
};

}  // namespace

std::string JobState::words() const {
  if (done()) return "done";
  if (!failure.empty()) return "failed   " + failure;
  if (!damaged.empty())
    return fmt::format("damaged  {} is not what its stage wrote; run makes it anew", damaged);
  return has_results ? "stale" : "to do";
}

StageFiles files_of_stage(std::size_t stage) { return {stages[stage].output, receipt_file(stages[stage])}; }

void look_at(JobState& state, const fs::path& folder) {
  state.damaged.clear();
  state.compared.clear();
  state.told.clear();
  state.failure = noted_failure(state, folder);
  state.has_results = std::any_of(stages.begin(), stages.end(), [&](const Stage& stage) {
    return state_of(folder / stage.output).exists() ||
           (state.keep == Keep::lives && state_of(folder / receipt_file(stage)).exists());
  });
  follow_receipts(state, folder);
  // What is to run reads the output before it, which may have been removed.
  while (!state.done() && state.next > 0 && !state_of(folder / stages[state.next - 1].output).exists()) --state.next;
}

std::uintmax_t remove_unkept(const JobState& state, const fs::path& folder) {
  std::uintmax_t freed = 0;
  for (std::size_t k = 0; state.done() && k < stage_count; ++k) {
    const fs::path output = folder / stages[k].output;
    std::error_code ignored;
    if (!may_lack(state.keep, k) || !fs::is_regular_file(fs::symlink_status(output, ignored))) continue;
    const std::uintmax_t size = fs::file_size(output, ignored);
    if (fs::remove(output, ignored)) freed += size;
  }
  return freed;
}

std::vector<JobState> states_of(const Study& study, const StudyPlaces& places) {
  Digests digests;
  return states_of(study, places, digests);
}

std::vector<JobState> states_of(const Study& study, const StudyPlaces& places, Digests& digests) {
  check_programs(places);
  std::vector<JobState> states(study.jobs.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    if (!job.failure.empty()) continue;
    set_recipes(states[k], *job.job, places, digests);
    states[k].keep = study.keep;
    look_at(states[k], places.job(job.name));
  }
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
  fs::create_directories(places.folder / ".stage");
  for (const char* memory : {".ninja_log", ".ninja_deps"})  // of times, which decide nothing here
    fs::remove_all(places.folder / ".stage" / memory);
  fs::remove_all(places.folder / memory_file);  // of stages that have ended
  renew_receipts(study, places, states);
  std::string graph = rules(limits, launcher);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    if (!job.failure.empty()) continue;
    const fs::path folder = places.job(job.name);
    fs::create_directories(folder / ".stage");
    write_text_if_changed(folder / "job.yaml", job_text(*job.job), Sync::never);
    if (states[k].done()) continue;
    for (std::size_t stage = states[k].next; stage < stage_count; ++stage)
      fs::remove(folder / log_file(stages[stage]));
    graph += chain_of(job.name, states[k].next);
  }
  write_text_if_changed(places.folder / "build.ninja", graph);
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
    result.words = fmt::format("ninja stopped ({})", said.empty() ? "no reason told" : said);
  return result;
}

void close_run(const Study& study, const StudyPlaces& places, const BuildResult& result,
               std::vector<JobState>& states) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty() || states[k].done()) continue;
    const fs::path folder = places.job(study.jobs[k].name);
    fs::remove(folder / failure_file);
    look_at(states[k], folder);
    remove_unkept(states[k], folder);
    for (const Stage& stage : stages) remove_leftovers(folder / stage.output);
    join_logs(folder);
    if (states[k].done()) continue;
    states[k].failure = reason_of(states[k], folder, result);
    write_text_if_changed(folder / failure_file, failure_key(states[k]) + "\n" + states[k].failure + "\n",
                          Sync::never);
  }
}

}  // namespace dresslife::pipeline
