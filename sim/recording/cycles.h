// Cycles of a log that repeat: where the robot gets back to a pose and does the same again.
//
// The course is sampled every 0.05 s of motion, without samples within a tenth of the bound of the one before: waits
// and slow starts differ from cycle to cycle. Positions count in samples and may lie between two of them, where the
// course is a straight line.
// (L1) A part that begins at position b repeats a cycle of n samples x_0 .. x_n, if there are positions
//      s_0 = b < s_1 < .. < s_n with
//      |x(s_k) - x_k| <= bound for every axis, 0.4 <= s_k - s_k-1 <= 1.8, and |s_k - b - k| <= warp k + 3. They are
//      found one by one: s_k minimises |x(s) - x_k|^2 + (0.1 bound)^2 (s - s_k-1 - 1)^2.
// (L2) A cycle begins at a slow moment (no axis moves by more than 2 deg from sample to sample), gets back to this pose
//      after the shortest duration or more, and repeats at least once. Of several the shortest one counts.
// A first pass finds cycles from the beginning of the log on; a second one looks for all of them from the beginning.
// What is left is the rest. With the cycles taken out it is one motion without jumps, because a cycle ends where it
// begins (within the bound).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sim/recording/course.h"

namespace dresslife::sim {

struct CycleOptions {
  double bound = 0;     ///< [rad]
  double warp = 0;      ///< 1: of the duration
  double shortest = 0;  ///< [s] of samples
};

/// A part of the course that repeats a cycle.
struct CyclePart {
  std::size_t cycle = 0;
  double begin = 0, end = 0;  ///< [s] of the course
  double difference = 0;      ///< largest from the cycle [rad]
};

struct Cycles {
  std::size_t count = 0;         ///< of different cycles, those with most time first
  std::vector<CyclePart> parts;  ///< in the order of the course; between them lies the rest
};

/// progress: called with the share that is done.
Cycles cycles_of(const Course& course, const CycleOptions& options,
                 const std::function<void(double)>& progress = {});

}  // namespace dresslife::sim
