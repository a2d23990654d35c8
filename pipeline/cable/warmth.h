// How the polymers of a dresspack change with the temperature of the cell.
//
// Stiffness and strength fall by the same share per kelvin,
//     E(T) = E(23 C) exp(-c (T - 23 C)),   c = 0.0175 / K.                                                    (F36)
// Published: the pressure that one maker's tubes bear. Polyamide 12: 1, 0.70, 0.50, 0.41, 0.36 of that at 20 C when they are at
// 40, 60, 80, 100 C (SMC, series T: 3.3, 2.3, 1.65, 1.35, 1.2 MPa), c = 0.018 and 0.017 up to 60 C. Polyurethane: 0.81 at 40 C (SMC, series
// TRTU), c = 0.010. Hoses of PVC and of polyurethane with a fabric: 0.55 at 40 C (Hilltop, Colex), c = 0.030. That a modulus falls as a
// strength does is an ESTIMATE; so is everything below 20 C, where these tables are flat because the fittings bound the pressure.
// The range is therefore 10 to 60 C.
//
// A wear rate goes with 1 / hardness (Archard), and the hardness with the strength: it grows by exp(c (T - 23 C)).
// Polymers on metal have also been seen to wear less when warm, so the deviation of c counts in that of the rate.
// Not changed: copper (its modulus falls by 0.03 % per kelvin), friction coefficients (published ones rise and fall with the
// temperature), pressures of jackets on their cores, beds of layers in cables (radial_stiffness_N_per_m2), damping, the strain-life
// points of a hose's wall, values that a job gives as numbers.
#pragma once

#include <cmath>

#include "pipeline/job/shapes.h"

namespace dresslife::pipeline {

/// c and its deviation, by the three materials above [1/K].
constexpr double softening = 0.0175, softening_deviation = 0.0075;

/// Of a polymer's modulus, to that at 23 C. temperature [C].
inline double stiffness_at(double temperature) {
  return std::exp(-softening * (temperature - Cell::usual_temperature));
}

/// Of a wear rate, and the deviation of its log10.
struct WarmWear {
  double factor = 1, log10_spread = 0;
};
inline WarmWear wear_at(double temperature) {
  const double change = temperature - Cell::usual_temperature;
  return {std::exp(softening * change), softening_deviation * std::abs(change) / std::log(10.0)};
}

}  // namespace dresslife::pipeline
