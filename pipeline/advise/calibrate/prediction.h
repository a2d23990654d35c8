// Predictions of a test over samples of the uncertain parameters.
#pragma once

#include <Eigen/Core>
#include <array>

#include "pipeline/advise/calibrate/emulation.h"
#include "pipeline/advise/calibrate/posterior.h"

namespace dresslife::pipeline {

/// Quantiles of a life or a number: 10, 50, 90 %. A life without damage is infinite.
using PredictedDeciles = std::array<double, 3>;

/// Return samples of all parameters, (draw, parameter; last the spread between dresspacks): from the prior, with the spread 1;
/// from the posterior, with the prior for the others.
Eigen::MatrixXd prior_draws(const Axes& axes);
Eigen::MatrixXd posterior_draws(const Posterior& posterior, const Axes& axes);
/// Returns the samples with OwnSpread::factor as the spread of all: predictions of new dresspacks use it, as jobs do.
Eigen::MatrixXd with_one_spread(Eigen::MatrixXd draws);

/// Returns deciles over samples and variants. For a life: life of one specimen with its scatter, in the observer's unit. For a
/// bending test: moment at its largest curvature [N m], or stiffness [N m2]. weighed: variants are weighted by their likelihood
/// in each sample; else equally.
PredictedDeciles predicted_deciles(const EmulatedTest& test, const Eigen::MatrixXd& draws, bool weighed);

/// Returns the deviation between the measured numbers of a bending test and the sample and variant that fit them best: root mean
/// square, in standard deviations of their noise.
double least_misfit(const EmulatedTest& test, const Eigen::MatrixXd& draws);
/// Returns the value that least_misfit of correct measurements exceeds as rarely as one number exceeds three standard deviations
/// (1 of 370).
double usual_misfit(const EmulatedTest& test);

/// Probability of the records of dresspacks in service, means over samples. The number of failures has a Poisson distribution
/// with the mean sum of ln S(e) - ln S(x), of (P5).
struct ServiceChance {
  double few = 1, many = 1;  ///< P(as many failures as in the records or fewer), P(as many or more)
  /// P(a new dresspack reaches the age e), mean over the dresspacks in use at the begin of the records; 1: none
  double reach = 1;
};
/// Precondition: life.service was made from these records.
ServiceChance service_chance(const ObservedLife& life, const std::vector<ServiceRecord>& records,
                             const Eigen::MatrixXd& draws);

}  // namespace dresslife::pipeline
