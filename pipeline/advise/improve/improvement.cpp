#include "pipeline/advise/improve/improvement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "pipeline/advise/improve/faults.h"
#include "pipeline/advise/improve/obstacle.h"
#include "pipeline/advise/improve/reliefs.h"
#include "pipeline/advise/search/surrogate_search.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"
#include "pipeline/study/changes.h"
#include "pipeline/study/study_problems.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

Node with_frees(Node free, const std::vector<std::string>& written) {
  for (const std::string& one : written) {
    const Where where{"--free " + one};
    const std::size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(where, "is not KEY.PATH=RANGE", "write for example --free 'routing.free_length_m=1.9 .. 2.6'");
    Node value = parse_yaml(one.substr(equals + 1), where.file);
    place_at(value, where);
    free[one.substr(0, equals)] = std::move(value);
    free.where = free.where.file.empty() ? where : free.where;
  }
  return free;
}

AskedLimits limits_of(const Node& document) {
  AskedLimits limits;
  const Node* written = document.find("limits");
  if (!written) return limits;
  Node root;
  root["limits"] = *written;
  root.where = document.where;
  read_fields(root, Describe([&](Fields& f) { f.group("limits", limits, Need::required, ""); }));
  return limits;
}

/// Returns "{KEY.PATH: VALUE, ...}" for "KEY.PATH=VALUE".
std::string changes_of(const std::vector<std::string>& sets) {
  const auto change = [](const std::string& set) {
    return set.substr(0, set.find('=')) + ": " + set.substr(set.find('=') + 1);
  };
  return "{" + joined(mapped(sets, change), ", ") + "}";
}

double longest_hose(const std::vector<StudyJob>& jobs) {
  double longest = 0;
  for (const StudyJob& job : jobs)
    for (std::size_t k = 0; job.job && k < job.job->dresspacks.size(); ++k)
      longest = std::max(longest, job.job->dresspacks[k].routing.free_length);
  return longest;
}

class Improver {
 public:
  Improver(const ImproveRequest& request, const StudyPlaces& places, const TrialMakers& makers)
      : request_(request), places_(places), makers_(makers) {
    const Node document = read_document(request.file);
    done_.limits = limits_of(document);
    const Study study = read_study(request.file, request.sets);
    require_wires(study, {request.file.string()});
    if (document.find("keep")) done_.keep_trials = done_.keep_finals = study.keep;
    for (const StudyJob& job : study.jobs) {
      if (!job.failure.empty())
        throw InputError({request.file.string()}, fmt::format("job '{}' cannot be run: {}", job.name, job.failure),
                         "correct it");
      done_.jobs.push_back(job.name);
      jobs_.push_back(job.job);
    }
    const Node* free = document.find("free");
    Node freed = with_frees(free ? *free : Node{}, request.frees);
    if (freed.kind == Node::Kind::null) freed = Freedom::usual(*jobs_.front());
    freedom_ = Freedom::from(freed, jobs_);
    check_ranges();
    done_.name = study_name(request.file);
    for (const Freedom::FreeVariable& key : freedom_.keys()) {
      done_.freed.push_back(key.path);
      done_.own.push_back(key.own);
    }
    const bool frees_dresspack = std::any_of(done_.freed.begin(), done_.freed.end(),
                                             [](const std::string& path) { return path.starts_with("dresspack"); });
    for (const auto& job : jobs_)
      for (const Warning& fault : dresspack_faults(*job, !frees_dresspack))
        faults_ = joined(std::move(faults_), {fault});
    for (const Warning& fault : faults_) pipeline::write_stderr(fault.paragraph());
    find_screened();
  }

  Improvement run() {
    const std::unique_ptr<Search> search = made_search();
    Trial as_it_is = tried({{}}).front();
    const std::optional<VectorXd> start = freedom_.place_of_job();
    if (start) {
      as_it_is.place = *start;
      search->tell({candidate_of(as_it_is, *start)});
    }
    done_.trials.push_back(std::move(as_it_is));
    makers_.report(done_);
    bool stopped_early = false;
    try {
      try_others(*search);
      stopped_early = static_cast<int>(done_.trials.size()) < request_.trials;
      try_reliefs();
    } catch (const FilesChanged& change) {
      done_.ended = change.what();
    }
    done_.front = best_trials();
    if (done_.front.empty()) done_.obstacle = obstacle_words(done_.trials, freedom_);
    if (done_.ended.empty() && stopped_early)
      done_.obstacle.insert(done_.obstacle.begin(),
                            fmt::format("The search stopped early: of {} short runs the nearest to the limits: {}",
                                        done_.short_runs, nearest_words_));
    return std::move(done_);
  }

