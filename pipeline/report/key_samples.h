// Selection of the samples of a long motion that a page needs: linear interpolation between them approximates all others.
#pragma once

#include <cstddef>
#include <vector>

namespace dresslife::pipeline {

/// Histories of several quantities, sampled together.
struct Histories {
  std::vector<double> time;  ///< (sample) [s], rising
  std::size_t width = 0;     ///< number of quantities
  std::vector<double> rows;  ///< (sample, quantity)
  const double* row(std::size_t sample) const { return &rows[sample * width]; }
};

/// Returns samples, including the first and the last, such that linear interpolation in time between them is within the tolerance
/// of each quantity at every sample. Each next sample is the farthest for which all samples between allow a common slope.
/// O(samples width). Precondition: at least one sample.
std::vector<std::size_t> key_samples(const Histories& histories, const std::vector<double>& tolerance);

/// Returns, (quantity), the largest interpolation error between these samples.
std::vector<double> largest_misses(const Histories& histories, const std::vector<std::size_t>& keys);

}  // namespace dresslife::pipeline
