// dresslife: runs studies, tells how they stand, reports their results and prints the manual.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "pipeline/installation.h"
#include "pipeline/job/job_text.h"
#include "pipeline/limits.h"
#include "pipeline/program_manual.h"
#include "pipeline/progress.h"
#include "pipeline/report/report.h"
#include "pipeline/stage.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/folder_lock.h"
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
  StageLimits limits{24 * 3600, installed_memory_mb()};  // a day, and what the machine has
};

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

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

/// Only what is done is read; of the others the ranking says how they stand.
std::vector<RankingRow> ranking_of(const Study& study, const StudyPlaces& places,
                                   const std::vector<JobState>& states) {
  std::vector<JobResult> results;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    JobResult result{job.name, places.life(job.name), job.failure, states[k].settings};
    if (job.failure.empty() && !states[k].done())
      result.failure = states[k].failure.empty() ? states[k].words() : states[k].failure;
    results.push_back(std::move(result));
  }
  return read_ranking(results);
}

int count_failed(const std::vector<RankingRow>& rows) {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [](const RankingRow& row) { return !row.done(); }));
}

void write_results(const Study& study, const StudyPlaces& places, const std::vector<RankingRow>& rows) {
  write_text_if_changed(places.folder / "ranking.csv", ranking_csv(rows));
  write_report(places.folder / "report.html", study.name, rows);
}

/// A study with fewer jobs than cores lets each stage use several.
void share_cores(int at_a_time, std::size_t jobs) {
  const std::size_t each = static_cast<std::size_t>(at_a_time) / std::max<std::size_t>(jobs, 1);
  constexpr int keep = 0;  // what the user has set
  ::setenv("DRESSLIFE_THREADS", std::to_string(std::max<std::size_t>(each, 1)).c_str(), keep);
}

/// Makes what is not up to date and brings `states` up to date. Returns how many stages were started.
int make_rest(const Study& study, const StudyPlaces& places, const Options& options,
              std::vector<JobState>& states) {
  Progress progress(study.name, options.quiet);
  std::size_t left = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty()) continue;
    left += !states[k].done();
    if (!states[k].damaged.empty())
      progress.note(fmt::format("{}: {}", places.job(study.jobs[k].name).string(), states[k].words()));
  }
  write_build_graph(study, places, states, options.limits);
  if (left == 0) return 0;
  share_cores(options.jobs, left);
  const BuildResult built = run_build_graph(places, options.jobs, [&](const BuildEvent& event) {
    progress.show(fmt::format("{}/{}  {}", event.finished, event.total, event.what));
  });
  progress.clear();
  if (!built.words.empty())
    tell(fmt::format("{}: error: {}; run again\n", places.folder.string(), built.words));
  close_run(study, places, built, states);
  return built.executed;
}

int run(const Options& options) {
  const Study study = read_study(named_file(options.study, "studies"), options.sets);
  const StudyPlaces places = places_of(study, options);
  const FolderLock lock(places.folder);
  std::vector<JobState> states = states_of(study, places);
  const int executed = make_rest(study, places, options, states);
  if (!options.quiet)
    tell(executed ? fmt::format("{}: {} stages ran\n", study.name, executed)
                  : fmt::format("{}: nothing to do\n", study.name));
  const std::vector<RankingRow> rows = ranking_of(study, places, states);
  write_results(study, places, rows);
  print(
      shown(fmt::format("{}\nReport: {}\n", ranking_table(rows), (places.folder / "report.html").string())));
  const int failed = count_failed(rows);
  if (failed == 0) return 0;
  tell(fmt::format(
      "{}: error: {} of {} jobs failed (their reasons are in the table); see the log in each job's folder\n",
      options.study, failed, study.jobs.size()));
  return 1;
}

int status(const Options& options) {
  const Study study = read_study(named_file(options.study, "studies"), options.sets);
  const std::vector<JobState> states = states_of(study, places_of(study, options));
  std::size_t done = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    const std::string word = job.failure.empty() ? states[k].words() : "failed   " + job.failure;
    done += word == "done";
    print(shown(fmt::format("{:<40} {}\n", job.name, word)));
  }
  print(fmt::format("{} of {} jobs done\n", done, study.jobs.size()));
  return 0;
}

/// Prints the ranking of what is done. The files of the study's folder are brought up to date where they
/// would hold what a run would write; with results of other settings among the jobs they stay those of the
/// last run.
int report(const Options& options) {
  const Study study = read_study(named_file(options.study, "studies"), options.sets);
  const StudyPlaces places = places_of(study, options);
  if (!fs::is_directory(places.folder))
    throw InputError({places.folder.string()}, "is not there (the study has not run)",
                     "run it: dresslife run " + options.study);
  const std::vector<JobState> states = states_of(study, places);
  const std::vector<RankingRow> rows = ranking_of(study, places, states);
  print(shown(ranking_table(rows)));
  const auto open = std::count_if(states.begin(), states.end(), [](const JobState& state) {
    return !state.done() && state.failure.empty() && !state.recipes[0].empty();
  });
  std::string kept;
  if (open > 0)
    kept = fmt::format("{} jobs are not done with these settings", open);
  else if (::access(places.folder.c_str(), W_OK) != 0)
    kept = "the folder cannot be written";
  if (kept.empty()) {
    write_results(study, places, rows);
    print(shown(fmt::format("\nReport: {}\n", (places.folder / "report.html").string())));
  } else {
    tell(fmt::format("{}: note: ranking.csv and report.html stay as the last run left them ({})\n",
                     places.folder.string(), kept));
  }
  return count_failed(rows) ? 1 : 0;
}

int manual(const CLI::App& app, const Options& options) {
  if (options.what == "keys")
    print(study_manual() + "\n" + job_manual());
  else
    print(options.what == "files" ? file_manual() : program_manual(app, options.what));
  return 0;
}

int show(const Options& options) {
  print(job_text(named_file(options.study, "jobs"), options.sets));
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
  settle_streams();
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
  run_command
      ->add_option("--job-time", options.limits.seconds, "let no stage of a job take longer; 0: no limit")
      ->type_name("SECONDS")
      ->capture_default_str();
  run_command
      ->add_option("--job-memory", options.limits.megabytes,
                   "let no stage of a job take more memory; 0: no limit")
      ->type_name("MB")
      ->default_str("all of the machine's");
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
    return finish_output(app.exit(problem) == 0 ? 0 : 2);
  }
  return finish_output(guarded("dresslife", [&] {
    if (run_command->parsed()) return run(options);
    if (status_command->parsed()) return status(options);
    if (report_command->parsed()) return report(options);
    if (show_command->parsed()) return show(options);
    return manual(app, options);
  }));
}
