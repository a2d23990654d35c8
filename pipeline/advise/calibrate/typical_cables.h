// Parameters of a typical cable, learned from cables of different makers.
//
// A share of the prior variance of z differs from cable to cable; the rest is common to all cables:
//     z of a cable = m + d,   m ~ N(0, 1 - share) common,   d ~ N(0, share) for each cable.                 (P4)
// A test of one cable informs m. The d of this cable adds share (d ln life/d z)^2 to the variance of its life, because ln life is
// linear in z over one deviation. A cable without a test has the posterior of m plus an independent d.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "pipeline/advise/calibrate/posterior.h"
#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

/// Returns the share, 0 .. 0.99. Precondition: parameter < uncertain_count.
double share_between_cables(std::size_t parameter);

/// Returns the standard deviations of m. parameters: parameters of its axes.
Eigen::VectorXd common_deviations(const std::vector<Eigen::Index>& parameters);

/// Adds an independent d to m in every draw, with mean, covariance and quantiles of the sum. The seed is fixed.
void add_own_deviations(Posterior& posterior, const std::vector<Eigen::Index>& parameters);

/// Returns the standard deviation of ln life between cables. median: ln life at z, (parameter). acts: parameters of ln life.
template <class LogMedian>
double deviation_between_cables(const LogMedian& median, const std::array<bool, uncertain_count>& acts,
                                const Eigen::VectorXd& z) {
  constexpr double step = 0.5;  // standard deviations to either side
  double variance = 0;
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const double share = share_between_cables(p);
    if (share == 0 || !acts[p]) continue;
    Eigen::VectorXd low = z, high = z;
    low[static_cast<Eigen::Index>(p)] -= step;
    high[static_cast<Eigen::Index>(p)] += step;
    const double slope = (median(high) - median(low)) / (2 * step);
    variance += share * slope * slope;
  }
  return std::sqrt(variance);
}

}  // namespace dresslife::pipeline
