#include "pipeline/cable/cyclic_curve.h"

#include <cmath>

namespace dresslife::pipeline {

double hardening_exponent(const Material& metal) {
  return metal.cyclic_hardening_exponent.value_or(metal.fatigue_strength_exponent / metal.fatigue_ductility_exponent);
}

double cyclic_strength(const Material& metal) {
  return metal.cyclic_strength.value_or(metal.fatigue_strength /
                                        std::pow(metal.fatigue_ductility, hardening_exponent(metal)));
}

}  // namespace dresslife::pipeline
