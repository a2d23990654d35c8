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

}  // namespace dresslife::pipeline
