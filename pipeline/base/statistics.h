// The standard normal distribution, and quantiles of a list of numbers.
#pragma once

#include <span>
#include <vector>

namespace dresslife::pipeline {

/// Density at z, exp(-z^2/2) / sqrt(2 pi).
double normal_density(double z);

/// Phi(z), the share below z, to rounding.
double normal_share(double z);

/// ln Phi(z), down to any z: where Phi underflows, too.
double log_normal_share(double z);

/// The z with this share below it, to 1.6e-17 + one unit in the last place. Precondition: 1e-18 < share < 1.
double normal_quantile(double share);

/// The z with 90 % below it; 10 % lie below its negative.
constexpr double normal_decile = 1.2815515655446004;

/// The number at a place of a sorted list, 0 the first: straight between neighbours, and the larger one where
/// that is infinite. The quantile of a share of n numbers is at the place share (n - 1) (it runs from the
/// first number to the last) or share n - 1/2 (Hazen: each number stands for 1/n). Precondition: not empty.
double number_at(const std::vector<double>& sorted, double place);

/// The sum of the numbers above 0: by how much limits are passed in all. What is not a number counts as 0.
double sum_above_zero(std::span<const double> values);

}  // namespace dresslife::pipeline