 private:
  void try_others(Search& search) {
    while (static_cast<int>(done_.trials.size()) < request_.trials) {
      const int left = request_.trials - static_cast<int>(done_.trials.size());
      const std::vector<VectorXd> asked = search.ask(std::min(left, request_.at_a_time));
      if (asked.empty()) break;  // the search has ended
      std::vector<Candidate> candidates;
      for (Trial& trial : tried(sets_at(asked))) {
        trial.place = asked[candidates.size()];
        candidates.push_back(candidate_of(trial, trial.place));
        done_.trials.push_back(std::move(trial));
      }
      search.tell(candidates);
      makers_.report(done_);
    }
  }

  /// Tries bend reliefs: on the best trial if its wires break beside a clamp, or on the trial nearest to the limits if a bend
  /// exceeds its limit. Reliefs that make something fail earlier are refused; the order of trials decides about the others.
  void try_reliefs() {
    if (aims() > 1) return;  // a relief has a cost that a second objective does not include
    const std::optional<std::size_t> best = done_.best();
    const std::size_t of = best ? *best : nearest_trial(done_.trials);
    if (of == done_.trials.size()) return;
    const Trial bare = done_.trials[of];
    if (best ? !bare.breaks_beside_clamp : !(bare.worst.beyond[bend_limit] > 0)) return;
    const std::vector<StudyJob> jobs = changed_jobs(request_, bare.sets, "bare");
    const std::vector<std::vector<std::string>> reliefs = reliefs_of(*jobs.front().job);
    // A relief is one value in all jobs, so jobs that need different ones have none.
    if (std::ranges::any_of(jobs, [&](const StudyJob& job) { return reliefs_of(*job.job) != reliefs; })) return;
    std::vector<std::vector<std::string>> sets;
    for (const std::vector<std::string>& relief : reliefs) {
      sets.push_back(bare.sets);
      sets.back().insert(sets.back().end(), relief.begin(), relief.end());
      for (const std::string& set : relief)
        if (const std::string key = set.substr(0, set.find('='));
            std::find(done_.freed.begin(), done_.freed.end(), key) == done_.freed.end())
          done_.freed.push_back(key), done_.own.emplace_back();
    }
    if (sets.empty()) return;
    for (Trial& trial : tried(sets)) {
      if (trial.worst.failure.empty()) trial.relief_refusal = earlier_failures(trial.worst, bare.worst);
      if (!trial.relief_refusal.empty())
        trial.worst.failure = "its bend relief makes fail earlier: " + trial.relief_refusal;
      done_.trials.push_back(std::move(trial));
    }
    makers_.report(done_);
  }

  std::vector<std::vector<std::string>> sets_at(const std::vector<VectorXd>& places) const {
    return mapped(places, [&](const VectorXd& place) { return freedom_.sets_at(place); });
  }

  std::size_t aims() const { return request_.second == SecondAim::none ? 1 : 2; }

  std::unique_ptr<Search> made_search() {
    const Screen screen = [this](const std::vector<VectorXd>& places) { return surely_beyond(places); };
    const SurrogateSettings settings{
        .seed = request_.seed, .aims = aims(), .short_runs = std::max(0, request_.short_runs)};
    done_.most_short_runs = request_.short_runs > 0 ? request_.short_runs : static_cast<int>(40 * freedom_.variables());
    ShortRuns make_short_runs;
    if (request_.short_runs != 0 && !screened_.empty())
      make_short_runs = [this](const std::vector<VectorXd>& places) { return short_runs_of(places); };
    return std::make_unique<SurrogateSearch>(freedom_.variables(), settings, screen, make_short_runs);
  }

