#include "pipeline/commands/command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "pipeline/base/screen.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/making.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Prints the ranking of the existing results and updates the files of the study's folder. Stale jobs keep their last result,
/// marked as stale. If results that these files may describe are missing, broken off or damaged, the files stay as the last run
/// left them.
int report(const StudyOptions& options) {
  const StudyRequest request = request_of(options);
  folder_of_results(request, options);  // refuses a study without any
  StudyState standing = standing_study(request);
  const auto& [study, places, states, digests] = standing;
  std::vector<RankingRow> rows = ranking_of(study, places, states);
  add_relative_lives(study, places, nullptr, rows);
  print(options.json ? json_of(rows).text + "\n" : shown(ranking_table(rows, screen_columns())));
  write_stderr(shown(problem_words(study)) + warning_lines(rows));
  const auto open = std::ranges::count_if(states, [](const JobState& state) {
    return !state.done() && !state.has_last && state.has_results && state.failure.empty();
  });
  bool all_written = true;
  std::string kept;
  const auto others = std::ranges::count_if(rows, [](const RankingRow& row) { return !row.done(); });
  if (!options.sets.empty() && others > 0)
    kept = fmt::format("of {} jobs there are no results with these --set", others);
  else if (open > 0)
    kept = fmt::format("of {} jobs the results are broken off or damaged", open);
  else if (::access(places.folder.c_str(), W_OK) != 0)
    kept = "the folder cannot be written";
  if (kept.empty()) {
    all_written = write_results(study, places, rows).empty();
    if (!options.json) print(shown(fmt::format("\nReport: {}\n", (places.folder / "report.html").string())));
  } else {
    write_stderr(fmt::format("{}: note: ranking.csv and report.html stay as the last run left them ({})\n",
                             places.folder.string(), kept));
  }
  const int failed = count_failed(rows);
  if (failed > 0)
    write_stderr(fmt::format(
        "{}: error: {} of {} jobs have no current result (their reasons are in the table); make them with dresslife run\n",
        options.study, failed, study.jobs.size()));
  return failed > 0 || !all_written ? 1 : 0;
}

}  // namespace

Command report_command() {
  const auto options = std::make_shared<StudyOptions>();
  return {"report", "rank and report what has been computed, without running anything",
          joined({{study_or_job(*options), json_option(options->json)}, study_options(*options)}),
          [options] { return report(*options); }};
}

}  // namespace dresslife::pipeline
