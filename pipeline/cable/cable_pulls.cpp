#include "pipeline/cable/cable_pulls.h"

#include <algorithm>
#include <cmath>

namespace dresslife::pipeline {

CablePulls pulls_of(std::span<const PulledCable> cables, std::size_t samples) {
  CablePulls pulls;
  pulls.moment.assign(samples, 0.0);
  std::vector<double> moment(4 * samples, 0.0);  // (clamp, 2, sample) about d1 and d2
  for (const PulledCable& cable : cables) {
    std::vector<double>& tension = pulls.tension.emplace_back(samples);
    std::array<double, 2>& end_pull = pulls.end_pull.emplace_back();
    for (std::size_t t = 0; t < samples; ++t) {
      tension[t] = cable.force.force(cable.strain[0][t]);
      if (const double strength = cable.force.strength();
          strength > 0 && std::abs(tension[t]) > pulls.force_share * strength) {
        pulls.force_share = std::abs(tension[t]) / strength;
        pulls.of_cable = pulls.tension.size() - 1;
        pulls.at_sample = t;
      }
      for (std::size_t clamp = 0; clamp < 2; ++clamp) {
        const double strain = cable.strain[clamp + 1][t];
        const double pull = strain == cable.strain[0][t] ? tension[t] : cable.force.force(strain);
        end_pull[clamp] = std::max(end_pull[clamp], pull);
        moment[2 * clamp * samples + t] += pull * cable.place[clamp][1];
        moment[(2 * clamp + 1) * samples + t] -= pull * cable.place[clamp][0];
      }
    }
  }
  for (std::size_t clamp = 0; clamp < 2; ++clamp)
    for (std::size_t t = 0; t < samples; ++t) {
      const double* const own = moment.data() + 2 * clamp * samples + t;
      pulls.moment[t] = std::max(pulls.moment[t], std::hypot(own[0], own[samples]));
    }
  return pulls;
}

double moment_share(const CablePulls& pulls, std::span<const double> hose_moment) {
  if (pulls.moment.empty() || hose_moment.empty()) return 0;
  const double largest_moment = *std::ranges::max_element(hose_moment);
  return largest_moment > 0 ? *std::ranges::max_element(pulls.moment) / largest_moment : 0;
}

}  // namespace dresslife::pipeline
