// What plans count in: broken wires of a conductor, and months.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dresslife::pipeline {

/// Wires that must break before a share of `wires` has: at least one.
inline std::size_t wires_of_share(double percent, std::size_t wires) {
  const double count = std::ceil(percent / 100 * double(wires) * (1 - 1e-12));  // 10 % of 70 are 7, not 8
  return std::clamp<std::size_t>(static_cast<std::size_t>(count), 1, std::max<std::size_t>(wires, 1));
}

/// Calendar months of so many hours of operation.
inline double months(double hours, double operating_hours_per_week) {
  constexpr double weeks_per_month = 365.2425 / 12 / 7;  // mean Gregorian month
  return hours / operating_hours_per_week / weeks_per_month;
}

/// Share of new dresspacks that reach the ages of those in use. Where it is less, a prediction contradicts them. Where dresspacks are
/// replaced at failure alone, it is 48 % if ln of their lives has the deviation 1, 29 % at 1.5 and 16 % at 2: the integral of S^2 over
/// that of S is 2 Phi(-s/2^0.5).
constexpr double usual_reach = 0.1;

}  // namespace dresslife::pipeline
