// dresslife: runs studies, tells how they stand, reports their results and prints the manual.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include "pipeline/files/digest.h"
#include "pipeline/files/files.h"
#include "pipeline/installation.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/job/job_text.h"
#include "pipeline/job/overlap.h"
#include "pipeline/limits.h"
#include "pipeline/program_manual.h"
#include "pipeline/progress.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/report/figures.h"
#include "pipeline/report/file_summary.h"
#include "pipeline/report/job_page.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/paraview.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/report/report.h"
#include "pipeline/report/validation_picture.h"
#include "pipeline/stage.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/known_study.h"
#include "pipeline/study/observations.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/rate.h"
#include "pipeline/study/relative_life.h"
#include "pipeline/study/stage_program.h"
#include "pipeline/study/study.h"
#include "pipeline/whole_file.h"

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

namespace {

struct Options {
  std::string study, out = "runs", what, picture;
  std::optional<double> time;
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

StudyRequest request_of(const Options& options) {
  return {named_file(options.study, "studies"), options.sets, options.out, program_folder()};
}

int count_failed(const std::vector<RankingRow>& rows) {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [](const RankingRow& row) { return !row.done(); }));
}

/// A file that lives as long as this.
class PassingFile {
 public:
  explicit PassingFile(const std::string& name)
      : file_(fs::temp_directory_path() / fmt::format("dresslife-{}-{}", ::getpid(), name)) {}
  ~PassingFile() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  const fs::path& path() const { return file_; }

 private:
  fs::path file_;
};

/// Lets dresslife-sim tell what stands where. Returns its exit status.
int tell_preview(const fs::path& job, const std::vector<std::string>& sets, const StageLimits& limits, const fs::path& told) {
  std::vector<std::string> arguments{job.string(), "--preview", "-o", told.string(), "--quiet", "--job-time",
                                     std::to_string(limits.seconds), "--job-memory", std::to_string(limits.megabytes)};
  for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
  return run_stage_program("dresslife-sim", arguments);
}

/// Whether there is a page of what the simulation refuses in this job; made when it or the page's parts have changed.
bool refresh_preview(const fs::path& job, const fs::path& page, const JobState& state, const std::string& name) {
  constexpr StageLimits limits{20, 4000};  // a preview takes one second and little memory
  const std::string made_from = xxh3(shell_digest() + state.recipes[0] + state.failure + name);
  if (made_from_of(page) == made_from) return true;
  const bool on_its_way = state.failure.find("is drawn taut") != std::string::npos;
  const PassingFile told("preview.h5");
  if (tell_preview(job, {}, limits, told.path()) != 0) return false;
  if (!on_its_way && refusal_of(told.path()).empty()) return false;
  write_text_if_changed(page, preview_page(told.path(), name, made_from, state.failure), Sync::never);
  return true;
}

/// Pages of jobs that the simulation refuses, beside their logs; of the first few, as a study that varies a routing may
/// have thousands. Returns them.
std::vector<fs::path> refresh_previews(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states) {
  constexpr std::size_t most = 10;  // half a second each
  std::vector<fs::path> pages;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    const fs::path page = places.job(job.name) / "preview.html";
    bool shows = false;
    if (pages.size() < most && job.failure.empty() && states[k].next == 0 && !states[k].failure.empty()) {
      try {
        shows = refresh_preview(places.job(job.name) / "job.yaml", page, states[k], job.name);
      } catch (const InputError& problem) {
        tell(fmt::format("note: no preview of {}: {}\n", job.name, problem.what()));
      }
    }
    std::error_code ignored;
    if (shows)
      pages.push_back(page);
    else if (!made_from_of(page).empty())  // of a refusal that has been mended
      fs::remove(page, ignored);
  }
  return pages;
}

/// Pages of the jobs that the report tells of at length. One that cannot be made is no reason to fail: the results are
/// there, and the report stands without it.
void refresh_pages(const StudyPlaces& places, const std::vector<RankingRow>& rows) {
  const std::vector<bool> detailed = detailed_jobs(rows);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!detailed[k]) continue;
    try {
      refresh_job_page({rows[k].job, places.job(rows[k].job)});
    } catch (const InputError& problem) {
      tell(fmt::format("note: no page of {}: {}\n", rows[k].job, problem.what()));
    }
  }
}

