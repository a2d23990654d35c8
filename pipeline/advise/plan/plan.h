// Replacement plan for the dresspacks of a plant.
//
// A plant is one world: one value for each quantity that its dresspacks have in common (friction of the construction, constants
// of the metal, error of the model). In a world dresspacks fail independently, by their individual values (slack, scatter).
// Worlds are sampled from the prior. All dresspacks have survived until today, which is evidence.
// (D3) The weight of a world w is the product over dresspacks i of S_w,i(a_i).
// A calibration with a maintenance system's table includes this evidence already: then all worlds have the same weight.
// S_w,i(a): share of dresspacks under i's duty that reach the age a in the world w. So one dresspack informs about the others,
// and the uncertainty does not shrink with the size of the fleet.
// Few lives of a world are known, and the product would mainly depend on their chance. So S_w comes from the lives of similar
// worlds together (pooled_lives.h, D11).
//
// At a window a dresspack has the age a, and the next window is one interval later. It is replaced in the first window with
//     P(failure in the interval | it lives) > risk, and a new dresspack has less                               (D4)
// or, with costs C_p (planned) and C_u (unplanned), in the first window for which no later time T of replacement costs less:
//     mean over w of (C_u - C_p) P_w(failure before T | it lives) - g_w E_w(hours until T or failure) > 0      (D5)
// for every T from the next window on (stopping problem of the renewal reward theorem; Ross, Stochastic Processes, 3.6). If
// failures become more frequent with age, the next window decides (marginal cost analysis; Berg 1980). g_w: cost
// per hour in the world w of the age replacement with the least mean cost (Barlow and Hunter 1960),
//     g_w = (C_p S_w(T) + C_u (1 - S_w(T))) / integral of S_w from 0 to T, at the T with the least mean over w (D6)
//
// In each draw the life of a dresspack with h_j hours under the duty j before its own duty is
//     sum over j of h_j + (1 - sum over j of h_j / L_j) L hours, if the second sum is below 1                  (D10)
// L_j, L: its lives under these duties alone. If different modes end these lives, their damage is added as if it were one mode.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/fleet.h"
#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// A parameter that dresspacks share, with its value in all worlds.
struct SharedValue {
  std::size_t parameter = 0;  ///< index in uncertain_parameters()
  std::string of;             ///< construction or material that has the parameter; empty: all have it
  std::vector<double> z;      ///< (world)
};

/// Lives of dresspacks under one duty [h of operation].
struct LifeTable {
  std::size_t worlds = 0, draws = 0;
  std::vector<float> hours;  ///< (world, draw), rising in each world; infinite: no damage
  double robot_life_hours = 0;
  double hours_per_week = 0;
  std::vector<SharedValue> shared{};  ///< values on which the lives depend
  /// (draw, world) the same lives; a draw is one dresspack under all duties; empty: `hours` is rising in each world
  std::vector<float> of_draw{};
  std::vector<double> mean_ln{};  ///< (world) m'_w of (D11); empty: the mean of ln of its lives

  /// Returns the life of one dresspack [h].
  double life(std::size_t world, std::size_t draw) const {
    return of_draw.empty() ? hours[world * draws + draw] : of_draw[draw * worlds + world];
  }
  /// Returns the age [h] beyond which nothing influences a decision.
  double horizon() const;
  /// Returns the first life of a world that is longer than an age; the end of the world's lives if none is.
  const float* first_after(std::size_t world, double age) const;
  /// Returns S_w(age).
  double alive(std::size_t world, double age) const;
  /// Returns the median over all worlds [h].
  double median() const;
  /// Returns whether median() is below these hours. Counts, which takes a tenth of the time of a median.
  bool half_end_before(double limit) const;
  /// Returns the larger of horizon() and the median of the finite lives [h].
  double horizon_or_median() const;
  /// Returns the integral of S_w from one age to another [h].
  double running(std::size_t world, double from, double to) const;
};

/// Rule of the decision.
struct PlanRule {
  double risk = 0.1;  ///< (D4)
  bool by_cost = false;
  bool knows_survivors =
      false;  ///< the worlds come from a calibration with these survivors: (D3) would count them twice
  std::vector<double> weights{};  ///< (world) weights of another plan of the same plant; empty: (D3)
  double enough_worlds = 0;  ///< with fewer effective worlds the plan has only its dates, weights and numbers of worlds
};

