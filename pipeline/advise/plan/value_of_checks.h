// The value of visual checks for abrasion to a plan, in money. Other modes are not visible before they count as failures
// (pipeline/job/inspection.h). No test validates abrasion, and the cost of the plan does not include its failures.
//
// Under its duty, abrasion ends dresspack i at the age T_i(z) = T_50 10^(s z). z is one standard normal number for the plant,
// because the wear rate of a pair of materials causes most of the scatter s. All dresspacks have survived until their ages a_i,
// the worn_hours() of their hours under all duties, so z > max over i of log10(a_i / T_50) / s. A check can see the wear from the
// age v T on and finds it with the probability p. A dresspack with wear is replaced at the cost C_p before it fails at the cost C_u.
// l(t): share of the dresspacks whose wires live until t.
//
// One check today, without later checks, has a value if the wear would end the dresspack within the H hours until the window of
// its replacement or the end of the plan:
//     p max(0, mean over z, of those with v T <= a, of (C_u - C_p) l(T) if T <= a + H, else -C_n)                     (D9)
// C_n: C_p, which is spent too early; 0 if the plan replaces the dresspack in a window anyway. The remaining life of
// a replaced dresspack and the information of the result about other dresspacks are left out.
// Checks every tau hours: the mean over z of (C_u - C_p) times the sum of (F32) over the failures until the end of the plan, of
// the dresspack, with l(T), and of its successors. W = (1 - v) T; for wear that is already visible, W is the hours that remain.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/plan/plan.h"
#include "pipeline/job/inspection.h"

namespace dresslife::pipeline {

/// Abrasion under one duty.
struct AbrasionLife {
  double early = 0, median = 0;  ///< hours by which 1 of 10, and half, have failed; infinite: nothing rubs
  double visible_from = 0;       ///< v
  Inspection inspection;         ///< checks of its jobs
};

struct CheckValue {
  double today = 0;    ///< value of one check of this dresspack today, in the unit of the costs
  double regular = 0;  ///< value of its checks until the end of the plan
  double fails = 0;    ///< expected failures by abrasion until the end of the plan, without checks
  double found = 0;    ///< number of these failures that checks find before they occur
};

/// Returns the share of the dresspacks whose wires live `hours` from today.
double wires_live(const RowPlan& row, double hours, double hours_per_week);

/// Returns the values, (row of the fleet). lives: by duties, also earlier ones; without an entry: nothing rubs. plan: plan of
/// this fleet. Absent: in fewer than 1 in 1,000 plants with this abrasion all dresspacks live today.
std::optional<std::vector<CheckValue>> values_of_checks(const Fleet& fleet,
                                                        const std::map<std::string, LifeTable>& tables,
                                                        const std::map<std::string, AbrasionLife>& lives,
                                                        const Plan& plan);

}  // namespace dresslife::pipeline