void write_results(const Study& study, const StudyPlaces& places, const std::vector<RankingRow>& rows) {
  refresh_pages(places, rows);
  write_text_if_changed(places.folder / "ranking.csv", ranking_csv(rows));
  write_report(places.folder / "report.html", study.name, rows);
}

/// A study with fewer jobs than cores lets each stage use several.
void share_cores(int at_a_time, std::size_t jobs) {
  const std::size_t each = static_cast<std::size_t>(at_a_time) / std::max<std::size_t>(jobs, 1);
  constexpr int keep = 0;  // what the user has set
  ::setenv("DRESSLIFE_THREADS", std::to_string(std::max<std::size_t>(each, 1)).c_str(), keep);
}

/// Runs the graph that was written. left: jobs in it. Returns how many stages were started.
int build_rest(const Study& study, const StudyPlaces& places, const Options& options, std::size_t left,
               std::vector<JobState>& states, Progress& progress) {
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

/// Makes what is not up to date and brings the states up to date. Returns how many stages were started.
int make_rest(const StudyRequest& request, Standing& standing, const Options& options) {
  const auto& [study, places, states, remembered, looks, digests] = standing;
  Progress progress(study.name, options.quiet);
  std::size_t left = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty()) continue;
    left += !states[k].done();
    if (!states[k].damaged.empty())
      progress.note(fmt::format("{}: {}", places.job(study.jobs[k].name).string(), states[k].words()));
  }
  if (remembered)
    renew_receipts(study, places, states);
  else
    write_build_graph(study, places, states, options.limits);
  if (!remembered) remember(request, standing);
  return left == 0 ? 0 : build_rest(study, places, options, left, standing.states, progress);
}

/// Runs what is not up to date of a study that no file of its own tells. Returns its rows.
std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const Options& options) {
  std::vector<JobState> states = states_of(study, places);
  Progress progress(study.name, options.quiet);
  std::size_t left = 0;
  for (std::size_t k = 0; k < states.size(); ++k) left += study.jobs[k].failure.empty() && !states[k].done();
  write_build_graph(study, places, states, options.limits);
  if (left > 0) build_rest(study, places, options, left, states, progress);
  return ranking_of(study, places, states);
}

/// What the ratings of its cables say of each row; making: lets their rigs run first.
void add_relative_lives(const Study& study, const StudyPlaces& of_study, const Options& options, bool making,
                       std::vector<RankingRow>& rows) {
  const RatedStudy rated = rated_study(study);
  if (rated.cables.empty()) return;
  const StudyPlaces places{of_study.folder / ".rigs", of_study.programs};
  const std::vector<RankingRow> rigs =
      making ? made_rows(rated.rigs, places, options) : ranking_of(rated.rigs, places, states_of(rated.rigs, places));
  for (const std::string& reason : relate(rated, rigs, rows)) tell(fmt::format("note: {}\n", reason));
}

int run(const Options& options) {
  const StudyRequest request = request_of(options);
  const fs::path folder = request.out / study_name(request.file);
  Standing standing;
  const bool begun = fs::is_directory(folder);
  if (!begun) standing = expanded(request);  // a study that cannot be expanded leaves no folder
  const FolderLock lock(folder);
  if (begun) standing = standing_of(request);
  if (standing.remembered && !standing.all_done()) standing = expanded(request);
  if (!begun) look_again(standing);
  const int executed = make_rest(request, standing, options);
  const auto& [study, places, states, remembered, looks, digests] = standing;
  if (!options.quiet)
    tell(executed ? fmt::format("{}: {} stages ran\n", study.name, executed)
                  : fmt::format("{}: nothing to do\n", study.name));
  std::vector<RankingRow> rows = ranking_of(study, places, states);
  add_relative_lives(study, places, options, true, rows);
  const std::vector<fs::path> previews = refresh_previews(study, places, states);
  write_results(study, places, rows);
  print(
      shown(fmt::format("{}\nReport: {}\n", ranking_table(rows), (places.folder / "report.html").string())));
  const int failed = count_failed(rows);
  if (failed == 0) return 0;
  tell(fmt::format(
      "{}: error: {} of {} jobs failed (their reasons are in the table); see the log in each job's folder\n",
      options.study, failed, study.jobs.size()));
  for (const fs::path& page : previews)
    tell(fmt::format("note: what the simulation refuses can be seen in {}; after a change: dresslife preview JOB.yaml\n",
                     page.string()));
  return 1;
}

