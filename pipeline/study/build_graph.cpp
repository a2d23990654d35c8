#include "pipeline/study/build_graph.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <sstream>

#include "pipeline/files/digest.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct StageEdge {
  const char* stage;
  Part part;
  const char* input;  ///< in the job's folder
  const char* output;
};
constexpr std::array edges{StageEdge{"sim", Part::sim, "job.yaml", "motion.h5"},
                           StageEdge{"strain", Part::strain, "motion.h5", "strain.h5"},
                           StageEdge{"fatigue", Part::fatigue, "strain.h5", "life.h5"}};

fs::path settings_file(const StageEdge& edge) {
  return fs::path(".stage") / (std::string(edge.stage) + ".yaml");
}
fs::path log_file(const StageEdge& edge) { return fs::path(".stage") / (std::string(edge.stage) + ".log"); }
std::string program_name(const StageEdge& edge) { return std::string("dresslife-") + edge.stage; }
fs::path fingerprint(const StageEdge& edge) { return fs::path(".programs") / program_name(edge); }

/// As a word of a Ninja path list.
std::string ninja_word(const fs::path& path) {
  std::string escaped;
  for (char c : path.string()) {
    if (c == '$' || c == ' ' || c == ':') escaped += '$';
    escaped += c;
  }
  return escaped;
}

