// dresslife: runs studies, tells how they stand, reports their results and prints the manual.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <thread>

#include "pipeline/installation.h"
#include "pipeline/program_manual.h"
#include "pipeline/progress.h"
#include "pipeline/report/report.h"
#include "pipeline/stage.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/study.h"

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

namespace {

struct Options {
  std::string study, out = "runs", what;
  std::vector<std::string> sets;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool quiet = false;
};

/// One run at a time in a study's folder; released when the program ends, however it ends.
class Lock {
 public:
  explicit Lock(const fs::path& folder) {
    fs::create_directories(folder);
    const fs::path file = folder / ".lock";
    descriptor_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw InputError({folder.string()}, "is in use by another run, or cannot be written",
                       "wait for it, or choose another folder with -o");
  }
  ~Lock() { ::close(descriptor_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int descriptor_ = -1;
};

/// What a user names: a file, or an entry of the catalogue ("two_robots" of studies).
fs::path named_file(const std::string& name, const char* shelf) {
  std::error_code failure;
  const bool is_name = fs::path(name).parent_path().empty() && fs::path(name).extension() != ".yaml";
  if (!is_name || fs::is_regular_file(name, failure)) return name;
  const fs::path shipped = shipped_catalogue() / shelf / (name + ".yaml");
  if (fs::is_regular_file(shipped, failure)) return fs::proximate(shipped);
  throw InputError({name},
                   fmt::format("is no file, and {} holds no {}.yaml", shipped.parent_path().string(), name),
                   "write the path of a YAML file");
}

StudyPlaces places_of(const Study& study, const Options& options) {
  return {fs::path(options.out) / study.name, program_folder()};
}

std::vector<JobResult> results_of(const Study& study, const StudyPlaces& places,
                                  const std::map<std::string, std::string>& failures) {
  std::vector<JobResult> results;
  for (const StudyJob& job : study.jobs) {
    JobResult result{job.name, places.life(job.name), job.failure};
    if (const auto failed = failures.find(job.name); failed != failures.end())
      result.failure = failed->second;
    results.push_back(std::move(result));
  }
  return results;
}

/// Writes ranking.csv and report.html and prints the table. Returns the number of failed jobs.
int publish(const Study& study, const StudyPlaces& places,
            const std::map<std::string, std::string>& failures) {
  const std::vector<JobResult> results = results_of(study, places, failures);
  const std::vector<RankingRow> rows = read_ranking(results);
  write_text_if_changed(places.folder / "ranking.csv", ranking_csv(rows));
  write_report(places.folder / "report.html", study.name, rows);
  fmt::print("{}", ranking_table(rows));
  fmt::print("\nReport: {}\n", (places.folder / "report.html").string());
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [](const RankingRow& row) { return !row.done(); }));
}

/// A study with fewer jobs than cores lets each stage use several.
void share_cores(int at_a_time, std::size_t jobs) {
  const std::size_t each = static_cast<std::size_t>(at_a_time) / std::max<std::size_t>(jobs, 1);
  constexpr int keep = 0;  // what the user has set
  ::setenv("DRESSLIFE_THREADS", std::to_string(std::max<std::size_t>(each, 1)).c_str(), keep);
}

int run(const Options& options) {
  const Study study = read_study(named_file(options.study, "studies"), options.sets);
  const StudyPlaces places = places_of(study, options);
  const Lock lock(places.folder);
  write_build_graph(study, places);
  Progress progress(study.name, options.quiet);
  share_cores(options.jobs, study.jobs.size());
  const BuildResult built = run_build_graph(places, options.jobs, false, [&](const BuildEvent& event) {
    progress.show(fmt::format("{}/{}  {}", event.finished, event.total, event.what));
  });
  progress.clear();
  join_logs(study, places);
  progress.note(built.executed ? fmt::format("{}: {} stages ran", study.name, built.executed)
                               : fmt::format("{}: nothing to do", study.name));
  const int failed = publish(study, places, built.failures);
  if (failed == 0) return 0;
  fmt::print(
      stderr,
      "{}: error: {} of {} jobs failed (their reasons are in the table); see the log in each job's folder\n",
      options.study, failed, study.jobs.size());
  return 1;
}

/// Jobs whose results are not those of the study as it is now written, each with the reason.
std::map<std::string, std::string> unfinished_jobs(const Study& study, const StudyPlaces& places) {
  std::map<std::string, std::string> reasons;
  const Lock lock(places.folder);
  write_build_graph(study, places);
  const std::vector<std::string> pending = run_build_graph(places, 1, true, {}).pending;
  for (const StudyJob& job : study.jobs)
    if (std::find(pending.begin(), pending.end(), job.name) != pending.end())
      reasons[job.name] = pending_state(job, places);
  return reasons;
}

int status(const Options& options) {
  const Study study = read_study(named_file(options.study, "studies"), options.sets);
  const StudyPlaces places = places_of(study, options);
  const bool begun = fs::is_directory(places.folder);
  const auto unfinished = begun ? unfinished_jobs(study, places) : std::map<std::string, std::string>{};
  std::size_t done = 0;
  for (const StudyJob& job : study.jobs) {
    std::string word = begun ? "done" : "to do";
    if (!job.failure.empty())
      word = "failed   " + job.failure;
    else if (const auto reason = unfinished.find(job.name); reason != unfinished.end())
      word = reason->second;
    done += word == "done";
    fmt::print("{:<40} {}\n", job.name, word);
  }
  fmt::print("{} of {} jobs done\n", done, study.jobs.size());
  return 0;
}

int report(const Options& options) {
  const Study study = read_study(named_file(options.study, "studies"), options.sets);
  const StudyPlaces places = places_of(study, options);
  if (!fs::is_directory(places.folder))
    throw InputError({places.folder.string()}, "is not there (the study has not run)",
                     "run it: dresslife run " + options.study);
  return publish(study, places, unfinished_jobs(study, places)) ? 1 : 0;
}

int manual(const CLI::App& app, const Options& options) {
  if (options.what == "keys")
    fmt::print("{}\n{}", study_manual(), job_manual());
  else
    fmt::print("{}", options.what == "files" ? file_manual() : program_manual(app, options.what));
  return 0;
}

int show(const Options& options) {
  fmt::print("{}", job_text(read_job(named_file(options.study, "jobs"), options.sets)));
  return 0;
}

/// Becomes dresslife-import, which lies beside this program and takes the rest of the command line.
int import_program(char** arguments) {
  const std::string program = (program_folder() / "dresslife-import").string();
  ::execv(program.c_str(), arguments);
  throw InputError({program}, "cannot be started", "install dresslife's programs into one folder");
}

void add_common(CLI::App* command, Options& options) {
  command->add_option("-o,--output", options.out, "folder of the results")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--set", options.sets, "override a key in every job; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      std::string("How long does a robot's dresspack live under its programs, which wire breaks, where, and "
                  "which motion does it?") +
          example_mark + "dresslife run two_robots",
      "dresslife");
  app.set_version_flag("--version", [] { return version_text("dresslife"); });
  app.require_subcommand(1);