int failure_words(const std::string& input, const std::vector<RankingRow>& rows) {
  const int failed = count_failed(rows);
  if (failed == 0) return 0;
  tell(fmt::format("{}: error: {} of {} jobs failed (their reasons are in the table)\n", input, failed, rows.size()));
  return 1;
}

int rate(const Options& options) {
  const RateStudy rated =
      rate_study(named_file(options.study, "dresspacks"), shipped_catalogue() / "rigs", options.sets);
  const StudyPlaces places{fs::path(options.out) / rated.study.name, program_folder()};
  const FolderLock lock(places.folder);
  const std::vector<RankingRow> rows = made_rows(rated.study, places, options);
  write_text_if_changed(places.folder / "rate.csv", rate_csv(rated, rows));
  print(shown(fmt::format("{}\nTable: {}\n", rate_table(rated, rows), (places.folder / "rate.csv").string())));
  return failure_words(options.study, rows);
}

int validate(const Options& options) {
  const ValidationStudy validation = read_observations(named_file(options.study, "observations"), options.sets);
  const StudyPlaces places{fs::path(options.out) / validation.study.name, program_folder()};
  const FolderLock lock(places.folder);
  const std::vector<RankingRow> rows = made_rows(validation.study, places, options);
  const std::string table = validation_table(validation, rows);
  write_text_if_changed(places.folder / "validation.md", table);
  write_text_if_changed(places.folder / "validation.svg", validation_picture(validation, rows));
  print(shown(fmt::format("{}\nPicture: {}\n", table, (places.folder / "validation.svg").string())));
  return failure_words(options.study, rows);
}

int status(const Options& options) {
  const Standing standing = standing_of(request_of(options));
  std::size_t done = 0;
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    const StudyJob& job = standing.study.jobs[k];
    const std::string word = job.failure.empty() ? standing.states[k].words() : "failed   " + job.failure;
    done += word == "done";
    print(shown(fmt::format("{:<40} {}\n", job.name, word)));
  }
  print(fmt::format("{} of {} jobs done\n", done, standing.study.jobs.size()));
  return 0;
}

/// Prints the ranking of what is done. The files of the study's folder are brought up to date where they
/// would hold what a run would write; with results of other settings among the jobs they stay those of the
/// last run.
int report(const Options& options) {
  const StudyRequest request = request_of(options);
  if (const fs::path folder = request.out / study_name(request.file); !fs::is_directory(folder))
    throw InputError({folder.string()}, "is not there (the study has not run)",
                     "run it: dresslife run " + options.study);
  const Standing standing = standing_of(request);
  const auto& [study, places, states, remembered, looks, digests] = standing;
  std::vector<RankingRow> rows = ranking_of(study, places, states);
  add_relative_lives(study, places, options, false, rows);
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
  if (is_dresslife_file(options.study)) {
    print(shown(file_summary(options.study)));
    return 0;
  }
  print(job_text(named_file(options.study, "jobs"), options.sets));
  return 0;
}

std::string beginning_of(const fs::path& file, std::size_t bytes) {
  std::string begin(bytes, '\0');
  std::ifstream(file, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(bytes));
  return begin;
}

/// A picture may replace a picture.
void check_picture(const fs::path& file) {
  check_replaceable(file);
  std::error_code failure;
  if (!fs::exists(file, failure)) return;
  const std::string begin = beginning_of(file, 4);
  if (begin != "<svg" && begin != "\x89PNG")
    throw InputError({file.string()}, "is there already and no picture", "name another file after -o");
}

void write_picture(const fs::path& file, const std::string& svg) {
  write_text_if_changed(file, file.extension() == ".png" ? png_of(svg) : svg);
}

int plot(const Options& options) {
  const fs::path file = options.picture;
  if (file.extension() != ".svg" && file.extension() != ".png")
    throw InputError({file.string()}, "is neither an .svg nor a .png", "name the picture accordingly");
  check_picture(file);
  Figure what{};
  while (word(what) != options.what) what = static_cast<Figure>(static_cast<int>(what) + 1);
  write_picture(file, figure(what, job_files(options.study), options.time));
  return 0;
}

