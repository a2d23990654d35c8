#include "pipeline/commands/results.h"

#include <fmt/format.h>

#include <functional>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/report/job_page.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/report/report.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {

namespace fs = std::filesystem;

int print_preview(const fs::path& job, const std::vector<std::string>& sets, const StageLimits& limits,
                  const fs::path& preview, StageWords said) {
  std::vector<std::string> arguments{job.string(),
                                     "--preview",
                                     "-o",
                                     preview.string(),
                                     "--quiet",
                                     "--job-time",
                                     std::to_string(limits.seconds),
                                     "--job-memory",
                                     std::to_string(limits.megabytes)};
  for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
  return run_stage_program("dresslife-sim", arguments, said);
}

namespace {

/// Writes the page of a refused job if the refusal or the parts of the page changed. Returns whether a page exists.
bool refresh_preview(const fs::path& job, const fs::path& page, const JobState& state, const std::string& name) {
  constexpr StageLimits limits{
      20, 4000};  // a preview takes one second and little memory; the ranking contains the reason of the failure
  const std::string made_from = xxh3(shell_digest() + state.recipes[0] + state.failure + name);
  if (made_from_of(page) == made_from) return true;
  const bool on_its_way = state.failure.find("is pulled tight") != std::string::npos;
  const PassingFile preview("preview.h5");
  if (print_preview(job, {}, limits, preview.path(), StageWords::dropped) != 0) return false;
  if (!on_its_way && refusal_of(preview.path()).empty()) return false;
  write_text_if_changed(page, preview_page(preview.path(), name, made_from, state.failure), Sync::never);
  return true;
}

}  // namespace

std::vector<fs::path> refresh_previews(const Study& study, const StudyPlaces& places,
                                       const std::vector<JobState>& states) {
  constexpr std::size_t most = 10;  // each takes half a second
  std::vector<fs::path> pages;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const StudyJob& job = study.jobs[k];
    const fs::path page = places.job(job.name) / "preview.html";
    bool shows = false;
    if (pages.size() < most && job.failure.empty() && states[k].next == 0 && is_refusal(states[k].failure)) {
      try {
        shows = refresh_preview(places.job(job.name) / "job.yaml", page, states[k], job.name);
      } catch (const InputError& problem) {
        write_stderr(fmt::format("note: no preview of {}: {}\n", job.name, problem.what()));
      }
    }
    if (shows)
      pages.push_back(page);
    else  // the refusal has been corrected
      remove_ours(page);
  }
  return pages;
}

namespace {

/// Returns the reason why the page of a job's last result does not match the ranking; empty: it may match.
std::string why_old(const RankingRow& row) {
  if (row.stale) return stale_words(row);
  if (!row.done()) return "the job has no result now: " + row.failure;
  return row.life_file.empty() ? "ranking.csv has the present result; the files for this page are not kept" : "";
}

/// Does a step with a job's page. Returns whether it succeeded; prints the error if not.
bool taken(const std::string& job, const std::function<void()>& step) {
  try {
    step();
    return true;
  } catch (const InputError& problem) {
    write_stderr(fmt::format("no page of {}: {}\n", job, problem.what()));
    return false;
  }
}

/// Writes the pages of the jobs that have a section in the report. Other existing pages stay if they belong to the existing
/// results. Returns the jobs whose page could not be written; their old pages are removed, and the ranking is complete without
/// them.
std::set<std::string> refresh_pages(const StudyPlaces& places, const std::vector<RankingRow>& rows) {
  const std::vector<bool> detailed = detailed_jobs(rows);
  std::set<std::string> failed;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JobFolder files{rows[k].job, places.job(rows[k].job)};
    const bool brought_up = taken(files.name, [&] {
      if (const std::string why = why_old(rows[k]); !why.empty())
        mark_job_page(files, why);
      else if (detailed[k])
        refresh_job_page(files);
      else
        remove_old_job_page(files);
    });
    if (brought_up) continue;
    failed.insert(files.name);
    taken(files.name, [&] { remove_job_page(files); });
  }
  return failed;
}

}  // namespace

std::set<std::string> write_results(const Study& study, const StudyPlaces& places,
                                    const std::vector<RankingRow>& rows) {
  std::set<std::string> failed = refresh_pages(places, rows);
  write_text_if_changed(places.folder / "ranking.csv", ranking_csv(rows));
  for (const ReportProblem& problem : write_report(places.folder / "report.html", study.name, rows)) {
    write_stderr(fmt::format("report.html shows no charts of {}: {}\n", problem.job, problem.words));
    failed.insert(problem.job);
  }
  return failed;
}

}  // namespace dresslife::pipeline
