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

}  // namespace dresslife::pipeline
