// Counting, cyclic stress, SWT and Miner's sum of stored reversals on one core, against plain three-point counting of the same
// reversals.
//
// fatigue_mreversals_per_s: DamageCounter. fatigue_reference_mreversals_per_s: the cost of counting alone, with a stack, two
// comparisons per reversal and a sum of ranges.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "fatigue/damage.h"
#include "tests/bench/best_seconds.h"

namespace {

using namespace dresslife;

constexpr int wires = 20000, samples = 400;

/// Returns reversals of random walks, about 200 each, with strains as in a signal cable.
std::vector<std::vector<float>> histories() {
  std::mt19937 random(1);
  std::normal_distribution<double> step(0, 0.0015);
  std::vector<std::vector<float>> result(wires);
  for (std::vector<float>& reversals : result) {
    std::vector<double> history;
    double x = 0;
    for (int t = 0; t < samples; ++t) history.push_back(x = 0.9 * x + step(random));
    for (const auto& r : fatigue::find_reversals(history)) reversals.push_back(static_cast<float>(r.strain));
  }
  return result;
}

float three_point_ranges(const std::vector<float>& reversals) {
  static std::vector<float> open;
  open.clear();
  float sum = 0;
  for (const float next : reversals) {
    while (open.size() >= 3) {
      const float top = open.back(), below = open[open.size() - 2];
      if (std::fabs(next - top) < std::fabs(top - below)) break;
      sum += std::fabs(top - below);
      open.resize(open.size() - 2);
    }
    open.push_back(next);
  }
  return sum;
}

}  // namespace

int main() {
  pipeline::Material copper;  // S. Backman's thesis (2018), table 2
  copper.youngs_modulus = 117e9;
  copper.fatigue_strength = 983e6;
  copper.fatigue_strength_exponent = -0.112;
  copper.fatigue_ductility = 2.43;
  copper.fatigue_ductility_exponent = -0.6;
  const auto all = histories();
  double reversals = 0;
  for (const auto& history : all) reversals += double(history.size());
  const fatigue::DamageCounter counter(copper, {});
  fatigue::DamageCounter::Workspace workspace;
  volatile double keep = 0;
  std::vector<fatigue::StrainList> lists;
  for (const auto& history : all) lists.push_back({history.data(), history.size()});
  std::vector<double> damage(lists.size());
  const double seconds = best_seconds([&] {
    counter(lists, damage, workspace);
    keep = keep + damage[0];
  });
  const double reference = best_seconds([&] {
    for (const auto& history : all) keep = keep + three_point_ranges(history);
  });
  std::printf("fatigue_mreversals_per_s %.2f\n", reversals / seconds * 1e-6);
  std::printf("fatigue_reference_mreversals_per_s %.2f\n", reversals / reference * 1e-6);
}