  /// Checks that some values of the free keys give a valid job. Errors: InputError for a key that does not exist, or a range in
  /// another unit.
  void check_ranges() const {
    std::string failure;
    for (const double at : {0.5, 0.0, 1.0}) {
      const VectorXd place = VectorXd::Constant(freedom_.variables(), at);
      try {
        const std::vector<StudyJob> jobs = changed_jobs(request_, freedom_.sets_at(place), "free");
        const auto refused =
            std::find_if(jobs.begin(), jobs.end(), [](const StudyJob& job) { return !job.failure.empty(); });
        if (refused == jobs.end()) return;
        if (failure.empty()) failure = refused->failure;
      } catch (const InputError& error) {
        if (failure.empty()) failure = error.what();
      }
    }
    throw InputError({request_.file.string()}, "no value of what is free makes a job: " + failure,
                     "correct `free`, or --free");
  }

  /// Finds the jobs whose routing can be screened by geometry.
  void find_screened() {
    for (const auto& job : jobs_) {
      const ScreenedList list =
          screening_of(*job, "[{}]\n", ScreenedBy::geometry, request_.longest_bracket, places_.folder);
      if (!list.candidates.empty() && list.candidates.front().refusal.empty()) screened_.push_back(job);
    }
  }

  /// (trial) result of the job with the largest geometric violation.
  struct ScreeningResult {
    double violation = 0;
    bool rejected = false;
    std::vector<double> beyond;
    std::string words;
    double bracket = -HUGE_VAL;  ///< (V7) of the job with the largest value
  };
  std::vector<ScreeningResult> screened(const std::vector<std::vector<std::string>>& sets) const {
    const std::string candidates = list_of_changes(sets);
    std::vector<ScreeningResult> worst(sets.size());
    for (const auto& job : screened_) {
      const ScreenedList list =
          screening_of(*job, candidates, ScreenedBy::geometry, request_.longest_bracket, places_.folder);
      for (std::size_t k = 0; k < list.candidates.size() && k < sets.size(); ++k) {
        constexpr double no_job = 10;  // larger than the violation of every valid job
        const ScreenedCandidate& of = list.candidates[k];
        const double violation = of.refusal.empty() ? of.violation() : no_job;
        worst[k].rejected = worst[k].rejected || of.rejected;
        if (of.refusal.empty())
          worst[k].bracket = std::max(worst[k].bracket, limits_of_short_run(list.limits, of.beyond)[bracket_limit]);
        if (violation > worst[k].violation)
          worst[k] = {violation, worst[k].rejected, of.beyond, of.refusal.empty() ? list.words(of) : of.refusal,
                      worst[k].bracket};
      }
    }
    return worst;
  }

  static std::string list_of_changes(const std::vector<std::vector<std::string>>& sets) {
    return joined(mapped(sets, [](const auto& of) { return "- " + changes_of(of) + "\n"; }), "");
  }

  /// Returns, (place), the worst of all jobs' short runs. A trial that does not run has its violation of the geometric limits
  /// (V1) to (V5).
  std::vector<Candidate> short_runs_of(const std::vector<VectorXd>& places) {
    const std::string candidates = list_of_changes(sets_at(places));
    std::vector<Candidate> results = mapped(places, [](const VectorXd& place) {
      return Candidate{place, true, {}, {}};
    });
    std::vector<std::pair<double, std::string>> worst(places.size());  // violation and its limits
    for (const auto& job : screened_) {
      const ScreenedList list =
          screening_of(*job, candidates, ScreenedBy::short_runs, request_.longest_bracket, places_.folder);
      for (std::size_t k = 0; k < places.size(); ++k) {
        if (k >= list.candidates.size()) throw std::logic_error("a list of short runs is not whole");
        const ScreenedCandidate& of = list.candidates[k];
        add_short_run(results[k], list, of);
        const double violation = of.refusal.empty() ? of.violation() : HUGE_VAL;
        if (violation >= worst[k].first) worst[k] = {violation, of.refusal.empty() ? list.words(of) : of.refusal};
      }
    }
    for (const auto& [violation, words] : worst)
      if (violation < nearest_ || nearest_words_.empty()) nearest_ = violation, nearest_words_ = words;
    done_.short_runs += static_cast<int>(places.size() * screened_.size());
    makers_.report(done_);
    return results;
  }

