#include "pipeline/commands/making.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <unordered_map>

#include "pipeline/base/installation.h"
#include "pipeline/base/progress.h"
#include "pipeline/study/build_graph.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/relative_life.h"
#include "pipeline/study/run_share.h"
#include "pipeline/study/shared_stages.h"

namespace dresslife::pipeline {
namespace {

/// If a study has fewer jobs than cores, each stage uses several cores. A launcher's stages use the cores of other machines.
void share_cores(const RunOptions& options, std::size_t jobs) {
  const std::size_t cores = options.launcher.empty() ? static_cast<std::size_t>(options.jobs) : 1;
  const std::size_t each = cores / std::max<std::size_t>(jobs, 1);
  constexpr int keep = 0;  // setenv() keeps a value that the user has set
  ::setenv("DRESSLIFE_THREADS", std::to_string(std::max<std::size_t>(each, 1)).c_str(), keep);
}

/// Removes files that the study does not keep, during the run. The files of jobs that share them are removed together after the
/// last of these jobs: earlier removal would free no space, and a removed link changes a time of a file that other jobs read.
class Unkept {
 public:
  Unkept(const Study& study, const StudyPlaces& places, const std::vector<JobState>& states)
      : study_(study), places_(places), states_(states) {
    if (study.keep == Keep::all || !study.removes_unkept) return;
    const std::vector<Makers> makers = makers_of(study, states);
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (!study.jobs[k].failure.empty() || states[k].done()) continue;
      const std::size_t first = makers[k][states[k].next];
      together_[first].push_back(k);
      left_.emplace("fatigue " + study.jobs[k].name, first);
    }
  }
  /// Handles the end of a stage. stage: BuildEvent::what.
  void ended(const std::string& stage) {
    const auto found = left_.find(stage);
    if (found == left_.end()) return;
    const std::size_t first = found->second;
    left_.erase(found);
    if (++ended_[first] < together_[first].size()) return;
    std::vector<JobState> now;
    for (const std::size_t k : together_[first]) {
      now.push_back(states_[k]);
      look_at(now.back(), folder(k));
    }
    for (std::size_t i = 0; i < now.size(); ++i) remove_unkept(now[i], folder(together_[first][i]));
  }

 private:
  std::filesystem::path folder(std::size_t k) const { return places_.job(study_.jobs[k].name); }

  const Study& study_;
  const StudyPlaces& places_;
  const std::vector<JobState>& states_;
  std::unordered_map<std::string, std::size_t> left_;  ///< (last stage of a job) first job of its group
  std::unordered_map<std::size_t, std::vector<std::size_t>> together_;  ///< (first job) all jobs of its group
  std::unordered_map<std::size_t, std::size_t> ended_;
};

std::size_t count_left(const Study& study, const std::vector<JobState>& states) {
  std::size_t left = 0;
  for (std::size_t k = 0; k < states.size(); ++k) left += study.jobs[k].failure.empty() && !states[k].done();
  return left;
}

/// (kind) number of stages that the graph of a study starts.
std::array<std::size_t, stage_count> stages_left(const Study& study, const std::vector<JobState>& states) {
  std::array<std::size_t, stage_count> counts{};
  const std::vector<Makers> makers = makers_of(study, states);
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t stage = states[k].next; study.jobs[k].failure.empty() && stage < stage_count; ++stage)
      counts[stage] += makers[k][stage] == k;
  return counts;
}

/// Runs the written graph. left: number of jobs in it. Returns the number of started stages.
int build_rest(const Study& study, const StudyPlaces& places, const RunOptions& options, std::size_t left,
               std::vector<JobState>& states, const Digests& before, Progress& progress) {
  share_cores(options, left);
  Unkept unkept(study, places, states);
  RunShare run(stages_left(study, states));
  const Progress::Clock::time_point begin = Progress::Clock::now();
  double most = 0;
  const BuildResult built = run_build_graph(places, options.jobs, [&](const BuildEvent& event) {
    const double seconds = std::chrono::duration<double>(Progress::Clock::now() - begin).count();
    const double share = run.ended(event.stage, seconds);
    most = std::max(most, share);
    const std::string remaining = remaining_words(seconds, 0, share);
    if (options.share_done)
      options.share_done(most);  // it counts as new work when it falls
    else
      progress.show(fmt::format("{:5.1f} %{}{}  {}/{}  {}", 100 * share, remaining.empty() ? "" : ", ", remaining,
                                event.finished, event.total, event.what));
    unkept.ended(event.what);
  });
  progress.clear();
  if (!built.words.empty())
    write_stderr(fmt::format("{}: error: {}; run again\n", places.folder.string(), built.words));
  close_run(study, places, built, states, before);
  return built.executed;
}

