#include "fatigue/strain_relief.h"

#include <array>
#include <limits>

namespace dresslife::fatigue {

double held_by_strain_relief(double diameter) {
  struct Step {
    double to, force;  // [m], [N]
  };
  constexpr double any = std::numeric_limits<double>::infinity();
  constexpr std::array<Step, 9> steps{{{4e-3, 5},
                                       {8e-3, 30},
                                       {11e-3, 42},
                                       {16e-3, 55},
                                       {23e-3, 70},
                                       {31e-3, 80},
                                       {43e-3, 90},
                                       {55e-3, 100},
                                       {any, 115}}};
  constexpr double rounding = 1e-9;  // [m] of a diameter from a radius in mm
  for (const Step& step : steps)
    if (diameter <= step.to + rounding) return step.force;
  return 0;  // diameter is NaN
}

}  // namespace dresslife::fatigue