int export_job(const Options& options) {
  const fs::path file = options.picture;
  if (file.extension() != ".xdmf")
    throw InputError({file.string()}, "is no .xdmf", "name the file accordingly: ParaView goes by it");
  check_replaceable(file);
  std::error_code failure;
  if (fs::exists(file, failure) && beginning_of(file, 64).find("<Xdmf") == std::string::npos)
    throw InputError({file.string()}, "is there already and no XDMF", "name another file after --paraview");
  write_text_if_changed(file, xdmf_text(job_files(options.study), file));
  return 0;
}

int draw(const Options& options) {
  if (!options.picture.empty()) check_picture(options.picture);
  const Dresspack dresspack = read_dresspack(named_file(options.study, "dresspacks"));
  print(shown(construction_text(dresspack)));
  for (const std::string& warning : overlap_warnings(dresspack)) tell(warning + "\n");
  if (options.picture.empty()) return 0;
  write_picture(options.picture, cross_section_picture(dresspack));
  return 0;
}

/// Of any folder that holds a job's results.
int page(const Options& options) {
  const fs::path folder = options.study;
  JobFolder files{fs::weakly_canonical(folder).filename().string(), folder};
  std::error_code failure;
  if (!fs::is_regular_file(files.life(), failure))
    throw InputError({folder.string()}, "holds no life.h5", "name the folder of a job that is done: runs/STUDY/JOB");
  refresh_job_page(files);
  print(shown(files.page().string() + "\n"));
  return 0;
}

/// A page may replace a page.
void check_page(const fs::path& file) {
  check_replaceable(file);
  std::error_code failure;
  if (fs::exists(file, failure) && made_from_of(file).empty())
    throw InputError({file.string()}, "is there already and no page of dresslife's", "name another file after -o");
}

/// What a job looks like before its run, and what is wrong with its routing. A job that is refused has a page, too: the
/// exit status tells that the page is there.
int preview(const Options& options) {
  const fs::path job = named_file(options.study, "jobs");
  const fs::path page = options.picture.empty() ? fs::path(job.stem().string() + "_preview.html") : fs::path(options.picture);
  check_page(page);
  const PassingFile told("preview.h5");
  if (const int status = tell_preview(job, options.sets, {}, told.path())) return status;
  write_text_if_changed(page, preview_page(told.path(), job.stem().string(), xxh3(shell_digest())));
  if (const std::string refusal = refusal_of(told.path()); !refusal.empty())
    print(shown("The simulation refuses it: " + refusal + "\n"));
  for (const std::string& line : length_words(told.path())) print(shown(line + "\n"));
  print(shown("Preview: " + page.string() + "\n"));
  return 0;
}

/// Becomes dresslife-import, which lies beside this program and takes the rest of the command line.
int import_program(char** arguments) {
  const std::string program = (program_folder() / "dresslife-import").string();
  ::execv(program.c_str(), arguments);
  throw InputError({program}, "cannot be started", "install dresslife's programs into one folder");
}

std::vector<std::string> figure_words() {
  std::vector<std::string> words;
  for (Figure what{}; !word(what).empty(); what = static_cast<Figure>(static_cast<int>(what) + 1))
    words.emplace_back(word(what));
  return words;
}

void add_common(CLI::App* command, Options& options) {
  command->add_option("-o,--output", options.out, "folder of the results")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--set", options.sets, "override a key in every job; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
}

