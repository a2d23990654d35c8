// Conversions for plans: broken wires of a conductor, and months.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dresslife::pipeline {

/// Returns the number of wires in this percentage of `wires`, rounded up; at least one.
inline std::size_t wires_of_share(double percent, std::size_t wires) {
  const double count = std::ceil(percent / 100 * double(wires) * (1 - 1e-12));  // 10 % of 70 are 7, not 8
  return std::clamp<std::size_t>(static_cast<std::size_t>(count), 1, std::max<std::size_t>(wires, 1));
}

/// Returns the calendar months with this number of operating hours.
inline double months(double hours, double operating_hours_per_week) {
  constexpr double weeks_per_month = 365.2425 / 12 / 7;  // mean Gregorian month
  return hours / operating_hours_per_week / weeks_per_month;
}

/// Least share of new dresspacks that reach the ages of those in use. A smaller share contradicts a prediction. If dresspacks are
/// only replaced at failure and ln of their lives has the standard deviation s, the share is the integral of S^2 / the integral
/// of S = 2 Phi(-s/2^0.5): 48 % for s = 1, 29 % for 1.5 and 16 % for 2.
constexpr double usual_reach = 0.1;

}  // namespace dresslife::pipeline
