#include "fatigue/clamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dresslife::fatigue {

double relieved_strain(double at_clamp, double beside, double distance, double relief) {
  if (beside >= at_clamp) return at_clamp;
  constexpr int steps = 256;   // the maximum is flat: a step misses 1e-4 of it at most
  double least_help = beside;  // c = S': a layer far shorter than the distance
  for (int k = 0; k < steps; ++k) {
    const double beyond = beside * k / steps, by_layer = at_clamp - beyond;
    const double layers =
        relief / distance * std::log(by_layer / (beside - beyond));  // infinite without a neighbour
    least_help = std::max(least_help, beyond + (relief > 0 ? by_layer / (1 + layers) : by_layer));
  }
  return least_help;
}

double strain_relief_force(double diameter) {
  struct Row {
    double up_to, force;
  };
  constexpr std::array<Row, 9> table{{{4e-3, 5},
                                      {8e-3, 30},
                                      {11e-3, 42},
                                      {16e-3, 55},
                                      {23e-3, 70},
                                      {31e-3, 80},
                                      {43e-3, 90},
                                      {55e-3, 100},
                                      {std::numeric_limits<double>::infinity(), 115}}};
  return std::find_if(table.begin(), table.end(), [&](const Row& row) { return diameter <= row.up_to; })
      ->force;
}

}  // namespace dresslife::fatigue
