// The samples of a long motion that a page needs: straight lines between them approximate all others.
#pragma once

#include <cstddef>
#include <vector>

namespace dresslife::pipeline {

/// Histories of several quantities, sampled together.
struct Histories {
  std::vector<double> time;  ///< (sample) [s], rising
  std::size_t width = 0;     ///< quantities
  std::vector<double> rows;  ///< (sample, quantity)
  const double* row(std::size_t sample) const { return &rows[sample * width]; }
};

/// Samples, including the first and the last, between which linear interpolation in time is within the tolerance of
/// each quantity at every sample. Each next one is the farthest for which all samples between leave a common slope.
/// O(samples width). Precondition: at least one sample.
std::vector<std::size_t> key_samples(const Histories& histories, const std::vector<double>& tolerance);

/// (quantity) largest error of each between such samples.
std::vector<double> largest_misses(const Histories& histories, const std::vector<std::size_t>& keys);

}  // namespace dresslife::pipeline
