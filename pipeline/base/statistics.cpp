#include "pipeline/base/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/halving.h"

namespace dresslife::pipeline {

double normal_density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); }

double normal_share(double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; }

// Below -6, uses the continued fraction of Mills' ratio, truncated at the fourth term. The error of ln Phi is 1e-5 at z = -6.
double log_normal_share(double z) {
  if (z > -6) return std::log(normal_share(z));
  const double mills = -z + 1 / (-z + 2 / (-z + 3 / (-z + 4 / -z)));
  return -z * z / 2 - std::log(2 * std::numbers::pi) / 2 - std::log(mills);
}

double normal_quantile(double share) {
  // Phi(-9) = 1e-19
  return halved(-9, 9, 60, [&](double z) { return normal_share(z) < share; }).middle();
}

double number_at(const std::vector<double>& sorted, double place) {
  const auto below = static_cast<std::size_t>(std::max(0.0, place));
  const double low = sorted[below], high = sorted[std::min(below + 1, sorted.size() - 1)];
  return std::isinf(high) ? high : low + (place - static_cast<double>(below)) * (high - low);
}

double sum_above_zero(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += std::max(0.0, value);
  return sum;
}

}  // namespace dresslife::pipeline
