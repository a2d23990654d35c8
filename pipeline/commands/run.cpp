#include "pipeline/commands/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <sstream>

#include "pipeline/base/screen.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/files/files.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"
#include "pipeline/study/shards.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

std::string ran_words(int stages) { return fmt::format("{} {} ran", stages, stages == 1 ? "stage" : "stages"); }

/// Runs the jobs of one shard beside the runs of other shards. A run of the whole study writes ranking and report.
int run_shard(const RunOptions& options) {
  const StudyRequest request = request_of(options);
  StudyState standing = expanded(request, shard_from(options.shard, "--shard"));
  const fs::path& folder = standing.places.folder;
  const FolderLock beside(folder, FolderLock::Mode::with_shards);
  claim_folder(folder, request.file);
  const FolderLock lock(folder / standing.places.notes());
  look_again(standing);
  const int executed = make_rest(standing, options);
  if (!options.quiet) write_stderr(fmt::format("{} {}: {}\n", standing.study.name, options.shard, ran_words(executed)));
  return say_failures(options.study, ranking_of(standing.study, standing.places, standing.states));
}

/// Prints the stages that a run would start, without starting them.
int dry_run(const RunOptions& options) {
  const StudyRequest request = request_of(options, options.quiet);
  StudyState standing;
  if (options.shard.empty()) {
    standing = standing_study(request);
  } else {
    check_source(request.out / study_name(request.file), request.file);
    standing = expanded(request, shard_from(options.shard, "--shard"));
    report_changes(standing.study, standing.places, standing.states);
  }
  std::size_t to_make = 0, refused = 0;
  JobList jobs(options.json);
  for (std::size_t k = 0; k < standing.states.size(); ++k) {
    const StudyJob& job = standing.study.jobs[k];
    if (!job.failure.empty()) {
      ++refused;
      jobs.add(job.name, {"refused", first_problem(job)});
    }
    if (!job.failure.empty() || standing.states[k].done()) continue;
    ++to_make;
    jobs.add(job.name, standing.states[k].words());
  }
  jobs.end(shown(problem_words(standing.study)) +
           fmt::format("{} of {} jobs to make; nothing was run\n", to_make, standing.study.jobs.size()));
  return refused > 0 ? 1 : 0;
}

struct RunArguments : RunOptions {
  bool dry_run = false;
};

/// Adds its file with the sets in force, and file and line of the warnings about settings, to a job that is no study.
void locate(std::vector<RankingRow>& rows, const fs::path& file, const std::vector<std::string>& sets) {
  const Node document = read_document(file);
  if (rows.size() != 1 || document.find("base")) return;
  name_file(rows.front(), file, sets);
  if (rows.front().warnings) rows.front().warnings = located(*std::move(rows.front().warnings), document);
}

/// Returns the notes of the jobs about tools whose space is not known and about assumed values of their programs, each once. Of more
/// jobs than a terminal describes: none, because each file takes a millisecond; check prints the notes of each job.
std::string tool_notes(const Study& study, const StudyPlaces& places) {
  constexpr std::size_t most = 3;  // jobs
  std::set<std::string> notes, assumed;
  if (study.jobs.size() > most) return "";
  for (const StudyJob& job : study.jobs) {
    const fs::path file = places.job(job.name) / "motion.h5";
    if (!job.failure.empty() || kind_of(file) != FileKind::file) continue;
    try {
      const FileReader motion(file, motion_format(), FileReader::Scope::attributes);
      if (motion.has_attribute("tool_note")) notes.insert(motion.text_attribute("tool_note"));
      if (!motion.has_attribute("assumed")) continue;
      std::istringstream lines(motion.text_attribute("assumed"));
      for (std::string line; std::getline(lines, line);) assumed.insert(line);
    } catch (const InputError&) {  // a damaged file: the table states it
    }
  }
  std::string text;
  for (const std::string& note : notes)
    text += paragraph(fmt::format("note: {}. The hours above are computed without it", note));
  for (const std::string& line : assumed) text += paragraph(line.starts_with("ESTIMATE") ? line : "note: " + line);
  return text;
}

int run(const RunArguments& options) {
  if (options.dry_run) return dry_run(options);
  if (!options.shard.empty()) return run_shard(options);
  const StudyRequest request = request_of(options, options.quiet);
  const fs::path folder = request.out / study_name(request.file);
  StudyState standing;
  const bool begun = kind_of(folder) == FileKind::folder;
  if (!begun) standing = expanded(request);  // a study that cannot be expanded creates no folder
  const FolderLock lock(folder);
  claim_folder(folder, request.file);
  if (begun) standing = expanded(request);
  if (!begun) look_again(standing);
  const int executed = make_rest(standing, options);
  report_changes(standing.study, standing.places, standing.states);
  const auto& [study, places, states, digests] = standing;
  const bool any = std::ranges::any_of(study.jobs, [](const StudyJob& job) { return job.failure.empty(); });
  if (!options.quiet && any)
    write_stderr(fmt::format("{}: {}\n", study.name, executed == 0 ? "nothing to do" : ran_words(executed)));
  std::vector<RankingRow> rows = ranking_of(study, places, states);
  add_relative_lives(study, places, &options, rows);
  const std::vector<fs::path> previews = refresh_previews(study, places, states);
  const std::set<std::string> not_shown = write_results(study, places, rows);
  for (const std::string& job : not_shown) forget_damaged(places.job(job));
  locate(rows, request.file, options.sets);
  print(options.json ? json_of(rows).text + "\n"
                     : shown(fmt::format("{}\nReport: {}\n", ranking_table(rows, screen_columns()),
                                         (places.folder / "report.html").string())));
  write_stderr(warning_lines(rows));
  if (!options.quiet) write_stderr(shown(tool_notes(study, places)));
  const int failed = count_failed(rows);
  if (failed == 0) return not_shown.empty() ? 0 : 1;
  write_stderr(shown(problem_words(study)));
  const auto refused = std::ranges::count_if(study.jobs, [](const StudyJob& job) { return !job.failure.empty(); });
  write_stderr(fmt::format("{}: error: {} of {} jobs failed (their reasons are in the table); {}\n", options.study,
                           failed, study.jobs.size(),
                           failed > refused ? "see the log in each job's folder"
                                            : "none of them ran: correct the settings in these reasons"));
  for (const fs::path& page : previews)
    write_stderr(
        fmt::format("note: what the simulation refuses can be seen in {}; after a change: dresslife preview {}\n",
                    page.string(), rows.front().file.empty() ? "JOB.yaml" : rows.front().file));
  return 1;
}

}  // namespace

Command run_command() {
  const auto options = std::make_shared<RunArguments>();
  return {
      "run", "run what is not up to date in a study, then rank and report",
      joined(
          {{study_or_job(*options)},
           run_options(*options),
           {{"-n,--dry-run", "", "print what would be made and why, and run nothing", &options->dry_run},
            json_option(options->json)},
           {{"--job-time", "SECONDS", "let no stage of a job take longer; 0: no limit", &options->limits.seconds},
            {"--job-memory",
             "MB",
             "let no stage of a job take more memory; 0: no limit",
             &options->limits.megabytes,
             {.shown_default = "all of the machine's"}},
            launcher_option(*options),
            {"--shard", "K/N", "make only the Kth of N parts of the study, beside runs of the others, and rank nothing",
             &options->shard}},
           study_options(*options)}),
      [options] { return run(*options); }};
}

}  // namespace dresslife::pipeline