  CLI::App* run_command =
      app.add_subcommand("run", "run what is not up to date in a study, then rank and report");
  run_command->add_option("study", options.study, "STUDY.yaml")->required()->type_name("");
  run_command->add_option("-j,--jobs", options.jobs, "stages at a time")
      ->check(CLI::Range(1, 1024))
      ->default_str("one per core");
  run_command->add_flag("--quiet", options.quiet, "no progress, no notes");
  add_common(run_command, options);
  CLI::App* status_command =
      app.add_subcommand("status", "tell which jobs of a study are done, stale, failed or to do");
  status_command->add_option("study", options.study, "STUDY.yaml")->required()->type_name("");
  add_common(status_command, options);
  CLI::App* report_command =
      app.add_subcommand("report", "rank and report what has been computed, without running anything");
  report_command->add_option("study", options.study, "STUDY.yaml")->required()->type_name("");
  add_common(report_command, options);
  CLI::App* show_command =
      app.add_subcommand("show", "print a job with its catalogue entries and defaults written out");
  show_command->add_option("job", options.study, "JOB.yaml")->required()->type_name("");
  show_command->add_option("--set", options.sets, "override a key; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
  app.add_subcommand(
      "import",
      "write a robot program (RAPID, KRL, Fanuc, columns, ROS) as a motion; see dresslife import --help");
  CLI::App* manual_command = app.add_subcommand(
      "manual", "print a reference: of all keys or all files (Markdown), the man page, a shell's completion");
  std::vector<std::string> references{"keys", "files"};
  references.insert(references.end(), manual_kinds().begin(), manual_kinds().end());
  manual_command->add_option("what", options.what, "which one")
      ->required()
      ->check(CLI::IsMember(references))
      ->type_name("");

  if (argc > 1 && std::string_view(argv[1]) == "import")
    return guarded("dresslife", [&] { return import_program(argv + 1); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  return guarded("dresslife", [&] {
    if (run_command->parsed()) return run(options);
    if (status_command->parsed()) return status(options);
    if (report_command->parsed()) return report(options);
    if (show_command->parsed()) return show(options);
    return manual(app, options);
  });
}
