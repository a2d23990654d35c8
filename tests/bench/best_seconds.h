// Processor time of a benchmark.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>

/// Returns the smallest processor time of five runs of `work` [s].
inline double best_seconds(const std::function<void()>& work) {
  double best = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const std::clock_t begin = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}
