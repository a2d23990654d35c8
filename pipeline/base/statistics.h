// The standard normal distribution, and quantiles of a list of numbers.
#pragma once

#include <span>
#include <vector>

namespace dresslife::pipeline {

/// Density at z, exp(-z^2/2) / sqrt(2 pi).
double normal_density(double z);

/// Phi(z), the probability below z, accurate to rounding.
double normal_share(double z);

/// ln Phi(z) for any z, also if Phi(z) underflows.
double log_normal_share(double z);

/// Returns the z with Phi(z) = share, to 1.6e-17 + one unit in the last place. Precondition: 1e-18 < share < 1.
double normal_quantile(double share);

/// The 90 % quantile; 10 % lie below its negative.
constexpr double normal_decile = 1.2815515655446004;

/// Returns the number at a position of a sorted list; position 0 is the first number. Interpolates linearly between neighbours;
/// if the larger neighbour is infinite, returns infinity. The quantile of a share of n numbers is at position share (n - 1) (from
/// the first number to the last) or share n - 1/2 (Hazen: each number represents 1/n). Precondition: the list is not empty.
double number_at(const std::vector<double>& sorted, double place);

/// Returns the sum of the positive numbers: the total amount by which limits are exceeded. NaN counts as 0.
double sum_above_zero(std::span<const double> values);

}  // namespace dresslife::pipeline
