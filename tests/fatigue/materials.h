// Materials of the fatigue tests. Copper and aluminium: S. Backman's thesis (2018), table 2.
#pragma once

#include "pipeline/job/material.h"

namespace dresslife::fatigue_tests {

inline pipeline::Material material(double youngs_modulus, double fatigue_strength, double b, double fatigue_ductility,
                                   double c) {
  pipeline::Material m;
  m.name = "test metal";
  m.youngs_modulus = youngs_modulus;
  m.fatigue_strength = fatigue_strength;
  m.fatigue_strength_exponent = b;
  m.fatigue_ductility = fatigue_ductility;
  m.fatigue_ductility_exponent = c;
  return m;
}

inline pipeline::Material copper() { return material(117e9, 983e6, -0.112, 2.43, -0.6); }
inline pipeline::Material aluminium() { return material(71e9, 1466e6, -0.143, 0.262, -0.619); }

}  // namespace dresslife::fatigue_tests
