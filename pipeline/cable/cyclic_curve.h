// The two constants of a metal's cyclic curve, strain = sigma / E + (sigma / K')^(1/n') (F7 of
// fatigue/README.md), as a material gives them or as its strain-life constants imply them.
#pragma once

#include "pipeline/job/material.h"

namespace dresslife::pipeline {

/// n' of a metal: given, else b / c.
double hardening_exponent(const Material& metal);
/// K' of a metal [Pa]: given, else sigma_f' / epsilon_f'^n'.
double cyclic_strength(const Material& metal);

}  // namespace dresslife::pipeline
