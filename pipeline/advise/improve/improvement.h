// A search for better jobs. Its variables are the free keys, its objective is the order of merit.h for the worst job, its
// constraints are the checks.
//
// Every trial is a set of ordinary jobs of a study: they run in parallel and are cached. A trial is a function of the
// seed and of the results before it. Therefore a second run repeats no finished job and continues where the first
// ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
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

enum class SearchMethod { surrogate, random };
constexpr std::string_view word(SearchMethod value) { return word_at({"surrogate", "random"}, value); }

/// The second objective, beside a long life.
enum class SecondAim { none, hose_length, cycle_time };
constexpr std::string_view word(SecondAim value) {
  return word_at({"none", "hose_length", "cycle_time"}, value);
}

struct ImproveRequest {
  std::filesystem::path file;      ///< a study, whose sections `free` and `limits` count, or a job
  std::vector<std::string> sets;   ///< of every job
  std::vector<std::string> frees;  ///< "KEY.PATH=RANGE", besides those of the study
  int trials = 200;
  int at_a_time = 4;  ///< trials that are proposed together; the search depends on it
  std::uint64_t seed = 1;
  SearchMethod method = SearchMethod::surrogate;
  SecondAim second = SecondAim::none;
  std::optional<double> longest_bracket{};  ///< instead of the jobs' [m]
  int rehearsals =
      -1;  ///< short runs before the first trial, at most; 0: none; -1: 40 times as many as variables
};

/// A candidate and its results.
struct Trial {
  Eigen::VectorXd place;          ///< (variable) 0 .. 1; empty: the original jobs, outside the ranges
  std::vector<std::string> sets;  ///< of each free key; empty: the original jobs
  std::vector<std::string> jobs;  ///< names in the study of trials
  std::vector<Outcome> outcomes;  ///< (job)
  Outcome worst;                  ///< of all jobs
  double hose_length = 0;         ///< of the longest dresspack [m]
  double cycle_seconds = 0;       ///< of all jobs together [s]
  std::string relief_refusal;     ///< what its bend relief makes fail earlier, which is also its failure; empty: nothing
  bool breaks_beside_clamp = false;  ///< of some job (reliefs.h)
  std::string screened;           ///< limits that geometry rejects it for; empty: none, or not screened
};

struct Improvement {
  std::string name;                ///< of the study
  std::vector<std::string> jobs;   ///< of the study, as they are named there
  std::vector<std::string> freed;  ///< key paths
  std::vector<std::string> own;    ///< (freed) the jobs' value; empty: they name none, or not the same
  AskedLimits limits;              ///< of the study, beside the checks
  /// Default: only the receipts of the trials, all files of the best few.
  Keep keep_trials = Keep::lives, keep_finals = Keep::all;
  std::vector<Trial> trials;          ///< in their order, the original jobs first
  std::vector<std::size_t> front;     ///< Pareto-optimal and feasible, the best by merit first
  int rehearsals = 0;                 ///< short runs
  int most_rehearsals = 0;            ///< before the first trial
  std::vector<std::string> obstacle;  ///< lines: why no trial is feasible; empty: some are
  std::string ended;  ///< message: a file changed, which ended the search early; empty: none did
  std::optional<std::size_t> best() const;  ///< of the feasible, by merit; absent: none is
  /// Of a trial, beside the job as it is.
  Merit merit(std::size_t trial) const { return merit_of(trials[trial].worst, trials.front().worst); }
};

struct TrialMakers {
  std::function<std::vector<RankingRow>(const Study&)> make_rows;
  std::function<void(const Improvement&)> tell;  ///< after every few trials and short runs
};

/// places: of the study of trials. Errors: InputError for a key that cannot be free; a study whose jobs cannot be
/// read.
Improvement improve(const ImproveRequest& request, const StudyPlaces& places, const TrialMakers& makers);

/// The value of a key in a trial's changes; empty: it has none.
std::string value_in(const Trial& trial, const std::string& key);

/// The study's jobs with changes, named PREFIX, or PREFIX_JOB of several.
std::vector<StudyJob> changed_jobs(const ImproveRequest& request, const std::vector<std::string>& sets,
                                   const std::string& prefix);

/// The best trial of a search that ended early, and its keys.
std::string unfinished_words(const Improvement& improvement);

/// improve.csv: a row per trial: number, feasible, life of the worst job, violated limits, the first mode without a validated law in the
/// robot's life, and the value of each free key.
std::string improvement_csv(const Improvement& improvement);

}  // namespace dresslife::pipeline