/// Of the commands that run stages.
void add_running(CLI::App* command, Options& options) {
  command->add_option("-j,--jobs", options.jobs, "stages at a time")
      ->check(CLI::Range(1, 1024))
      ->default_str("one per core");
  command->add_flag("--quiet", options.quiet, "no progress, no notes");
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
  run_command->add_option("study", options.study, "STUDY.yaml, or JOB.yaml for a study of one")
      ->required()
      ->type_name("");
  add_running(run_command, options);
  run_command
      ->add_option("--job-time", options.limits.seconds, "let no stage of a job take longer; 0: no limit")
      ->type_name("SECONDS")
      ->capture_default_str();
  run_command
      ->add_option("--job-memory", options.limits.megabytes,
                   "let no stage of a job take more memory; 0: no limit")
      ->type_name("MB")
      ->default_str("all of the machine's");
  add_common(run_command, options);
  CLI::App* status_command =
      app.add_subcommand("status", "tell which jobs of a study are done, stale, failed or to do");
  status_command->add_option("study", options.study, "STUDY.yaml")->required()->type_name("");
  add_common(status_command, options);
  CLI::App* report_command =
      app.add_subcommand("report", "rank and report what has been computed, without running anything");
  report_command->add_option("study", options.study, "STUDY.yaml")->required()->type_name("");
  add_common(report_command, options);
  CLI::App* show_command = app.add_subcommand(
      "show", "print a job with its catalogue entries and defaults written out, or what lies in an .h5 file");
  show_command->add_option("job", options.study, "JOB.yaml or FILE.h5")->required()->type_name("");
  show_command->add_option("--set", options.sets, "override a key; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
  CLI::App* plot_command = app.add_subcommand("plot", "draw one figure of a job's results into a file");
  plot_command->add_option("job", options.study, "the job's folder, or one of its .h5 files")
      ->required()
      ->type_name("");
  plot_command->add_option("--what", options.what, "which figure")
      ->required()
      ->check(CLI::IsMember(figure_words()))
      ->type_name("");
  plot_command->add_option("-o,--output", options.picture, "picture to write, .svg or .png")
      ->required()
      ->type_name("FILE");
  plot_command
      ->add_option("--time", options.time,
                   "of scene and deformation; without it when the most damaging cycle closes")
      ->type_name("SECONDS");
  CLI::App* export_command = app.add_subcommand(
      "export", "write a job's motion and results for ParaView (5.11 or newer), which plays them in 3D");
  export_command->add_option("job", options.study, "the job's folder, or one of its .h5 files")
      ->required()
      ->type_name("");
  export_command
      ->add_option("--paraview", options.picture, "file to write; it names the .h5 files, which must stay")
      ->required()
      ->type_name("FILE.xdmf");
  CLI::App* rate_command = app.add_subcommand(
      "rate", "tell how many cycles a cable, or each of a dresspack's, lives in the standard test rigs, beside its ratings");
  rate_command->add_option("cable", options.study, "DRESSPACK.yaml")->required()->type_name("");
  add_running(rate_command, options);
  add_common(rate_command, options);
  CLI::App* validate_command = app.add_subcommand(
      "validate", "hold observed lives of cables and wires against what the model says of the same tests");
  validate_command->add_option("observations", options.study, "OBSERVATIONS.yaml")->required()->type_name("");
  add_running(validate_command, options);
  add_common(validate_command, options);
  CLI::App* draw_command = app.add_subcommand(
      "draw", "list a dresspack's layers and what they add up to, and draw its cross-section to scale");
  draw_command->add_option("dresspack", options.study, "DRESSPACK.yaml")->required()->type_name("");
  draw_command->add_option("-o,--output", options.picture, "picture to write, .svg or .png")
      ->type_name("FILE");
  CLI::App* preview_command = app.add_subcommand(
      "preview", "show a job before its run: robot, clamps and dresspack over the program, which lengths suit, and what is refused");
  preview_command->add_option("job", options.study, "JOB.yaml")->required()->type_name("");
  preview_command->add_option("-o,--output", options.picture, "page to write (HTML); else JOB_preview.html here")
      ->type_name("FILE.html");
  preview_command->add_option("--set", options.sets, "override a key; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
  CLI::App* page_command = app.add_subcommand(
      "page", "write the page of one job: robot and dresspack in motion, its damage over place and time");
  page_command->add_option("folder", options.study, "folder of its results: runs/STUDY/JOB")->required()->type_name("");
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
    if (draw_command->parsed()) return draw(options);
    if (page_command->parsed()) return page(options);
    if (preview_command->parsed()) return preview(options);
    if (plot_command->parsed()) return plot(options);
    if (export_command->parsed()) return export_job(options);
    if (rate_command->parsed()) return rate(options);
    if (validate_command->parsed()) return validate(options);
    return manual(app, options);
  }));
}
