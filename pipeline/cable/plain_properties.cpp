#include "pipeline/cable/plain_properties.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/polymer.h"

namespace dresslife::pipeline {
namespace {

constexpr double bore_over_diameter =
    2.0 / 3;  // of the outer diameter, ESTIMATE: sizes on sale are 6 x 4, 8 x 5.5, 10 x 7, 12 x 8 mm
constexpr double water_density = 1000;  // [kg/m3]

}  // namespace

PlainProperties properties_of(const PlainPart& part, double radius) {
  const double bore = part.kind == PlainKind::hose ? part.bore.value_or(2 * bore_over_diameter * radius) / 2 : 0;
  const double area = pi * (radius * radius - bore * bore),
               inertia = pi / 4 * (std::pow(radius, 4) - std::pow(bore, 4));
  const double bending = part.bending_stiffness.value_or(part.stiffness_factor * polymer_modulus * inertia);
  const double inside = part.medium == Medium::water ? water_density * pi * bore * bore : 0;
  return {bore, bending, bending / inertia * area, polymer_density * area + inside};
}

}  // namespace dresslife::pipeline
