// What the model foretells of a test over draws of what is not known.
#pragma once

#include <Eigen/Core>
#include <array>

#include "pipeline/advise/calibrate/emulation.h"
#include "pipeline/advise/calibrate/posterior.h"

namespace dresslife::pipeline {

/// A life or a number by its distribution: 10, 50, 90 %. A life without damage is infinite.
using Foretold = std::array<double, 3>;

/// Draws of all parameters, (draw, parameter): of the prior, or of what was learned beside a prior of the
/// others.
Eigen::MatrixXd prior_draws();
Eigen::MatrixXd posterior_draws(const Posterior& posterior, const Axes& axes);

/// Over draws and variants: of one specimen's life with its scatter, in the observer's unit; of a bending
/// test the moment at its largest curvature, or the stiffness [N m], [N m2]. weighed: a variant counts by how
/// likely it makes the observation in each draw; else all count alike.
Foretold foretold(const EmulatedTest& test, const Eigen::MatrixXd& draws, bool weighed);

}  // namespace dresslife::pipeline
