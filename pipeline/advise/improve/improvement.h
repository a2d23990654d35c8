// A search for better jobs. Its variables are the free keys, its objective is the order of merit.h for the worst job, its
// constraints are the checks.
//
// Every trial is a set of ordinary jobs of a study, so trials run in parallel and their results are stored. A trial is a function
// of the seed and of the earlier results. Therefore a second run repeats no finished job and continues an interrupted search.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/freedom.h"
#include "pipeline/advise/improve/merit.h"
#include "pipeline/advise/improve/outcome.h"
#include "pipeline/advise/improve/screened.h"
#include "pipeline/advise/search/search.h"
#include "pipeline/base/words.h"
#include "pipeline/job/bracket.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// The second objective, in addition to a long life.
enum class SecondAim { none, hose_length, cycle_time };
constexpr std::string_view word(SecondAim value) { return word_at({"none", "hose_length", "cycle_time"}, value); }

struct ImproveRequest {
  std::filesystem::path file;      ///< a job, or a study with the optional sections `free` and `limits`
  std::vector<std::string> sets;   ///< `--set` for every job
  std::vector<std::string> frees;  ///< "KEY.PATH=RANGE", in addition to those of the study
  /// Default: more trials change lives by less than their numerical error (pipeline/advise/improve/measurements.md, number of
  /// trials).
  int trials = 12;
  int at_a_time = 4;  ///< number of trials that are proposed together; the search depends on it
  std::uint64_t seed = 1;
  SecondAim second = SecondAim::none;
  std::optional<double> longest_bracket{};  ///< replaces the jobs' value [m]
  int short_runs =
      -1;  ///< largest number of short runs before the first trial; 0: none; -1: 40 times the number of variables
};

/// A candidate and its results.
struct Trial {
  Eigen::VectorXd place;          ///< (variable) 0 .. 1; empty: the original jobs, outside the ranges
  std::vector<std::string> sets;  ///< --set of each free key; empty: the original jobs
  std::vector<std::string> jobs;  ///< job names in the study of trials
  std::vector<Outcome> outcomes;  ///< (job)
  Outcome worst;                  ///< worst outcome of all jobs
  double hose_length = 0;         ///< length of the longest dresspack [m]
  double cycle_seconds = 0;       ///< duration of all jobs together [s]
  /// part or mode that fails earlier with its bend relief, which is also its failure; empty: none
  std::string relief_refusal;
  bool breaks_beside_clamp = false;  ///< whether this is true for some job (reliefs.h)
  std::string screened;              ///< limits by which geometry rejects it; empty: none, or not screened
};

struct Improvement {
  std::string name;                ///< name of the study
  std::vector<std::string> jobs;   ///< names of the study's jobs
  std::vector<std::string> freed;  ///< key paths
  std::vector<std::string> own;    ///< (freed) value in the jobs; empty: the jobs have none, or different ones
  AskedLimits limits;              ///< limits of the study, in addition to the checks
  /// Default: keep only the receipts of the trials, and all files of the best few.
  Keep keep_trials = Keep::lives, keep_finals = Keep::all;
  std::vector<Trial> trials;          ///< in their order, the original jobs first
  std::vector<std::size_t> front;     ///< indices of Pareto-optimal feasible trials, the best by merit first
  int short_runs = 0;                 ///< number of short runs
  int most_short_runs = 0;            ///< largest number of short runs before the first trial
  std::vector<std::string> obstacle;  ///< lines: reasons why no trial is feasible; empty: some are
  std::string ended;  ///< message that a file changed and ended the search early; empty: no file changed
  std::optional<std::size_t> best() const;  ///< best feasible trial by merit; absent: none is feasible
  /// Returns the merit of a trial, compared with the original jobs.
  Merit merit(std::size_t trial) const { return merit_of(trials[trial].worst, trials.front().worst); }
};

struct TrialMakers {
  std::function<std::vector<RankingRow>(const Study&)> make_rows;
  std::function<void(const Improvement&)> report;  ///< called after every few trials and short runs
};

/// Runs the search. places: folders of the study of trials. Errors: InputError for a key that cannot be free, or a study whose
/// jobs cannot be read.
Improvement improve(const ImproveRequest& request, const StudyPlaces& places, const TrialMakers& makers);

/// Returns the value of a key in a trial's changes; empty: the trial does not change it.
std::string value_in(const Trial& trial, const std::string& key);

/// Returns the job with the whole error of computed lives, which every change of routing or motion has (Calibration::residual_spread).
/// So the original job has no advantage if a calibration has records of its dresspacks.
std::shared_ptr<const Job> as_candidate(Job job);

/// Returns the study's jobs with changes as candidates, named PREFIX; for several jobs PREFIX_JOB.
std::vector<StudyJob> changed_jobs(const ImproveRequest& request, const std::vector<std::string>& sets,
                                   const std::string& prefix);

/// Returns the best trial of a search that ended early, with the values of its keys.
std::string unfinished_words(const Improvement& improvement);

/// Returns improve.csv, a row per trial: number, feasible, life of the worst job, violated limits, the first mode without a
/// validated law within the robot's life, and the value of each free key.
std::string improvement_csv(const Improvement& improvement);

}  // namespace dresslife::pipeline
