// The result of a job for a search: objective and constraints. A failed job is worse than every job that ran; failed jobs are
// ordered by their violation of the geometric limits.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

class Fields;

/// Limits that a user may add to those of the checks: section `limits` of a study.
struct AskedLimits {
  std::optional<double> contact_force;  ///< largest allowed contact force of the dresspack on the robot [N]
  std::optional<double> tension;        ///< largest allowed tension of the hose [N]
  /// Least time until 1 of 10 (for the wall: half) has failed by a mode that the planner's hours do not include [h].
  std::optional<double> abrasion, wall, rating, jacket, corkscrew;
  std::optional<double> kink;          ///< least allowed UnvalidatedMode::margin
  std::optional<double> other_values;  ///< most Outcome::exceeding, if larger than that of the original job [%]
  Where where;
};
void describe(Fields& f, AskedLimits& limits);

/// Checks that the job evaluates every mode that has a limit. Errors: InputError at the limits.
void check_evaluated(const AskedLimits& asked, const RankingRow& row);

/// The limits, in the order of Outcome::beyond. Values are relative: the logarithm of a ratio, or a share of the length or
/// diameter. The last limit, (V7) of the bracket, comes from geometry (screened.h), not from a run.
inline constexpr int outcome_limits = 16;
const std::vector<std::string>& outcome_limit_names();

inline constexpr std::size_t bend_limit = 0;
inline constexpr std::size_t bracket_limit = outcome_limits - 1;

/// Returns the amount by which a limit is exceeded, from Outcome::beyond: "3 %" (of the least radius, life or slack), "0.4 % of
/// the length", "3.2 times the limit". screened: name of the limit in a short run.
std::string passed_text(std::size_t limit, double beyond);
std::string passed_text(const std::string& screened, double beyond);

/// Returns the limits of a short run (screened.h) in the order of Outcome::beyond, from their geometric names; NaN: unknown.
std::vector<double> limits_of_short_run(const std::vector<std::string>& names, const std::vector<double>& beyond);

/// Adds a short run's bends to the pieces of the limits (Candidate::pieces).
void add_bends(std::vector<std::vector<double>>& pieces, const std::vector<double>& bends);

/// Life by a mode that the planner's hours do not include.
struct ModeLife {
  std::string mode;  ///< "abrasion", or "abrasion of DRESSPACK"
  double hours = 0;  ///< UnvalidatedMode::early_hours(); infinite: the mode does not occur
};

struct Outcome {
  std::string failure;                 ///< reason why the job has no life; empty: it has one
  double hours = 0;                    ///< p10 life; infinite without damage
  std::vector<double> beyond;          ///< (limit) <= 0: satisfied; units as ScreenedCandidate::beyond
  std::vector<std::string> reached{};  ///< (limit) "353 mm, at least 600 mm"; empty: not known
  std::vector<ModeLife>
      modes{};  ///< modes that do not contradict a published test (is_credible()), one entry for each name
  double robot_life = std::numeric_limits<double>::infinity();  ///< RankingRow::robot_life_hours
  /// Largest share of such dresspacks that exceed a limit at other values of stiffness, slack or friction. 0: none, or not computed.
  double exceeding = 0;
  double asked_exceeding = 0;  ///< AskedLimits::other_values; 0: absent
  bool feasible() const;       ///< the job is done, and every limit is satisfied
  double violation() const;    ///< sum of the violations

  /// Returns "bend radius violated by 11 % (532 mm, at least 600 mm), ...": violated limits, or the failure; empty: feasible.
  std::string words() const;
};

/// Returns the result of a job in `folder`: checks from the simulation's receipt, life from the row. Only a refusal of the job is
/// a failure. Errors: MachineFault for a job that has no result for another reason, or no receipt;
/// std::logic_error for an unknown check.
Outcome outcome_of(const RankingRow& row, const std::filesystem::path& folder, const AskedLimits& asked = {});

/// Returns the worst of several jobs: shortest lives, largest value of each limit, the first failure.
Outcome worst_of(const std::vector<Outcome>& jobs);

}  // namespace dresslife::pipeline
