// What observations leave of a standard normal prior, z ~ N(0, 1) along each axis: its most likely place, the
// normal distribution that fits there (Laplace), and draws.
//
// The maximum by Newton's method with differences, damped after Levenberg. Neither sums of squares nor many
// variables: a dozen variables, likelihoods of what had not yet failed, mixtures. So a page of Eigen, and no
// solver of least squares.
//
// Draws by adaptive Metropolis (Haario, Saksman, Tamminen 2001): four chains from four sides of the maximum,
// steps of 2.38/sqrt(d) in the shape of what was drawn so far, which is fixed when the draws that count
// begin. Chains that do not agree (split R-hat, Gelman et al., Bayesian Data Analysis, 11.4) are drawn
// longer, twice at most. The same numbers come out every time.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"

namespace dresslife::pipeline {

/// ln of prior times likelihoods, up to a constant.
double log_posterior(const std::vector<LogLikelihood>& terms, const Eigen::VectorXd& z);

struct Laplace {
  Eigen::VectorXd most_likely;
  Eigen::MatrixXd covariance;  ///< the inverse of the curvature there; the identity where it has none
  bool converged = false;
};
Laplace laplace_of(const std::vector<LogLikelihood>& terms, const Eigen::VectorXd& start);

struct SamplerSettings {
  int draws = 12000;  ///< of each of the four chains, after a third as many that only shape the steps
  std::uint64_t seed = 1;
};

struct Posterior {
  Laplace laplace;
  Eigen::MatrixXd draws;  ///< (draw, axis), one chain after the other
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd median, low, high;  ///< (axis) 50, 10 and 90 % of the draws
  double chains_disagree = 1;         ///< largest split R-hat of all axes; 1: not at all
  double worth = 0;                   ///< independent draws that say as much of the worst axis
};

/// axes: > 0. start: where to look for the maximum.
Posterior posterior_of(const std::vector<LogLikelihood>& terms, const Eigen::VectorXd& start,
                       const SamplerSettings& settings = {});

/// By which `share` of numbers lie below, 0 .. 1, between neighbours.
double quantile(std::vector<double> numbers, double share);

}  // namespace dresslife::pipeline
