// The result of a job for a search: objective and constraints. A job that failed is worse than the worst that ran, by
// its violation of the geometric limits.
#pragma once

#include <limits>
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
  /// Least hours until 1 of 10 has failed by a mode that the planner's hours leave out; of the wall, half [h].
  std::optional<double> abrasion, wall, rating, jacket, corkscrew;
  std::optional<double> kink;  ///< least UnvalidatedMode::margin
  Where where;
};
void describe(Fields& f, AskedLimits& limits);

/// Errors: InputError at the limits for a mode that has a limit and that the job does not evaluate.
void check_evaluated(const AskedLimits& asked, const RankingRow& row);

/// The limits, in the order of Outcome::beyond. Relative: as logarithm of a ratio, or as share of the length or
/// diameter. The last one, (V7) of the bracket, comes from geometry (screened.h), not from a run.
inline constexpr int outcome_limits = 15;
const std::vector<std::string>& outcome_limit_names();

inline constexpr std::size_t bend_limit = 0;
inline constexpr std::size_t bracket_limit = outcome_limits - 1;

/// How far a limit is passed, from Outcome::beyond: "3 %", of the least radius, life or slack, "0.4 % of the length", "3.2 times the
/// limit". screened: its name in a short run.
std::string passed_text(std::size_t limit, double beyond);
std::string passed_text(const std::string& screened, double beyond);

/// The same of a short run (screened.h), whose limits have the names of the geometric ones; NaN: unknown.
std::vector<double> limits_of_rehearsal(const std::vector<std::string>& names,
                                        const std::vector<double>& beyond);

/// Adds to the pieces of limits (Candidate::pieces) a short run's bends.
void add_bends(std::vector<std::vector<double>>& pieces, const std::vector<double>& bends);

/// A mode that the planner's hours leave out.
struct ModeLife {
  std::string mode;  ///< "abrasion", or "abrasion of DRESSPACK"
  double hours = 0;  ///< UnvalidatedMode::early_hours(); infinite: never
};

struct Outcome {
  std::string failure;                 ///< why there is no life; empty: there is one
  double hours = 0;                    ///< p10 life; infinite without damage
  std::vector<double> beyond;          ///< (limit) <= 0: satisfied; units as ScreenedCandidate::beyond
  std::vector<std::string> reached{};  ///< (limit) "353 mm, at least 600 mm"; empty: not known
  std::vector<ModeLife>
      modes{};  ///< that do not contradict a published test (is_credible()), one entry for each name
  double robot_life = std::numeric_limits<double>::infinity();  ///< RankingRow::robot_life_hours
  bool feasible() const;                                        ///< done, and every limit is satisfied
  double violation() const;                                     ///< sum of the violations

  /// "bend radius passed by 11 % (532 mm, at least 600 mm), ...": violated limits, or the failure; empty: feasible.
  std::string words() const;
};

/// Result of a job in `folder`: checks from the simulation's receipt, life from the row. Only a refusal of the job is a
/// failure. Errors: MachineFault for a job without a result for another reason, or without the receipt;
/// std::logic_error for an unknown check.
Outcome outcome_of(const RankingRow& row, const std::filesystem::path& folder, const AskedLimits& asked = {});

/// The worst of several jobs: shortest lives, largest value of each limit, the first failure.
Outcome worst_of(const std::vector<Outcome>& jobs);

}  // namespace dresslife::pipeline
