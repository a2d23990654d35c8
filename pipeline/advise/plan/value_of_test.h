// What a test of a shared parameter is worth to a plan, in money, before its result is known (preposterior analysis; Raiffa and
// Schlaifer 1961).
//
// A test of the parameter z has the result y = z + an error. Its results are put into bins of equal probability. In the world w
// the bin j has the probability P(j | w), a difference of normal shares, and the world weighs P(j | w) W_w after it. A dresspack
// that is replaced at the time T or at failure, and its successors at the age A or at failure, cost until the end of the plan
//     c_w(T, A) = C_p + (C_u - C_p) P_w(failure before T) + g_w(A) E_w(hours from T or failure to the end)
//                 - min over A' of g_w(A') E_w(hours from the end to T or failure)                                     (D7)
// g_w: (D6). All is given that it lives. A dresspack that outlives the plan keeps its worth: the last line. The value of the test is
//     sum over dresspacks of min over T of sum_w W_w c_w(T, A) - sum over j of min over T, A of sum_w W_w P(j | w) c_w(T, A).
// A before the result is the age of (D6). After it, it is the same or that of (D6) at the new weights, so that no result makes a plan
// dearer. Bins lose some of the result: the value is a lower bound.
#pragma once

#include <vector>

#include "pipeline/advise/plan/plan.h"

namespace dresslife::pipeline {

struct TestValue {
  SharedValue what;
  double saves = 0;  ///< expected, in the unit of the costs
};

/// By a test of this value with an error of a normal distribution, in z. plan: by cost, of this fleet.
double value_of_test(const SharedValue& what, double error, const Fleet& fleet,
                     const std::map<std::string, LifeTable>& tables, const Plan& plan);

/// Of the test of each parameter that the tables depend on, with the error of UncertainParameter::test_deviation; the largest first.
std::vector<TestValue> values_of_tests(const Fleet& fleet, const std::map<std::string, LifeTable>& tables,
                                       const Plan& plan);

}  // namespace dresslife::pipeline