struct RowPlan {
  double age_hours = 0;                      ///< hours of operation so far, under any duty
  std::shared_ptr<const LifeTable> lives{};  ///< lives of today's dresspack, by its age_hours (first_lives())
  double fails_before_first = 0;             ///< P(failure before the first window)
  /// (week from today) P(failure in this week) of today's dresspack, if it is not replaced
  std::vector<double> fails_in_week;
  /// (window) P(failure from this window to the next one), if the dresspack lives at its begin
  std::vector<double> fails_until_next;
  std::optional<std::size_t> window;  ///< window in which it is replaced; absent: none
  double fails_before = 0;            ///< P(failure before that window, or within the plan)
  double reach_its_age = 0;           ///< P(a new dresspack reaches the age of this one)
};

/// Number of replacements in one year from today: means, and 5 and 95 % of simulated plants.
struct YearOfPlan {
  double planned = 0, unplanned = 0, low = 0, high = 0;
};

struct Plan {
  Day today{}, end{};  ///< begin and end of the plan: the end is the last window plus the interval before it
  std::vector<Window> windows;
  std::vector<RowPlan> rows;
  std::vector<YearOfPlan> years;
  /// (window) planned replacements of dresspacks that are put in after today: mean over simulated plants
  std::vector<double> later_in_window;
  /// (week) failures of all dresspacks; for dresspacks installed later the mean over simulated plants
  std::vector<double> failures_in_week, failures_in_week_without_windows;
  double risk = 0;       ///< risk of the rule (D4)
  bool by_cost = false;  ///< whether (D5) decides
  /// mean over simulated plants: with this plan; and if only failed dresspacks are replaced
  double cost = 0, cost_without_windows = 0;
  std::vector<double> weights;  ///< (world) weights by (D3); their sum is 1
  double effective_worlds = 0;  ///< (sum of weights)^2 / sum of their squares
  double all_alive = 1;         ///< P(all have survived) before the weights of (D3); 1: the weights are given
  double reach_their_age = 0;   ///< mean of RowPlan::reach_its_age
};

/// Fewest effective worlds: percentiles of fewer would depend on chance.
constexpr double fewest_worlds = 20;
/// With fewer effective worlds the plan is repeated with more worlds. With 100 the error of a probability of 10 % is 3 %.
constexpr double enough_worlds = 100;

/// Cost per hour of a policy that replaces at an age or at failure (D6), [1/h].
struct AgeRates {
  Eigen::MatrixXd rate;  ///< (age, world)
  /// Returns, (world), the rates at the age with the least mean.
  Eigen::VectorXd least(const Eigen::VectorXd& weights) const;
};
AgeRates age_rates(const LifeTable& table, double planned_cost, double unplanned_cost);

/// Returns the rows in groups. Those of a group have one duty and equal costs, and so the same age of replacement.
std::vector<std::vector<std::size_t>> rows_of_policies(const Fleet& fleet);

/// Returns the times [days from today] of the windows, then the end of the plan.
std::vector<double> times_of(const std::vector<Window>& windows, Day today);
Day end_of(const std::vector<Window>& windows, Day today);  ///< end of the plan

/// Returns, (row), the lives of today's dresspacks (D10) [h of operation, under all of their duties]. For a dresspack without
/// another duty the result refers to `tables`. Precondition: `tables` outlives the result.
std::vector<std::shared_ptr<const LifeTable>> first_lives(const Fleet& fleet,
                                                          const std::map<std::string, LifeTable>& tables);

/// Sets the ages of a plant's dresspacks under changed duties. A dresspack that is also in `now`, under another duty or with
/// other hours, keeps its damage (D10). With another date of installation it is a new dresspack. from: day on which the other
/// duties and hours begin; the old ones apply until then. Dresspacks of only one table are added or removed today.
void keep_ages(Fleet& changed, const Fleet& now, const std::map<std::string, LifeTable>& tables, Day today, Day from);

/// Returns the hours under its present duty that wear a dresspack as much as its first `age` hours, which may include hours under
/// earlier duties. life: hours until wear ends a dresspack under a duty; infinite: no wear.
double worn_hours(const Installed& row, double age, const std::function<double(const std::string& duty)>& life);

/// Sets the spells of dresspacks whose duty has a history. A history by dates counts from the day on which a dresspack was
/// installed. A history in hours describes the first hours of each dresspack; a warning names a dresspack with fewer hours than
/// its history. tables: must include the duties in histories.
std::vector<Warning> add_histories(Fleet& fleet, const DutyFile& file, const std::map<std::string, LifeTable>& tables,
                                   Day today);

/// Computes the plan. tables: by the names of duties. Preconditions: windows are not empty; every duty has a table; all tables
/// have the same number of worlds.
Plan plan_of(const Fleet& fleet, const std::map<std::string, LifeTable>& tables, const std::vector<Window>& windows,
             Day today, const PlanRule& rule, std::uint64_t seed = 1);

}  // namespace dresslife::pipeline