/// As one word for the shell.
std::string shell_word(const fs::path& path) {
  std::string quoted = "'";
  for (char c : path.string()) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// As part of a Ninja variable.
std::string ninja_text(const std::string& text) {
  std::string escaped;
  for (char c : text) escaped += c == '$' ? std::string("$$") : std::string(1, c);
  return escaped;
}

std::string rules(const StudyPlaces& places) {
  std::string text = "ninja_required_version = 1.8\nbuilddir = .stage\n\n";
  for (const StageEdge& edge : edges) {
    // The stage before is checked against the same job, so the settings come from job.yaml at every stage.
    const std::string job = edge.part == Part::sim ? "" : " --job $job/job.yaml";
    text += fmt::format(
        "rule {}\n  command = {} $job/{}{} -o $out --quiet > $job/{} 2>&1\n  description = {} $job\n  restat "
        "= 1\n\n",
        edge.stage, ninja_text(shell_word(places.programs / program_name(edge))), edge.input, job,
        log_file(edge).string(), edge.stage);
  }
  return text;
}

std::string job_edges(const StudyJob& job) {
  std::string text;
  for (const StageEdge& edge : edges) {
    const fs::path folder = job.name;
    std::string inputs = ninja_word(folder / settings_file(edge)) + " " + ninja_word(fingerprint(edge));
    if (edge.part == Part::sim)
      for (const fs::path& beside : files_beside(job.job)) inputs += " " + ninja_word(beside);
    else
      inputs = ninja_word(folder / edge.input) + " " + inputs;
    text += fmt::format("build {}: {} {}\n  job = {}\n", ninja_word(folder / edge.output), edge.stage, inputs,
                        job.name);
  }
  return text + "\n";
}

void write_job(const StudyJob& job, const StudyPlaces& places) {
  const fs::path folder = places.job(job.name);
  fs::create_directories(folder / ".stage");
  write_text_if_changed(folder / "job.yaml", job_text(job.job), Sync::never);
  for (const StageEdge& edge : edges) {
    std::string settings = part_text(job.job, edge.part);
    if (edge.part == Part::sim)  // a file that came or went in a program's folder is a change, too
      for (const fs::path& beside : files_beside(job.job)) settings += "# " + beside.string() + "\n";
    write_text_if_changed(folder / settings_file(edge), settings, Sync::never);
  }
}

/// First line of a stage's log that tells an error, else its last line.
std::string failure_line(const fs::path& log) {
  std::error_code ignored;
  if (!fs::is_regular_file(log, ignored)) return "it left no log";
  std::istringstream lines(read_text(log));
  std::string last = "it ended without a word (killed?)";
  for (std::string line; std::getline(lines, line);) {
    if (line.find(": error: ") != std::string::npos) return line;
    if (!line.empty()) last = line;
  }
  // The shell's word for a stage that was ended from outside.
  return last == "Killed" ? "it was killed (out of memory?)" : last;
}

/// The failed stage's word on a job, from Ninja's "FAILED: easy/motion.h5".
void note_failure(const std::string& output, const StudyPlaces& places, BuildResult& result) {
  const fs::path path(output);
  for (const StageEdge& edge : edges)
    if (path.filename() == edge.output)
      result.failures[path.parent_path().string()] =
          failure_line(places.folder / path.parent_path() / log_file(edge));
}

class LineReader {
 public:
  explicit LineReader(const std::string& command) : pipe_(::popen(command.c_str(), "r")) {
    if (!pipe_) throw std::runtime_error("cannot start a shell");
  }
  ~LineReader() {
    if (pipe_) ::pclose(pipe_);
  }
  bool next(std::string& line) {
    line.clear();
    for (int c = std::fgetc(pipe_); c != EOF; c = std::fgetc(pipe_)) {
      if (c == '\n') return true;
      line += static_cast<char>(c);
    }
    return !line.empty();
  }
  int finish() {
    const int status = ::pclose(pipe_);
    pipe_ = nullptr;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

 private:
  std::FILE* pipe_;
};

}  // namespace

void write_build_graph(const Study& study, const StudyPlaces& places) {
  fs::create_directories(places.folder / ".stage");
  for (const StageEdge& edge : edges) {
    const fs::path program = places.programs / program_name(edge);
    if (::access(program.c_str(), X_OK) != 0)
      throw InputError({program.string()}, "is not there (the stages stand beside dresslife)",
                       "build it: scripts/build");
    write_text_if_changed(places.folder / fingerprint(edge), sha256_of_file(program) + "\n");
  }
  std::string graph = rules(places);
  for (const StudyJob& job : study.jobs) {
    if (!job.failure.empty()) continue;
    write_job(job, places);
    graph += job_edges(job);
  }
  write_text_if_changed(places.folder / "build.ninja", graph);
}

BuildResult run_build_graph(const StudyPlaces& places, int parallel, bool dry,
                            const std::function<void(const BuildEvent&)>& on_event) {
  // A line "@finished/total description" per edge, whatever the terminal.
  const std::string command = fmt::format("NINJA_STATUS='@%f/%t ' ninja -C {} -k 0 -j {}{} 2>&1",
                                          shell_word(places.folder), parallel, dry ? " -n" : "");
  BuildResult result;
  LineReader ninja(command);
  std::string said;
  for (std::string line; ninja.next(line);) {
    BuildEvent event;
    char stage[32] = "", job[512] = "";
    if (std::sscanf(line.c_str(), "@%d/%d %31s %511s", &event.finished, &event.total, stage, job) == 4) {
      event.what = fmt::format("{} {}", stage, job);
      ++result.executed;
      if (result.pending.empty() || result.pending.back() != job) result.pending.emplace_back(job);
      if (on_event) on_event(event);
    } else if (line.starts_with("FAILED: ")) {
      note_failure(line.substr(8, line.find_last_not_of(' ') - 7), places, result);
    } else if (line.find("error") != std::string::npos || line.find("not found") != std::string::npos) {
      said = line;
    }
  }
  const int status = ninja.finish();
  if (status == 127)
    throw InputError({"ninja"}, "is not installed", "install it: apt-get install ninja-build");
  if (status != 0 && result.failures.empty())
    throw InputError({(places.folder / "build.ninja").string()},
                     fmt::format("ninja stopped ({})", said.empty() ? "no reason told" : said), "run again");
  return result;
}

std::string pending_state(const StudyJob& job, const StudyPlaces& places) {
  const fs::path folder = places.job(job.name);
  std::error_code ignored;
  for (const StageEdge& edge : edges) {
    const fs::path log = folder / log_file(edge), settings = folder / settings_file(edge);
    if (!fs::is_regular_file(log, ignored) ||
        fs::last_write_time(log, ignored) < fs::last_write_time(settings, ignored))
      continue;
    const std::string line = failure_line(log);
    if (line.find(": error: ") != std::string::npos) return "failed   " + line;
  }
  for (const StageEdge& edge : edges)
    if (fs::is_regular_file(folder / edge.output, ignored)) return "stale";
  return "to do";
}

void join_logs(const Study& study, const StudyPlaces& places) {
  for (const StudyJob& job : study.jobs) {
    if (!job.failure.empty()) continue;
    std::string text;
    for (const StageEdge& edge : edges) {
      const fs::path log = places.job(job.name) / log_file(edge);
      std::error_code ignored;
      if (fs::is_regular_file(log, ignored))
        text += fmt::format("== {}\n{}", program_name(edge), read_text(log));
    }
    write_text_if_changed(places.job(job.name) / "log", text, Sync::never);
  }
}

}  // namespace dresslife::pipeline