  static void add_short_run(Candidate& candidate, const ScreenedList& list, const ScreenedCandidate& screened) {
    const bool runs = screened.refusal.empty();
    if (!runs && candidate.ran) candidate = {candidate.place, false, {}, {}};
    if (runs != candidate.ran) return;
    const std::vector<double> beyond = runs ? limits_of_short_run(list.limits, screened.beyond) : screened.beyond;
    if (runs) add_bends(candidate.pieces, screened.bends);
    if (candidate.beyond.empty()) candidate.beyond = beyond;
    for (std::size_t k = 0; k < beyond.size(); ++k) candidate.beyond[k] = std::max(candidate.beyond[k], beyond[k]);
  }

  std::vector<double> surely_beyond(const std::vector<VectorXd>& places) const {
    std::vector<double> beyond(places.size(), 0.0);
    if (screened_.empty()) return beyond;
    const std::vector<ScreeningResult> results = screened(sets_at(places));
    for (std::size_t k = 0; k < places.size(); ++k) beyond[k] = results[k].rejected ? results[k].violation : 0;
    return beyond;
  }

  std::vector<Trial> tried(const std::vector<std::vector<std::string>>& sets) {
    std::vector<Trial> trials(sets.size());
    Study study{done_.name, {}, done_.keep_trials, false};  // finals.h removes files
    std::map<std::string, std::pair<std::size_t, std::size_t>>
        trial_of;  // (job) its trial, and its index among the trial's jobs
    std::map<std::string, std::shared_ptr<const Job>> study_job_of;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      Trial& trial = trials[k];
      trial.sets = sets[k];
      const std::vector<StudyJob> jobs =
          changed_jobs(request_, sets[k], fmt::format("trial_{:04}", done_.trials.size() + k));
      trial.hose_length = longest_hose(jobs);
      trial.outcomes.resize(jobs.size());
      for (std::size_t j = 0; j < jobs.size(); ++j) {
        trial.jobs.push_back(jobs[j].name);
        trial_of[jobs[j].name] = {k, j};
        study_job_of[jobs[j].name] = jobs[j].job;
        study.jobs.push_back(jobs[j]);
      }
    }
    for (const RankingRow& row : makers_.make_rows(study)) {
      if (done_.trials.empty()) check_evaluated(done_.limits, row);  // the original jobs
      const auto [k, j] = trial_of.at(row.job);
      trials[k].outcomes[j] = outcome_of(row, places_.job(row.job), done_.limits);
      trials[k].cycle_seconds += row.repeat_seconds;
      if (breaks_beside_clamp(*study_job_of.at(row.job), row)) trials[k].breaks_beside_clamp = true;
    }
    for (Trial& trial : trials) trial.worst = worst_of(trial.outcomes);
    add_geometry(trials);
    return trials;
  }

  /// Adds geometry: to failed trials their violation of the geometric limits, to the others whether a bracket can carry the
  /// clamps.
  void add_geometry(std::vector<Trial>& trials) const {
    if (screened_.empty()) return;
    const std::vector<ScreeningResult> results = screened(mapped(trials, &Trial::sets));
    for (std::size_t k = 0; k < trials.size(); ++k) {
      Outcome& worst = trials[k].worst;
      if (worst.failure.empty()) {
        worst.beyond[bracket_limit] = std::max(worst.beyond[bracket_limit], results[k].bracket);
        continue;
      }
      trials[k].screened = results[k].words;
      worst.beyond = results[k].beyond;
    }
  }

  Candidate candidate_of(const Trial& trial, const VectorXd& place) const {
    Candidate candidate{place, trial.worst.failure.empty(), {}, trial.worst.beyond};
    if (candidate.ran)
      candidate.aims.push_back(
          -search_value(trial.worst, done_.trials.empty() ? trial.worst : done_.trials.front().worst));
    if (candidate.ran && aims() == 2)
      candidate.aims.push_back(request_.second == SecondAim::hose_length ? trial.hose_length : trial.cycle_seconds);
    return candidate;
  }

  std::vector<std::size_t> best_trials() const {
    const std::optional<std::size_t> best = done_.best();
    if (!best) return {};
    if (aims() == 1) return {*best};  // of equal trials the first
    // If some trials make no mode worse, only these are considered.
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k < done_.trials.size(); ++k) {
      candidates.push_back(candidate_of(done_.trials[k], {}));
      if (done_.merit(k).kept < done_.merit(*best).kept) candidates.back().ran = false;
    }
    return front(candidates);
  }

  const ImproveRequest& request_;
  const StudyPlaces& places_;
  const TrialMakers& makers_;
  const Sources read_once_;
  std::vector<std::shared_ptr<const Job>> jobs_, screened_;
  Freedom freedom_;
  Improvement done_;
  std::vector<Warning> faults_;
  double nearest_ = HUGE_VAL;  // smallest violation of the short runs, and its limits
  std::string nearest_words_;
};

}  // namespace

