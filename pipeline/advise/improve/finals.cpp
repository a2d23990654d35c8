#include "pipeline/advise/improve/finals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pipeline/base/lists.h"
#include "pipeline/base/ownership.h"

namespace dresslife::pipeline {
namespace {

// Three are compared within the tolerance, the fourth only if none of them runs in all its cases. Each costs a full run.
constexpr std::size_t most_finalists = 4;

/// Returns the best candidates; with two objectives the whole front. The original jobs are left out, because they are always
/// included.
std::vector<std::size_t> finalists_of(const Improvement& found) {
  if (found.front.size() > 1) return filtered(found.front, [](std::size_t k) { return k > 0; });
  std::vector<std::size_t> best;
  for (std::size_t k = 1; k < found.trials.size(); ++k)
    if (found.trials[k].worst.feasible()) best.push_back(k);
  std::stable_sort(best.begin(), best.end(),
                   [&](std::size_t a, std::size_t b) { return found.merit(a) > found.merit(b); });
  if (best.size() > most_finalists) best.resize(most_finalists);
  return best;
}

/// Returns whether a row belongs to one of these jobs.
bool is_of(const RankingRow& row, const std::vector<std::string>& jobs) {
  return std::find(jobs.begin(), jobs.end(), row.job) != jobs.end();
}

}  // namespace

const Final* Finals::best() const {
  const auto rank = [](const Final& one) { return std::pair{!one.exceeds_more, one.tolerance->worst}; };
  const Final* found = nullptr;
  for (std::size_t k = 1; k < of.size(); ++k)
    if (of[k].tolerance && of[k].tolerance->whole && (!found || rank(of[k]) > rank(*found))) found = &of[k];
  return found ? found : best_drawn();
}

const Final* Finals::best_drawn() const {
  if (of.size() < 2) return nullptr;
  return &*std::max_element(of.begin() + 1, of.end(), [](const Final& a, const Final& b) { return a.merit < b.merit; });
}

std::pair<Merit, Merit> Finals::compared(const Final& candidate) const {
  const Final& original = of.front();
  if (!candidate.tolerance || !candidate.tolerance->whole || !original.tolerance)
    return {candidate.merit, original.merit};
  return {candidate.tolerance->worst, original.tolerance->worst};
}

bool Finals::is_gain(const Final& candidate) const {
  const auto [one, original] = compared(candidate);
  return !candidate.exceeds_more && clearly_better(one, original);
}

bool Finals::fails_earlier(const Final& candidate) const {
  const auto [one, original] = compared(candidate);
  return one.kept > original.kept && pipeline::fails_earlier(one, original);
}

const RankingRow* Finals::worst_row(const Final& one) const {
  const RankingRow* worst = nullptr;
  for (const RankingRow& row : rows)
    if (is_of(row, one.jobs) && row.done() && (!worst || row.headline_hours() < worst->headline_hours())) worst = &row;
  return worst;
}

void remove_trial_files(const Improvement& found, const StudyPlaces& places, bool during_search) {
  const std::vector<std::size_t> finalists = finalists_of(found);
  for (std::size_t k = 0; k < found.trials.size(); ++k) {
    const Trial& trial = found.trials[k];
    if (during_search && (k == 0 || std::ranges::count(finalists, k) > 0)) continue;
    for (std::size_t j = 0; j < trial.jobs.size(); ++j)
      for (std::size_t stage = 0; trial.outcomes[j].failure.empty() && stage < stage_count; ++stage)
        if (may_lack(found.keep_trials, stage)) remove_ours(places.job(trial.jobs[j]) / files_of_stage(stage).output);
  }
}

Finals finals_of(const Improvement& found, const ImproveRequest& request, const MakeRows& make_rows) {
  Finals finals{{found.name, {}, found.keep_finals}, {}, {}};
  std::vector<std::size_t> trials = finalists_of(found);
  trials.insert(trials.begin(), 0);
  for (const std::size_t trial : trials) {
    const std::string prefix = trial == 0 ? "before" : fmt::format("final_{:04}", trial);
    Final of{{}, HUGE_VAL, trial, found.merit(trial)};
    of.exceeds_more = exceeds_more(found.trials[trial].worst, found.trials.front().worst);
    for (StudyJob& job : changed_jobs(request, found.trials[trial].sets, prefix)) {
      of.jobs.push_back(job.name);
      finals.study.jobs.push_back(std::move(job));
    }
    finals.of.push_back(std::move(of));
  }
  finals.rows = make_rows(finals.study);
  for (Final& of : finals.of)
    for (const RankingRow& row : finals.rows)
      if (is_of(row, of.jobs)) of.hours = std::min(of.hours, row.done() ? row.headline_hours() : 0);
  return finals;
}

void judge(Finals& finals, const Improvement& found, const ImproveRequest& request, const MountingTolerance& tolerance,
           const StudyPlaces& places, const MakeRows& make_rows, const ToleranceProgress& progress) {
  std::vector<Final*> best_first;
  for (std::size_t k = 1; k < finals.of.size(); ++k) best_first.push_back(&finals.of[k]);
  std::stable_sort(best_first.begin(), best_first.end(),
                   [](const Final* a, const Final* b) { return a->merit > b->merit; });
  if (found.front.size() > 1 && best_first.size() > 1) best_first.erase(best_first.begin() + 1, best_first.end());
  const Outcome& as_it_is = found.trials.front().worst;
  std::vector<Finalist> finalists;
  const auto finalist = [&](const Final* of) {
    return finalist_of(
        found.trials[of->trial].worst, tolerance,
        [&, number = of->trial](const std::vector<std::string>& sets, const std::string& name) {
          std::vector<std::string> all = found.trials[number].sets;
          all.insert(all.end(), sets.begin(), sets.end());
          return changed_jobs(request, all, fmt::format("off_{:04}_{}", number, name));
        },
        [&](const std::vector<StudyJob>& jobs) {
          const std::vector<RankingRow> rows = make_rows({found.name, jobs, found.keep_trials});
          return mapped(jobs, [&](const StudyJob& job) {
            return outcome_of(*find_in(rows, &RankingRow::job, job.name), places.job(job.name), found.limits);
          });
        });
  };
  for (const Final* of : best_first) finalists.push_back(finalist(of));
  const std::vector<WithinTolerance> judged = within_tolerance(finalists, as_it_is, progress);
  for (std::size_t k = 0; k < judged.size(); ++k) best_first[k]->tolerance = judged[k];
  // The original jobs are also evaluated within the tolerance, unless the best is better than their merit without offset.
  const Final* const best = finals.best();
  Final& original = finals.of.front();
  if (best && best->tolerance && best->tolerance->whole && as_it_is.feasible() &&
      original.merit > best->tolerance->worst)
    original.tolerance = within_tolerance(
        finalist(&original), as_it_is,
        [&](const Merit& worst) { return clearly_better(best->tolerance->worst, worst); }, judged, progress);
}

std::optional<double> share_longer(const Finals& finals, const Final& best, const StudyPlaces& places) {
  const RankingRow *before = finals.worst_row(finals.of.front()), *after = finals.worst_row(best);
  if (!before || !after) return std::nullopt;
  Study two{finals.study.name, {}};
  for (const StudyJob& job : finals.study.jobs)
    if (job.name == before->job || job.name == after->job) two.jobs.push_back(job);
  const std::vector<RankingRow> rows = ranking_of(two, places, states_of(two, places));
  if (rows.size() < 2 || !rows[0].outlives_next) return std::nullopt;
  return rows[0].job == after->job ? *rows[0].outlives_next : 1 - *rows[0].outlives_next;
}

}  // namespace dresslife::pipeline
