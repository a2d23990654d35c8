// Which samples of a long motion a page needs so that straight lines between them show all the others.
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

/// Samples, first and last among them, such that each quantity, interpolated linearly in time between them,
/// misses every sample by at most its tolerance: from each, the farthest that a fan of slopes reaches which
/// all samples on the way leave open. O(samples width). Precondition: at least one sample.
std::vector<std::size_t> key_samples(const Histories& histories, const std::vector<double>& tolerance);

/// (quantity) how much each misses at worst between such samples.
std::vector<double> largest_misses(const Histories& histories, const std::vector<std::size_t>& keys);

}  // namespace dresslife::pipeline
