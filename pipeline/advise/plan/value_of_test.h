// The value of a test of a shared parameter to a plan, in money, before its result is known (preposterior analysis; Raiffa and
// Schlaifer 1961).
//
// A test of the parameter z has the result y = z + an error. Its results are put into bins of equal probability. In the world w
// the bin j has the probability P(j | w), a difference of normal shares. After this result the world has the weight P(j | w) W_w.
// A dresspack is replaced at the time T or at failure, its successors at the age A or at failure. Then its cost until the end of
// the plan is:
//     c_w(T, A) = C_p + (C_u - C_p) P_w(failure before T) + g_w(A) E_w(hours from T or failure to the end)
//                 - min over A' of g_w(A') E_w(hours from the end to T or failure)                                     (D7)
// g_w: (D6). All terms assume that the dresspack lives today. The last term is the value of a dresspack that outlives the plan.
// The value of the test is:
//     sum over dresspacks of min over T of sum_w W_w c_w(T, A) - sum over j of min over T, A of sum_w W_w P(j | w) c_w(T, A).
// Before the result A is the age of (D6). After it, A is the same or the age of (D6) with the new weights, so no result makes a
// plan more expensive. Bins lose a part of the information, so the value is a lower bound.
//
// The worlds are a sample, so the values of a parameter also explain by chance a part of the lives that do not depend on it. A
// value counts if it is larger than those of the same parameter in random orders of the worlds.
#pragma once

#include <vector>

#include "pipeline/advise/plan/plan.h"

namespace dresslife::pipeline {

/// Share of a plan's cost. A test that saves less is of no interest.
inline constexpr double least_saving = 1e-3;

struct TestValue {
  SharedValue what;
  double saves = 0;  ///< expected saving, in the unit of the costs
  /// mean and three standard deviations of `saves` of the same values in random orders of the worlds, on which no life depends
  double by_chance = 0;
};

/// Returns the value of a test of this parameter with a normally distributed error, in z. plan: by cost, of this fleet.
double value_of_test(const SharedValue& what, double error, const Fleet& fleet,
                     const std::map<std::string, LifeTable>& tables, const Plan& plan);

/// Returns the value of the test of each parameter on which the tables depend, with the error of
/// UncertainParameter::test_deviation; the largest first.
std::vector<TestValue> values_of_tests(const Fleet& fleet, const std::map<std::string, LifeTable>& tables,
                                       const Plan& plan);

}  // namespace dresslife::pipeline
