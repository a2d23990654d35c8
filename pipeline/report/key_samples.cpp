#include "pipeline/report/key_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dresslife::pipeline {
namespace {

/// (quantity) range of slopes from a sample for which the line passes all later samples within the tolerance.
class Fan {
 public:
  Fan(const Histories& histories, const std::vector<double>& tolerance, std::size_t from)
      : histories_(histories),
        tolerance_(tolerance),
        from_(from),
        least_(histories.width, -std::numeric_limits<double>::infinity()),
        most_(histories.width, std::numeric_limits<double>::infinity()) {}

  /// Returns whether the line to `sample` passes all samples before it within the tolerance. If so, narrows the slopes by
  /// `sample`.
  bool reaches(std::size_t sample) {
    const double time = histories_.time[sample] - histories_.time[from_];
    const double *here = histories_.row(from_), *there = histories_.row(sample);
    for (std::size_t q = 0; q < histories_.width; ++q) {
      const double slope = (there[q] - here[q]) / time;
      if (slope < least_[q] || slope > most_[q]) return false;
    }
    for (std::size_t q = 0; q < histories_.width; ++q) {
      least_[q] = std::max(least_[q], (there[q] - here[q] - tolerance_[q]) / time);
      most_[q] = std::min(most_[q], (there[q] - here[q] + tolerance_[q]) / time);
    }
    return true;
  }

 private:
  const Histories& histories_;
  const std::vector<double>& tolerance_;
  std::size_t from_;
  std::vector<double> least_, most_;
};

}  // namespace

std::vector<std::size_t> key_samples(const Histories& histories, const std::vector<double>& tolerance) {
  const std::size_t samples = histories.time.size();
  std::vector<std::size_t> keys{0};
  while (keys.back() + 1 < samples) {
    Fan fan(histories, tolerance, keys.back());
    std::size_t next = keys.back() + 1;
    fan.reaches(next);
    while (next + 1 < samples && fan.reaches(next + 1)) ++next;
    keys.push_back(next);
  }
  return keys;
}

std::vector<double> largest_misses(const Histories& histories, const std::vector<std::size_t>& keys) {
  std::vector<double> miss(histories.width, 0.0);
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const double *begin = histories.row(keys[k]), *end = histories.row(keys[k + 1]);
    const double from = histories.time[keys[k]], lasts = histories.time[keys[k + 1]] - from;
    for (std::size_t sample = keys[k] + 1; sample < keys[k + 1]; ++sample) {
      const double part = (histories.time[sample] - from) / lasts, *is = histories.row(sample);
      for (std::size_t q = 0; q < histories.width; ++q)
        miss[q] = std::max(miss[q], std::abs(begin[q] + part * (end[q] - begin[q]) - is[q]));
    }
  }
  return miss;
}

}  // namespace dresslife::pipeline
