// When to replace the dresspacks of a plant.
//
// A plant is one world: a value of everything that its dresspacks have in common (friction of the construction, constants
// of the metal, the model's error). In a world dresspacks fail independently, each by what it has for itself (its slack,
// its scatter). Worlds are drawn from the prior. That every dresspack has survived until today is evidence.
// (D3) The weight of a world w is the product over dresspacks i of S_w,i(a_i).
// A calibration with a maintenance system's table has this evidence already: then all worlds weigh the same.
// S_w,i(a): share of dresspacks of i's duty that reach the age a in the world w. So one dresspack informs the others, and
// the uncertainty does not shrink with the size of the fleet.
//
// A dresspack at a window has the age a, and the next window is an interval later. It is replaced in the first window with
//     P(failure in the interval | it lives) > risk, and a new dresspack has less                               (D4)
// or, with costs C_p (planned) and C_u (unplanned), in the first at which no later time T to replace it costs less:
//     mean over w of (C_u - C_p) P_w(failure before T | it lives) - g_w E_w(hours until T or failure) > 0      (D5)
// for every T from the next window on, as the stopping problem of the renewal reward theorem (Ross, Stochastic Processes,
// 3.6). Where failures grow more frequent with age, the next window decides (marginal cost analysis; Berg 1980). g_w: cost
// per hour in the world w of the age replacement with the least mean cost (Barlow and Hunter 1960),
//     g_w = (C_p S_w(T) + C_u (1 - S_w(T))) / integral of S_w from 0 to T, at the T with the least mean over w (D6)
//
// In each draw a dresspack lives, with h_j hours under the duty j before its own,
//     sum over j of h_j + (1 - sum over j of h_j / L_j) L hours, where the second sum is below 1               (D10)
// L_j, L: its lives under these duties alone. Where different modes end them, the damage of both counts as that of one mode.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/advise/plan/fleet.h"
#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// A parameter that dresspacks share, in all worlds.
struct SharedValue {
  std::size_t parameter = 0;  ///< of uncertain_parameters()
  std::string of;             ///< the construction or material that has it; empty: everything
  std::vector<double> z;      ///< (world)
};

/// Lives of dresspacks under one duty [h of operation].
struct LifeTable {
  std::size_t worlds = 0, draws = 0;
  std::vector<float> hours;  ///< (world, draw), rising in each world; infinite: no damage
  double robot_life_hours = 0;
  double hours_per_week = 0;
  std::vector<SharedValue> shared{};  ///< what its lives depend on
  std::vector<float> of_draw{};       ///< (draw, world) the same lives. A draw is one dresspack under all duties. Empty: the draws rise in each world

  /// [h] of one dresspack
  double life(std::size_t world, std::size_t draw) const { return of_draw.empty() ? hours[world * draws + draw] : of_draw[draw * worlds + world]; }
  /// Ages [h] beyond it decide nothing.
  double horizon() const;
  /// The first life of a world that is longer than an age; the end of the world's lives if none is.
  const float* first_after(std::size_t world, double age) const;
  /// S_w(age)
  double alive(std::size_t world, double age) const;
  /// Over all worlds [h].
  double median() const;
  /// Integral of S_w from one age to another [h].
  double running(std::size_t world, double from, double to) const;
};

/// How to decide.
struct PlanRule {
  double risk = 0.1;  ///< (D4)
  bool by_cost = false;
  bool knows_survivors = false;  ///< the worlds are drawn from a calibration to which they belong: (D3) would count them twice
  std::vector<double> weights{};  ///< (world) of another plan of the same plant; empty: (D3)
};

struct RowPlan {
  double age_hours = 0;                  ///< of operation so far, under any duty
  std::shared_ptr<const LifeTable> lives{};  ///< of today's dresspack, by its age_hours (first_lives())
  double fails_before_first = 0;         ///< before the first window
  std::vector<double> fails_in_week;     ///< (week from today) P(failure in it) of today's dresspack, if it is not replaced
  std::vector<double> fails_until_next;  ///< (window) from it to the next one, if the dresspack lives then
  std::optional<std::size_t> window;     ///< in which it is replaced; absent: in none of them
  double fails_before = 0;               ///< before that window, or within the plan
  double reach_its_age = 0;              ///< P(a new dresspack reaches the age of this one)
};

/// Replacements in one year from today: mean, and 5 and 95 % of simulated plants.
struct YearOfPlan {
  double planned = 0, unplanned = 0, low = 0, high = 0;
};

struct Plan {
  Day today{}, end{};  ///< of the plan: the last window, and the interval before it once more
  std::vector<Window> windows;
  std::vector<RowPlan> rows;
  std::vector<YearOfPlan> years;
  std::vector<double> failures_in_week, failures_in_week_without_windows;  ///< (week) of all; of later ones the mean over simulated plants
  double risk = 0;                                                         ///< of the rule (D4)
  bool by_cost = false;                                                    ///< (D5)
  double cost = 0, cost_without_windows = 0;  ///< mean over simulated plants: by this plan; if only failures are replaced
  std::vector<double> weights;                ///< (world) (D3), their sum is 1
  double effective_worlds = 0;                ///< (sum of weights)^2 / sum of their squares
  double all_alive = 1;        ///< P(all have survived) before the weights of (D3); 1: they are not of this fleet
  double reach_their_age = 0;  ///< mean of RowPlan::reach_its_age
};

/// Fewer are no sample: percentiles would rest on chance.
constexpr double fewest_worlds = 20;
/// With fewer the plan is made again from more worlds: a probability of 10 % is known to 3 %.
constexpr double enough_worlds = 100;

/// Cost per hour of replacement at an age or at failure (D6), [1/h].
struct AgeRates {
  Eigen::MatrixXd rate;  ///< (age, world)
  /// (world) of the age with the least mean.
  Eigen::VectorXd least(const Eigen::VectorXd& weights) const;
};
AgeRates age_rates(const LifeTable& table, double planned_cost, double unplanned_cost);

/// Times [days from today] of the windows, then the end of the plan.
std::vector<double> times_of(const std::vector<Window>& windows, Day today);

/// (row) Lives of today's dresspacks (D10) [h of operation, under all of their duties]. Those of `tables`, which must outlive them, where
/// a dresspack has had no other duty.
std::vector<std::shared_ptr<const LifeTable>> first_lives(const Fleet& fleet, const std::map<std::string, LifeTable>& tables);

/// The dresspacks of a plant under other duties: one that is in `now`, too, under another duty or for other hours, keeps its damage (D10).
/// A date of its own makes it a new dresspack. from: day on which the other duties and hours begin; the old ones count until then.
/// Dresspacks of one table only come or go today.
void keep_ages(Fleet& changed, const Fleet& now, const std::map<std::string, LifeTable>& tables, Day today, Day from);

/// The spells of dresspacks whose duty has a history. A history by dates counts from the day on which a dresspack was installed. One in hours has the first hours of each; a warning
/// names a dresspack that has run less. tables: also of the duties in histories.
std::vector<Warning> add_histories(Fleet& fleet, const DutyFile& file, const std::map<std::string, LifeTable>& tables, Day today);

/// Plan::effective_worlds of plan_of().
double effective_worlds(const Fleet& fleet, const std::map<std::string, LifeTable>& tables, Day today, const PlanRule& rule);

/// tables: by the names of duties. Precondition: windows are not empty, every duty has a table, all of as many worlds.
Plan plan_of(const Fleet& fleet, const std::map<std::string, LifeTable>& tables, const std::vector<Window>& windows, Day today,
             const PlanRule& rule, std::uint64_t seed = 1);

}  // namespace dresslife::pipeline
