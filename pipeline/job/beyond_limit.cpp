#include "pipeline/job/beyond_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Load on a straight line through two nodes.
struct LoadLine {
  LoadNode a, b;
  double slope() const { return (b.load - a.load) / (b.z - a.z); }
};

}  // namespace

double share_beyond(std::vector<LoadNode> nodes, double mean, double deviation) {
  std::ranges::sort(nodes, {}, &LoadNode::z);
  const auto share_below = [&](double z) { return normal_share((z - mean) / deviation); };
  if (nodes.size() == 1) return nodes.front().load > 1 ? 1 : 0;
  double share = 0;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const LoadLine line{nodes[k], nodes[k + 1]};
    double low = k == 0 ? -endless : line.a.z, high = k + 2 == nodes.size() ? endless : line.b.z;
    if (line.slope() == 0) {
      if (line.a.load <= 1) continue;
    } else {
      const double crossing = line.a.z + (1 - line.a.load) / line.slope();
      if (line.slope() > 0)
        low = std::max(low, crossing);
      else
        high = std::min(high, crossing);
    }
    if (low < high) share += share_below(high) - share_below(low);
  }
  return share;
}

std::string value_words(const UncertainParameter& parameter, double z, double own) {
  const double by = parameter.value(z);
  return fmt::format("{:.2g} times {} ({}: {:.3g})", by, parameter.cause, parameter.key, own * by);
}

std::string percent_words(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string measurement_words(const UncertainParameter& parameter, const Uncertainty& known) {
  const double now = parameter.z_of(known.spread[index_of(parameter.name)]) * parameter.deviation();
  constexpr double rounding = 0.01;  // of the proposed factor, which has three digits
  if (now <= parameter.test_deviation + rounding) return "";
  return fmt::format("; or uncertainty.{}: {:.3g}, if this measurement confirms the job's value: {}", parameter.name,
                     std::exp(parameter.test_deviation), parameter.test);
}

}  // namespace dresslife::pipeline
