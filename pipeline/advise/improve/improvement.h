// A search for jobs that live longer: keys of them are free, the worst of them counts, checks are limits.
//
// Every trial is a set of ordinary jobs of a study, made by the same code as any other: in parallel, cached,
// and found again by a search that was killed. For it everything is a function of its seed and of what the
// jobs said: a second run asks the same, finds what is done done, and goes on where the first ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/improve/freedom.h"
#include "pipeline/advise/improve/outcome.h"
#include "pipeline/advise/improve/screened.h"
#include "pipeline/advise/search/search.h"
#include "pipeline/base/words.h"
#include "pipeline/job/bracket.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

enum class SearchMethod { surrogate, random };
constexpr std::string_view word(SearchMethod value) { return word_at({"surrogate", "random"}, value); }

/// What else is to be small, besides that the life is to be long.
enum class SecondAim { none, hose_length, cycle_time };
constexpr std::string_view word(SecondAim value) {
  return word_at({"none", "hose_length", "cycle_time"}, value);
}

struct ImproveRequest {
  std::filesystem::path file;      ///< a study, whose sections `free` and `limits` count, or a job
  std::vector<std::string> sets;   ///< of every job
  std::vector<std::string> frees;  ///< "KEY.PATH=RANGE", besides those of the study
  int trials = 200;
  int at_a_time = 4;  ///< trials that are asked for together; part of what the search is a function of
  std::uint64_t seed = 1;
  SearchMethod method = SearchMethod::surrogate;
  SecondAim second = SecondAim::none;
  std::optional<double> longest_bracket{};  ///< instead of the jobs' [m]
  int rehearsals =
      -1;  ///< short runs before the first trial, at most; 0: none; -1: 40 times as many as variables
};

/// What was tried.
struct Trial {
  Eigen::VectorXd place;          ///< (variable) 0 .. 1; empty: the jobs as they are, not among what is free
  std::vector<std::string> sets;  ///< of each free key; empty: the jobs as they are
  std::vector<std::string> jobs;  ///< names in the study of trials
  std::vector<Outcome> outcomes;  ///< (job)
  Outcome worst;                  ///< of all jobs
  double hose_length = 0;         ///< of the longest dresspack [m]
  double cycle_seconds = 0;       ///< of all jobs together [s]
  std::string screened;           ///< what geometry has against it; empty: nothing, or it was not asked
};

struct Improvement {
  std::string name;                ///< of the study
  std::vector<std::string> jobs;   ///< of the study, as they are named there
  std::vector<std::string> freed;  ///< key paths
  std::vector<std::string> own;    ///< (freed) the jobs' value; empty: they name none, or not the same
  AskedLimits limits;              ///< that the study asks besides the checks
  /// Unless the study says: of hundreds of trials what their receipts tell, of the few that are told at
  /// length all.
  Keep keep_trials = Keep::lives, keep_finals = Keep::all;
  std::vector<Trial> trials;          ///< in their order, the jobs as they are first
  std::vector<std::size_t> front;     ///< of the feasible, longest life first; with one aim one
  int rehearsals = 0;                 ///< short runs besides
  int most_rehearsals = 0;            ///< before the first trial
  std::vector<std::string> obstacle;  ///< lines on what stands against every trial; empty: some are feasible
  std::optional<std::size_t> best() const;  ///< longest life of the feasible; absent: none is
};

struct TrialMakers {
  std::function<std::vector<RankingRow>(const Study&)> make_rows;
  std::function<void(const Improvement&)> tell;  ///< after every few trials and short runs
};

/// places: of the study of trials. Errors: InputError for what is freed and cannot be; a study whose jobs
/// cannot be read.
Improvement improve(const ImproveRequest& request, const StudyPlaces& places, const TrialMakers& makers);

/// The study's jobs with changes, named PREFIX, or PREFIX_JOB of several.
std::vector<StudyJob> changed_jobs(const ImproveRequest& request, const std::vector<std::string>& sets,
                                   const std::string& prefix);

/// improve.csv: a row per trial: number, feasible, life of the worst job, what is passed, and the value of
/// each free key.
std::string improvement_csv(const Improvement& improvement);

}  // namespace dresslife::pipeline