std::optional<std::size_t> Improvement::best() const {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (trials[k].worst.feasible() && (!found || merit(k) > merit(*found))) found = k;
  return found;
}

std::string value_in(const Trial& trial, const std::string& key) {
  for (const std::string& set : trial.sets)
    if (set.starts_with(key + "=")) return set.substr(key.size() + 1);
  return "";
}

std::vector<StudyJob> changed_jobs(const ImproveRequest& request, const std::vector<std::string>& sets,
                                   const std::string& prefix) {
  std::vector<std::string> all = request.sets;
  all.insert(all.end(), sets.begin(), sets.end());
  std::vector<StudyJob> jobs = read_study(request.file, all).jobs;
  for (StudyJob& job : jobs) {
    job.name = jobs.size() == 1 ? prefix : prefix + "_" + job.name;
    if (job.job && job.job->calibration) job.job = as_candidate(*job.job);
  }
  return jobs;
}

std::shared_ptr<const Job> as_candidate(Job job) {
  if (job.calibration) job.calibration->residual_spread = 1;
  return std::make_shared<const Job>(std::move(job));
}

Improvement improve(const ImproveRequest& request, const StudyPlaces& places, const TrialMakers& makers) {
  return Improver(request, places, makers).run();
}

std::string unfinished_words(const Improvement& improvement) {
  const std::optional<std::size_t> best = improvement.best();
  if (!best) return fmt::format("None of the {} trials before keeps all limits.\n", improvement.trials.size());
  const Trial& trial = improvement.trials[*best];
  std::string text =
      fmt::format("The best of the {} trials before is {}: {}, all limits kept; no mounting tolerance was tried.\n",
                  improvement.trials.size(), *best == 0 ? "the job as it is" : fmt::format("trial {}", *best),
                  hours_text(trial.worst.hours));
  for (const std::string& set : trial.sets) text += fmt::format("    --set '{}'\n", set);
  return text;
}

std::string improvement_csv(const Improvement& improvement) {
  std::string text = "trial,feasible,life_hours_p10,beyond,free_length_m,cycle_s,first_mode,first_mode_hours";
  for (const std::string& freed : improvement.freed) text += "," + csv_cell(freed);
  text += "\n";
  for (std::size_t k = 0; k < improvement.trials.size(); ++k) {
    const Trial& trial = improvement.trials[k];
    const bool ran = trial.worst.failure.empty();
    const std::string words =
        ran ? trial.worst.words() : trial.worst.failure + (trial.screened.empty() ? "" : "; ") + trial.screened;
    text +=
        fmt::format("{},{},{},{},{},{}", k, trial.worst.feasible() ? 1 : 0, ran ? shortest_text(trial.worst.hours) : "",
                    csv_cell(words), shortest_text(trial.hose_length), ran ? shortest_text(trial.cycle_seconds) : "");
    const ModeLife first = first_mode(trial.worst);
    text += fmt::format(",{},{}", csv_cell(first.mode), ran && !first.mode.empty() ? shortest_text(first.hours) : "");
    for (const std::string& freed : improvement.freed) text += "," + csv_cell(value_in(trial, freed));
    text += "\n";
  }
  return text;
}

}  // namespace dresslife::pipeline
