// How a job turned out for a search: what it aims at, and how far it is beyond each limit. A job that failed
// has a place, too: so much worse than the worst that ran as geometry says that it is wrong.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

class Fields;

/// Limits that a user may add to those of the checks: the section `limits` of a study.
struct AskedLimits {
  std::optional<double> contact_force;  ///< largest of the dresspack on the robot [N]
  std::optional<double> tension;        ///< largest of the hose [N]
};
void describe(Fields& f, AskedLimits& limits);

/// The limits, in the order of Outcome::beyond. Relative: how many times, or which share of the length or diameter. The
/// last one, (V7) of the bracket, comes from geometry (screened.h); a run does not see it.
inline constexpr int outcome_limits = 9;
const std::vector<std::string>& outcome_limit_names();

inline constexpr std::size_t bracket_limit = outcome_limits - 1;

/// The same of a short run (screened.h), whose limits have the names of those of geometry; not a number where
/// it knows nothing.
std::vector<double> limits_of_rehearsal(const std::vector<std::string>& names,
                                        const std::vector<double>& beyond);

/// Adds to the pieces of limits (Look::pieces) a short run's bends.
void add_bends(std::vector<std::vector<double>>& pieces, const std::vector<double>& bends);

struct Outcome {
  std::string failure;         ///< why there is no life; empty: there is one
  double hours = 0;            ///< planner's life in 10 % of dresspacks; infinite without damage
  std::vector<double> beyond;  ///< (limit) <= 0: kept; as ScreenedCandidate::beyond is graded
  bool feasible() const;       ///< done, and every limit is kept
  double violation() const;    ///< sum of what is beyond

  /// "bend radius by 0.12, ...": what is passed, or the failure; empty: feasible.
  std::string words() const;
};

/// Of a job that ran in `folder`: its checks from the simulation's receipt, its life from the row. A receipt
/// that cannot be read is a failure, a check that nobody knows our fault (std::logic_error).
Outcome outcome_of(const RankingRow& row, const std::filesystem::path& folder, const AskedLimits& asked = {});

/// The worst of several jobs: least life, most of each limit, the first failure.
Outcome worst_of(const std::vector<Outcome>& jobs);

}  // namespace dresslife::pipeline
