// The spread between dresspacks in service, learned from their records: a factor f of the deviations of all individual values
// (slack, grip, rest, motion, and the residual of computed lives). The scatter of wires is a parameter of its own.
//
// ln f has the prior N(-s^2, s^2). Its mean of f^2 is 1, so records without information leave the variance of a job as it is. The
// standardised value z = (ln f + s^2)/s is one more axis of the posterior, behind the parameters. All predictions of new
// dresspacks, and jobs with the calibration, use one value: the root of the posterior mean of f^2, which keeps the variance.
// For jobs with another motion or routing f does not reduce the residual: that the dresspacks of one job live equally long says
// nothing about the error of the computed life of another job.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

/// Index of z in vectors of all parameters; their size is uncertain_count + 1.
inline constexpr auto own_spread_place = static_cast<Eigen::Index>(uncertain_count);
/// s, a factor of 2. ESTIMATE: no published records of dresspacks give it.
inline constexpr double own_spread_deviation = 0.7;
/// z of f = 1
inline constexpr double own_spread_as_is = own_spread_deviation;

/// Returns f at z.
inline double own_spread_at(double z) { return std::exp(own_spread_deviation * (z - own_spread_deviation)); }

/// Returns z at f.
inline double own_spread_z(double f) { return std::log(f) / own_spread_deviation + own_spread_deviation; }

struct OwnSpread {
  double factor = 1;         ///< root of the mean of f^2
  double low = 0, high = 0;  ///< quantiles 10 and 90 % of f
};
/// z: samples.
OwnSpread own_spread_of(const Eigen::VectorXd& z);

}  // namespace dresslife::pipeline
