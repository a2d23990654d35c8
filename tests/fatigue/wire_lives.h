// Lives computed wire by wire, a reference for the lives of conductors and dresspacks.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>

#include "fatigue/life_distribution.h"

namespace dresslife::fatigue {

/// Returns the share of wires with this median life that have broken by `time`. Scatter 0: 0 before the median, 1 from it on.
inline double broken_share(double time, double median_life, double scatter_log10) {
  if (scatter_log10 == 0) return time >= median_life ? 1 : 0;
  return std::erfc(-std::log10(time / median_life) / (scatter_log10 * std::numbers::sqrt2)) / 2;
}

/// Returns the time by which at least `count` of the wires have broken in `share` of all cases [repeats]. damage (wire): per
/// repeat, by the median curves. Infinite if fewer than `count` wires have damage. Precondition: count >= 1.
inline double life_until(std::span<const double> damage, std::size_t count, Scatter scatter, double share) {
  const auto wires = std::make_shared<const Wires>(damage);
  if (wires->damaged() < count) return std::numeric_limits<double>::infinity();
  if (scatter.log10 == 0) return wires->life(count - 1);
  return life_of_share({distribution_of(wires, count, scatter)}, share);
}

}  // namespace dresslife::fatigue
