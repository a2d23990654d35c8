// Posterior of a standard normal prior, z ~ N(0, 1) along each axis: its maximum, the normal approximation at the maximum
// (Laplace), and samples.
//
// Newton's method with finite differences and Levenberg's damping finds the maximum. Likelihoods of censored lives and
// mixtures are no sums of squares, so least-squares solvers do not apply.
//
// The samples come from adaptive Metropolis (Haario, Saksman, Tamminen 2001): four chains from four sides of the maximum, with
// steps of 2.38/sqrt(d) times the covariance of the samples so far, which is fixed after the warm-up. Chains that disagree
// (split R-hat, Gelman et al., Bayesian Data Analysis, 11.4) are continued, at most twice. The seed is fixed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"

namespace dresslife::pipeline {

/// Returns ln of the ratio of a prior N(0, deviation^2) along each axis to the standard normal prior, up to a constant: a term of
/// posterior_of(). Precondition: deviations > 0.
LogLikelihood prior_of_deviations(const Eigen::VectorXd& deviations);

/// Returns ln of prior times likelihoods, up to a constant.
double log_posterior(const std::vector<LogLikelihood>& terms, const Eigen::VectorXd& z);

struct Laplace {
  Eigen::VectorXd most_likely;
  Eigen::MatrixXd covariance;  ///< inverse of the curvature at the maximum; identity if the curvature has no inverse
  bool converged = false;
};
Laplace laplace_of(const std::vector<LogLikelihood>& terms, const Eigen::VectorXd& start);

struct SamplerSettings {
  int draws = 12000;  ///< per chain, after a warm-up of a third of this number
  std::uint64_t seed = 1;
};

struct Posterior {
  Laplace laplace;
  Eigen::MatrixXd draws;  ///< (draw, axis), one chain after the other
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd median, low, high;  ///< (axis) quantiles 50, 10 and 90 %
  double chains_disagree = 1;         ///< largest split R-hat of all axes; 1: the chains agree
  double worth = 0;                   ///< effective sample size of the worst axis
};

/// Computes the posterior. start: first place of the search for the maximum. Precondition: at least one axis.
Posterior posterior_of(const std::vector<LogLikelihood>& terms, const Eigen::VectorXd& start,
                       const SamplerSettings& settings = {});

/// Computes mean, covariance, quantiles and agreement of the chains from the draws.
void summarise(Posterior& posterior);

/// Returns the quantile of `share`, 0 .. 1, interpolated.
double quantile(std::vector<double> numbers, double share);

}  // namespace dresslife::pipeline
