// Lives of wires one by one, which the tests compare those of conductors and dresspacks with.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>

#include "fatigue/life_distribution.h"

namespace dresslife::fatigue {

/// Share of wires of this median life that have broken by `time`. s = 0: 0 before, 1 from the median on.
inline double broken_share(double time, double median_life, double scatter_log10) {
  if (scatter_log10 == 0) return time >= median_life ? 1 : 0;
  return std::erfc(-std::log10(time / median_life) / (scatter_log10 * std::numbers::sqrt2)) / 2;
}

/// Life by which at least `count` of the wires have broken in `share` of all cases. damage (wire): per
/// repeat, by the median curves. Infinite when fewer wires are damaged at all. Precondition: count >= 1.
inline double life_until(std::span<const double> damage, std::size_t count, Scatter scatter, double share) {
  const auto wires = std::make_shared<const Wires>(damage);
  if (wires->damaged() < count) return std::numeric_limits<double>::infinity();
  if (scatter.log10 == 0) return wires->life(count - 1);
  return life_of_share({distribution_of(wires, count, scatter)}, share);
}

}  // namespace dresslife::fatigue