/// Runs the first of every group of jobs with the same recipes. The other jobs of the group take its results. Jobs without such
/// a group wait for the next graph. Returns the number of started stages.
int make_first_of_same(const Study& study, const StudyPlaces& places, const RunOptions& options,
                       std::vector<JobState>& states, const Digests& before, Progress& progress) {
  if (study.keep == Keep::lives) return 0;  // the first job would keep no files that the others could take
  std::map<std::array<std::string, stage_count>, std::vector<std::size_t>> by_recipe;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (study.jobs[k].failure.empty() && !states[k].done()) by_recipe[states[k].recipes].push_back(k);
  Study first{study.name, {}, study.keep};
  std::vector<std::size_t> jobs;
  for (const auto& [recipes, same] : by_recipe)
    if (same.size() > 1) jobs.push_back(same.front());
  if (jobs.empty()) return 0;
  std::vector<JobState> of_first;
  for (const std::size_t k : jobs) first.jobs.push_back(study.jobs[k]), of_first.push_back(states[k]);
  write_build_graph(first, places, of_first, options.limits, options.launcher);
  const int started = build_rest(first, places, options, jobs.size(), of_first, before, progress);
  for (std::size_t i = 0; i < jobs.size(); ++i) states[jobs[i]] = of_first[i];
  share_stages(study, places, states);
  return started;
}

}  // namespace

int make_rest(StudyState& standing, const RunOptions& options) {
  const auto& [study, places, states, digests] = standing;
  Progress progress(study.name, options.quiet);
  share_stages(study, places, standing.states);
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!study.jobs[k].failure.empty()) continue;
    remove_unkept(states[k], places.job(study.jobs[k].name));
    if (!states[k].damaged.empty())
      progress.note(fmt::format("{}: {}", places.job(study.jobs[k].name).string(), states[k].words().line()));
  }
  int started = 0;
  if (count_left(study, states) > 1)
    started = make_first_of_same(study, places, options, standing.states, digests, progress);
  const std::size_t left = count_left(study, states);
  write_build_graph(study, places, states, options.limits, options.launcher);
  return left == 0 ? started : started + build_rest(study, places, options, left, standing.states, digests, progress);
}

std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options) {
  Digests before;
  std::vector<JobState> states = states_of(study, places, before);
  share_stages(study, places, states);
  Progress progress(study.name, options.quiet);
  for (std::size_t k = 0; k < states.size(); ++k)
    if (study.removes_unkept && study.jobs[k].failure.empty()) remove_unkept(states[k], places.job(study.jobs[k].name));
  write_build_graph(study, places, states, options.limits, options.launcher);
  if (const std::size_t left = count_left(study, states); left > 0)
    build_rest(study, places, options, left, states, before, progress);
  return ranking_of(study, places, states);
}

std::vector<RankingRow> made_rows(const Study& study, const StudyPlaces& places, const RunOptions& options,
                                  const FilesAtStart& files) {
  files.check();
  std::vector<RankingRow> rows = made_rows(study, places, options);
  files.check();
  return rows;
}

OwnFolder::OwnFolder(const StudyOptions& options, const std::string& name, const std::filesystem::path& file)
    : places{std::filesystem::path(options.out) / name, program_folder()}, lock(places.folder) {
  claim_folder(places.folder, file);
}

ToleranceRuns::ToleranceRuns(const std::string& label, const RunOptions& options)
    : progress_(label, options.quiet), options_(options) {
  options_.share_done = [this](double share) { show(share); };
}

void ToleranceRuns::begin(const ToleranceCount& count) {
  count_ = count;
  show(0);
}

void ToleranceRuns::show(double share) {
  progress_.show((count_.done + share * count_.next) / count_.likely, "mounting tolerance: " + count_.words);
}

void add_relative_lives(const Study& study, const StudyPlaces& of_study, const RunOptions* to_run,
                        std::vector<RankingRow>& rows) {
  const auto is_rated = [](const StudyJob& job) {
    return job.failure.empty() && job.job && has_ratings(job.job.with(Piece::rest));
  };
  if (study.keep == Keep::lives && std::ranges::any_of(study.jobs, is_rated))
    write_stderr(
        "note: no life in rated cycles, because keep: lives keeps no damage of single places. Remedy: "
        "keep: histories\n");
  const RatedStudy rated = rated_study(study);
  if (rated.cables.empty()) return;
  const StudyPlaces places{of_study.folder / ".rigs", of_study.programs};
  const std::vector<RankingRow> rigs =
      to_run ? made_rows(rated.rigs, places, *to_run) : ranking_of(rated.rigs, places, states_of(rated.rigs, places));
  for (const std::string& reason : relate(rated, rigs, rows)) write_stderr(fmt::format("note: {}\n", reason));
}

int count_failed(const std::vector<RankingRow>& rows) {
  return static_cast<int>(std::ranges::count_if(rows, [](const RankingRow& row) { return !row.done(); }));
}

int say_failures(const std::string& input, const std::vector<RankingRow>& rows) {
  const int failed = count_failed(rows);
  if (failed == 0) return 0;
  write_stderr(
      fmt::format("{}: error: {} of {} jobs failed (their reasons are in the table)\n", input, failed, rows.size()));
  return 1;
}

}  // namespace dresslife::pipeline
