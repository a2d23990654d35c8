// Cycles of a log that repeat: parts in which the robot returns to a pose and performs the same motion again.
//
// The course is sampled every 0.05 s of motion. Samples within a tenth of the bound of the previous one are left out, because
// waits and slow starts differ from cycle to cycle. A position is a number of samples and may lie between two samples, where the
// course is a straight line.
// (L1) A part that begins at position b repeats a cycle of n samples x_0 .. x_n, if positions
//      s_0 = b < s_1 < .. < s_n exist with
//      |x(s_k) - x_k| <= bound for every axis, 0.4 <= s_k - s_k-1 <= 1.8, and |s_k - b - k| <= warp k + 3. They are
//      found one by one: s_k minimises |x(s) - x_k|^2 + (0.1 bound)^2 (s - s_k-1 - 1)^2.
// (L2) A cycle begins at a slow moment (no axis moves by more than 2 deg from sample to sample), returns to this pose
//      after at least the shortest duration, and repeats at least once. Of several possible cycles the shortest one is used.
// A first pass finds cycles from the begin of the log on; a second pass searches for all of them from the begin.
// The remainder is the rest. Without the cycles it is one motion without jumps, because a cycle ends at its begin
// (within the bound).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sim/recording/course.h"

namespace dresslife::sim {

struct CycleOptions {
  double bound = 0;     ///< [rad]
  double warp = 0;      ///< share of the duration
  double shortest = 0;  ///< [s], in samples
};

/// A part of the course that repeats a cycle.
struct CyclePart {
  std::size_t cycle = 0;
  double begin = 0, end = 0;  ///< [s] of the course
  double difference = 0;      ///< largest difference from the cycle [rad]
};

struct Cycles {
  std::size_t count = 0;         ///< number of different cycles; the cycle with most time is the first
  std::vector<CyclePart> parts;  ///< in the order of the course; the rest lies between them
};

/// Returns the cycles of a course. progress: called with the finished share.
Cycles cycles_of(const Course& course, const CycleOptions& options, const std::function<void(double)>& progress = {});

}  // namespace dresslife::sim
