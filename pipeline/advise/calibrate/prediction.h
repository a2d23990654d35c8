// Predictions of a test over samples of the uncertain parameters.
#pragma once

#include <Eigen/Core>
#include <array>

#include "pipeline/advise/calibrate/emulation.h"
#include "pipeline/advise/calibrate/posterior.h"

namespace dresslife::pipeline {

/// Quantiles of a life or a number: 10, 50, 90 %. A life without damage is infinite.
using PredictedDeciles = std::array<double, 3>;

/// Samples of all parameters, (draw, parameter): of the prior, or of the posterior with the prior of the others.
Eigen::MatrixXd prior_draws();
Eigen::MatrixXd posterior_draws(const Posterior& posterior, const Axes& axes);

/// Over samples and variants: life of one specimen with its scatter, in the observer's unit; of a bending test the
/// moment at its largest curvature [N m], or the stiffness [N m2]. weighed: variants are weighted by their likelihood
/// in each sample; else equally.
PredictedDeciles predicted_deciles(const EmulatedTest& test, const Eigen::MatrixXd& draws, bool weighed);

/// How likely the records of dresspacks in service are, means over samples. Their number of failures is Poisson's with the mean
/// sum of ln S(e) - ln S(x), of (P5).
struct ServiceChance {
  double few = 1, many = 1;  ///< P(as many failures as in the records or fewer), P(as many or more)
  double reach = 1;          ///< P(a new dresspack reaches the age e), mean over those that the records begin with; 1: none
};
/// Precondition: life.service is of these records.
ServiceChance service_chance(const ObservedLife& life, const std::vector<ServiceRecord>& records, const Eigen::MatrixXd& draws);

}  // namespace dresslife::pipeline
