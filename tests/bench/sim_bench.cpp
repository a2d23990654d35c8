// Processor time of the chain on one core: the driven cable of tests/sim/rod/rod_driven_cable.h, without contact.
//
// sim_cpu_s_per_s_n40: processor seconds per simulated second at n = 40, 5 ms.
// sim_cost_ratio_n240_n30: processor time per segment and step at n = 240 / that at n = 30.
// sim_rms_curvature_error_n40, _n20: errors of this run, and of a run with 20 segments, against beam elements.
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "tests/sim/rod/rod_driven_cable.h"

namespace {

using namespace dresslife::sim;
using test::DrivenCable;

/// Returns the processor time per step of a run over the compared time [s]: the smallest of a few, because other work disturbs.
double seconds_per_step(int segments) {
  constexpr double h = 0.005;
  constexpr int steps = 4800, repeats = 7;
  const Rod rod(DrivenCable::properties(segments));
  double best = 1e9;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    WorldSettings settings;
    settings.time_step = h;
    World world(rod, settings, rod.straight(DrivenCable::base()));
    std::vector<Load> loads;
    const std::clock_t begin = std::clock();
    for (int k = 0; k < steps; ++k) {
      DrivenCable::weigh(rod, k * h, loads);
      world.advance(DrivenCable::clamps((k + 1) * h), {}, loads);
    }
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / steps);
  }
  return best;
}

}  // namespace

int main() {
  const double n40 = seconds_per_step(40), n240 = seconds_per_step(240), n30 = seconds_per_step(30);
  std::printf("sim_cpu_s_per_s_n40 %.5f\n", n40 / 0.005);
  for (const int n : {20, 40})
    std::printf("sim_rms_curvature_error_n%d %.5f\n", n, test::rms_curvature_error(test::run_driven_cable(n, 0.005)));
  std::printf("sim_cost_ratio_n240_n30 %.3f\n", (n240 / 240) / (n30 / 30));
}
