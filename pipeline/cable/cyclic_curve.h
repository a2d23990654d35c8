// The two constants of a metal's cyclic curve, strain = sigma / E + (sigma / K')^(1/n') (F7 of fatigue/theory.md): given by the
// material, or computed from its strain-life constants.
#pragma once

#include "pipeline/job/material.h"

namespace dresslife::pipeline {

/// Returns n' of a metal: the given value, otherwise b / c.
double hardening_exponent(const Material& metal);
/// Returns K' of a metal [Pa]: the given value, otherwise sigma_f' / epsilon_f'^n'.
double cyclic_strength(const Material& metal);

}  // namespace dresslife::pipeline
