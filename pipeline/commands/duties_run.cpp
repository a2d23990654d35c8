#include "pipeline/commands/duties_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/advise/plan/rounds.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {

namespace {

/// Runs the rounds of the duties' orders in a separate folder, and appends them to the study and its rows.
void add_rounds(const DutyFile& file, const RunOptions& options, Study& study, const StudyPlaces& of_study,
                std::vector<RankingRow>& rows) {
  const StudyPlaces places{of_study.folder / ".rounds", of_study.programs};
  const Study rounds = study_of_rounds(file, study, rows, places.folder);
  if (rounds.jobs.empty()) return;
  for (RankingRow& row : made_rows(rounds, places, options)) rows.push_back(std::move(row));
  study.jobs.insert(study.jobs.end(), rounds.jobs.begin(), rounds.jobs.end());
}

/// Returns, by job, the duration of one repeat of the duties' programs. A motion that dresslife-sim refuses is left out, because
/// the run states the reason. So are the programs beyond the first hundred: a large study needs no wait before its first stage.
std::map<std::string, double> repeat_seconds(const DutyFile& file, const Study& study) {
  constexpr std::size_t most = 100;  // each takes less than a tenth of a second
  std::set<std::string> named;
  for (const Duty& duty : file.duties)
    for (const DutyProgram& program : duty.programs)
      if (named.size() < most) named.insert(program.job);
  const PassingFile described("job.yaml"), duration("duration.yaml");
  std::map<std::string, double> seconds;
  for (const StudyJob& job : study.jobs) {
    if (!named.contains(job.name) || !job.job || job.job->motion.is_prescribed()) continue;
    write_text_if_changed(described.path(), with_mark(job_text(*job.job), Mark::yaml), Sync::never);
    if (run_stage_program("dresslife-sim",
                          {described.path().string(), "--duration", "-o", duration.path().string(), "--quiet"},
                          StageWords::dropped) != 0)
      continue;
    const Node written = read_yaml(duration.path());
    if (const Node* const of_repeat = written.find("repeat_seconds"))
      seconds[job.name] = number_in(of_repeat->text).value_or(0);
  }
  return seconds;
}

void check_before_run(const DutyFile& file, const StudyState& standing) {
  check_programs(file, standing.study);
  if (!standing.all_done()) check_hours(file, repeat_seconds(file, standing.study));
}

/// Prints how many results of other settings this run replaces, and what has changed since the first of them.
void note_replaced(const StudyState& standing) {
  std::vector<JobState> states = standing.states;
  const auto replaced =
      std::ranges::count_if(states, [](const JobState& state) { return state.has_last && !state.done(); });
  if (replaced == 0) return;
  report_changes(standing.study, standing.places, states);
  const auto first = std::ranges::find_if(states, [](const JobState& state) { return !state.changed.empty(); });
  if (first == states.end()) return;
  write_stderr(fmt::format("note: {} earlier result{} replaced. Changed since that of '{}': {}\n", replaced,
                           replaced == 1 ? " is" : "s are",
                           standing.study.jobs[static_cast<std::size_t>(first - states.begin())].name, first->changed));
}

}  // namespace

DutiesRun run_duties(const DutyFile& file, const RunOptions& options) {
  const std::filesystem::path named = file.study, beside = folder_of(file.where) / named;
  const bool is_path = named.extension() == ".yaml" && named.is_relative();
  const std::filesystem::path beside_file = beside.string() + ".yaml";
  if (!is_path && beside_file != std::filesystem::path(file.where.file) && kind_of(beside_file) == FileKind::file)
    throw InputError(file.where,
                     fmt::format("study '{}' is a name of the catalogue, and {}.yaml is a file beside this one",
                                 file.study, file.study),
                     fmt::format("write study: {}.yaml for the file, or studies/{}", file.study, file.study));
  const std::filesystem::path study = named_study((is_path ? beside : named).string());
  check_sets(study, options.sets, options.quiet);
  const StudyRequest request{study, options.sets, options.out, program_folder()};
  const std::filesystem::path folder = request.out / study_name(study);
  const bool begun = kind_of(folder) == FileKind::folder;
  StudyState standing;
  if (!begun) standing = expanded(request);  // a study that cannot be expanded creates no folder
  if (!begun) check_before_run(file, standing);
  const FolderLock lock(folder);
  claim_folder(folder, study);
  if (begun) standing = expanded(request);
  if (begun) check_before_run(file, standing);
  for (const Warning& warning : mounting_warnings(file, standing.study, nullptr))
    write_stderr(shown(warning.paragraph()));
  if (begun) note_replaced(standing);
  if (!begun) look_again(standing);
  make_rest(standing, options);
  std::vector<RankingRow> rows = results_of(standing.study, standing.places, standing.states);
  for (const Warning& warning : mounting_warnings(file, standing.study, &rows))
    write_stderr(shown(warning.paragraph()));
  add_rounds(file, options, standing.study, standing.places, rows);
  for (const Warning& warning : uncounted_changes(file, standing.study, rows)) write_stderr(shown(warning.paragraph()));
  return {std::move(standing.study), std::move(standing.places), std::move(rows)};
}

}  // namespace dresslife::pipeline
