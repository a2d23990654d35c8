#include "pipeline/commands/duties_run.h"

#include <fmt/format.h>

#include "pipeline/advise/plan/evaluated_duties.h"
#include "pipeline/advise/plan/rounds.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/commands/making.h"
#include "pipeline/study/folder_lock.h"
#include "pipeline/study/folder_source.h"

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

}  // namespace

DutiesRun run_duties(const DutyFile& file, const RunOptions& options) {
  const std::filesystem::path named = file.study, beside = folder_of(file.where) / named;
  const bool is_path = named.extension() == ".yaml" && named.is_relative();
  const std::filesystem::path beside_file = beside.string() + ".yaml";
  if (!is_path && beside_file != std::filesystem::path(file.where.file) &&
      kind_of(beside_file) == FileKind::file)
    throw InputError(
        file.where,
        fmt::format("study '{}' is a name of the catalogue, and {}.yaml is a file beside this one",
                    file.study, file.study),
        fmt::format("write study: {}.yaml for the file, or studies/{}", file.study, file.study));
  const std::filesystem::path study = named_study((is_path ? beside : named).string());
  const StudyRequest request{study, options.sets, options.out, program_folder()};
  const std::filesystem::path folder = request.out / study_name(study);
  const bool begun = kind_of(folder) == FileKind::folder;
  StudyState standing;
  if (!begun) standing = expanded(request);  // a study that cannot be expanded creates no folder
  if (!begun) check_programs(file, standing.study);
  const FolderLock lock(folder);
  claim_folder(folder, study);
  if (begun) standing = standing_of(request);
  if (standing.remembered && standing.all_done())
    read_jobs(standing);
  else if (standing.remembered)
    standing = expanded(request);
  if (begun) check_programs(file, standing.study);
  for (const Warning& warning : mounting_warnings(file, standing.study, nullptr)) tell(shown(warning.line() + "\n"));
  if (!begun) look_again(standing);
  make_rest(request, standing, options);
  std::vector<RankingRow> rows = results_of(standing.study, standing.places, standing.states);
  for (const Warning& warning : mounting_warnings(file, standing.study, &rows)) tell(shown(warning.line() + "\n"));
  add_rounds(file, options, standing.study, standing.places, rows);
  return {std::move(standing.study), std::move(standing.places), std::move(rows)};
}

}  // namespace dresslife::pipeline
