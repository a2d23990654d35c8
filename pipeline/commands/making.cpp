#include "pipeline/commands/making.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <unordered_map>

#include "pipeline/progress.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/relative_life.h"
#include "pipeline/study/shared_stages.h"

namespace dresslife::pipeline {
namespace {

/// A study with fewer jobs than cores lets each stage use several.
void share_cores(int at_a_time, std::size_t jobs) {
  const std::size_t each = static_cast<std::size_t>(at_a_time) / std::max<std::size_t>(jobs, 1);
  constexpr int keep = 0;  // what the user has set
  ::setenv("DRESSLIFE_THREADS", std::to_string(std::max<std::size_t>(each, 1)).c_str(), keep);
}

/// Runs the graph that was written. left: jobs in it. Returns how many stages were started.
int build_rest(const Study& study, const StudyPlaces& places, const RunOptions& options, std::size_t left,
               std::vector<JobState>& states, Progress& progress) {
  share_cores(options.jobs, left);
  std::unordered_map<std::string, std::size_t> last_stages;  // after which a job's files are needed no more
  for (std::size_t k = 0; study.keep != Keep::all && k < states.size(); ++k)
    last_stages.emplace("fatigue " + study.jobs[k].name, k);
  const BuildResult built = run_build_graph(places, options.jobs, [&](const BuildEvent& event) {
    progress.show(fmt::format("{}/{}  {}", event.finished, event.total, event.what));
    if (const auto job = last_stages.find(event.what); job != last_stages.end()) {
      JobState state = states[job->second];
      look_at(state, places.job(study.jobs[job->second].name));
      remove_unkept(state, places.job(study.jobs[job->second].name));
    }
  });
  progress.clear();
  if (!built.words.empty())
    tell(fmt::format("{}: error: {}; run again\n", places.folder.string(), built.words));
  close_run(study, places, built, states);
  return built.executed;
}

}  // namespace

int make_rest(const StudyRequest& request, Standing& standing, const RunOptions& options) {
  const auto& [study, places, states, remembered, looks, digests] = standing;
  Progress progress(study.name, options.quiet);
  std::size_t left = 0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty()) continue;
    left += !states[k].done();
    remove_unkept(states[k], places.job(study.jobs[k].name));
    if (!states[k].damaged.empty())
      progress.note(fmt::format("{}: {}", places.job(study.jobs[k].name).string(), states[k].words()));
  }
  if (remembered)
    renew_receipts(study, places, states);
  else
    write_build_graph(study, places, states, options.limits, options.launcher);
  if (!remembered) remember(request, standing);
  return left == 0 ? 0 : build_rest(study, places, options, left, standing.states, progress);
}

std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options) {
  std::vector<JobState> states = states_of(study, places);
  Progress progress(study.name, options.quiet);
  std::size_t left = 0;
  for (std::size_t k = 0; k < states.size(); ++k) left += study.jobs[k].failure.empty() && !states[k].done();
  write_build_graph(study, places, states, options.limits, options.launcher);
  if (left > 0) build_rest(study, places, options, left, states, progress);
  return ranking_of(study, places, states);
}

std::vector<RankingRow> shared_rows(const Study& study, const StudyPlaces& places, const RunOptions& options) {
  std::set<std::string> tried;
  std::vector<JobState> states;
  while (true) {
    states = states_of(study, places);
    share_stages(study, places, states);
    Study now{study.name, {}};
    for (const std::size_t k : without_likes(study, states))
      if (!tried.contains(study.jobs[k].name)) now.jobs.push_back(study.jobs[k]);
    if (now.jobs.empty()) break;
    for (const StudyJob& job : now.jobs) tried.insert(job.name);
    made_rows(now, places, options);
  }
  return ranking_of(study, places, states);
}

void add_relative_lives(const Study& study, const StudyPlaces& of_study, const RunOptions* to_run,
                        std::vector<RankingRow>& rows) {
  const RatedStudy rated = rated_study(study);
  if (rated.cables.empty()) return;
  const StudyPlaces places{of_study.folder / ".rigs", of_study.programs};
  const std::vector<RankingRow> rigs = to_run ? made_rows(rated.rigs, places, *to_run)
                                              : ranking_of(rated.rigs, places, states_of(rated.rigs, places));
  for (const std::string& reason : relate(rated, rigs, rows)) tell(fmt::format("note: {}\n", reason));
}

int count_failed(const std::vector<RankingRow>& rows) {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [](const RankingRow& row) { return !row.done(); }));
}

int say_failures(const std::string& input, const std::vector<RankingRow>& rows) {
  const int failed = count_failed(rows);
  if (failed == 0) return 0;
  tell(fmt::format("{}: error: {} of {} jobs failed (their reasons are in the table)\n", input, failed,
                   rows.size()));
  return 1;
}

}  // namespace dresslife::pipeline
