// Comparison of the records of dresspacks in service with their prediction after the calibration (posterior predictive check).
//
// Kaplan-Meier: the share that has not failed at the age t is the product of 1 - d/n over all ages x <= t at which d dresspacks
// failed; n: dresspacks that are older than x or fail at x, and were younger than x when the records began.
//
// Let S(x) be the share of dresspacks that the parameters z predict to reach the age x (likelihood.h), and H = -ln S. If z is
// true, H of a failure has the hazard rate 1. A Weibull distribution of H has the hazard rate a b H^(b - 1). Records with
// a > 1 fail earlier than predicted. Those with b > 1 differ less from each other. With the likelihood ratio
//     R(z) = L(1, 1) / largest of L(a, b),
// -2 ln R has a chi-squared distribution with two degrees of freedom for many failures, so P(R <= r) = r. The probability of the
// records is the mean of R(z) over samples z of the posterior. If prior and model are true, at most 2 % of plants are below a
// level of 1 % (Meng 1994); measured in simulated plants: 0.5 % (service_fit_test.cpp), because the posterior is near
// the records.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"
#include "pipeline/advise/calibrate/observations.h"

namespace dresslife::pipeline {

/// Ages by which a tenth and half have failed, by Kaplan-Meier.
struct ObservedAges {
  static constexpr std::size_t fewest = 5;  ///< dresspacks without failure that an estimate needs
  /// [h] younger dresspacks are fewer than `fewest`: the shares are of dresspacks that reached this age
  double from = 0;
  double until = 0;                       ///< [h] older dresspacks are fewer than `fewest`
  double failed_until = 0;                ///< share that has failed until then
  std::optional<double> tenth{}, half{};  ///< [h] absent: not reached before `until`
};
/// Absent: fewer than `fewest` dresspacks were in use at one age.
std::optional<ObservedAges> observed_ages(const std::vector<ServiceRecord>& records);
/// Returns "10 % had failed by 4,200 h, half by 9,000 h".
std::string words_of(const ObservedAges& ages);

struct ServiceFit {
  std::optional<ObservedAges> observed{};
  double chance = 1;           ///< mean of R(z); 1: too few failures
  double rate = 1, shape = 1;  ///< a and b, geometric means over the samples
  double predicted_tenth = 0,
         predicted_half = 0;  ///< predicted share of failures until observed->tenth and observed->half
};
/// Least probability of the records that is no contradiction.
constexpr double least_service_chance = 0.01;
/// Returns the comparison. draws: samples of the posterior, (sample, parameter). A few hundred of them are used.
ServiceFit service_fit(const ObservedLife& life, const std::vector<ServiceRecord>& records,
                       const Eigen::MatrixXd& draws);

}  // namespace dresslife::pipeline
