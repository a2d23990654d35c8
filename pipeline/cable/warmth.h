// Change of a dresspack's polymers with the temperature of the cell.
//
// Stiffness and strength decrease by the same share per kelvin,
//     E(T) = E(23 C) exp(-c (T - 23 C)),   c = 0.0175 / K.                                                    (F36)
// Published values are the pressures that tubes of several makers bear. Polyamide 12: 1, 0.70, 0.50, 0.41, 0.36 of that at 20 C
// for 40, 60, 80, 100 C (SMC, series T: 3.3, 2.3, 1.65, 1.35, 1.2 MPa), c = 0.018 and 0.017 up to 60 C. Polyurethane: 0.81 at 40
// C (SMC, series TRTU), c = 0.010. Hoses of PVC and of polyurethane with a fabric: 0.55 at 40 C (Hilltop, Colex), c = 0.030. That
// a modulus decreases like a strength is an ESTIMATE. So is everything below 20 C, where these tables are flat because the
// fittings limit the pressure. The range is therefore 10 to 60 C.
//
// A wear rate is proportional to 1 / hardness (Archard), and hardness to strength, so the rate is multiplied by exp(c (T - 23
// C)). Some tests of polymers on metal show less wear when warm, so the deviation of c is added to that of the rate. Not changed:
// copper (its modulus decreases by 0.03 % per kelvin), friction coefficients (published ones increase and decrease with
// temperature), pressures of jackets on their cores, beds of layers in cables (radial_stiffness_N_per_m2), damping, the
// strain-life points of a hose's wall, and values that a job gives as numbers.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/job/shapes.h"

namespace dresslife::pipeline {

/// c and its standard deviation, from the three materials above [1/K].
constexpr double softening = 0.0175, softening_deviation = 0.0075;

/// Returns a polymer's modulus / its modulus at 23 C. temperature [C].
inline double stiffness_at(double temperature) {
  return std::exp(-softening * (temperature - Cell::usual_temperature));
}

/// Returns the pressure that a polymer tube bears / that at 20 C, by the tables above. 1 up to the usual temperature of a cell:
/// makers state their limits for 20 or 23 C, and at lower temperatures the fittings limit the pressure.
inline double pressure_at(double temperature) {
  constexpr double of_makers = 20;  // [C]
  return temperature <= Cell::usual_temperature ? 1 : std::exp(-softening * (temperature - of_makers));
}

/// Factor of a wear rate, and the standard deviation of its log10.
struct WarmWear {
  double factor = 1, log10_spread = 0;
};
inline WarmWear wear_at(double temperature) {
  const double change = temperature - Cell::usual_temperature;
  return {std::exp(softening * change), softening_deviation * std::abs(change) / std::log(10.0)};
}

}  // namespace dresslife::pipeline
