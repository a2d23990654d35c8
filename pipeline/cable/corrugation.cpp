#include "pipeline/cable/corrugation.h"

#include <cassert>

#include "pipeline/base/constants.h"

namespace dresslife::pipeline {

double Fold::unfolded() const { return 4 * half_flank + 2 * pi * radius; }

Fold fold_of(const Corrugation& profile) {
  const double r = profile.pitch / 4, a = (profile.height - profile.wall) / 2 - r;
  assert(a >= 0);
  return {r, a, a * a * a / 3 + r * (pi * a * a / 2 + 2 * a * r + pi * r * r / 4)};
}

WallFactors wall_factors(const Dresspack& dresspack) {
  const double outer = dresspack.diameter / 2;
  if (!dresspack.hose_corrugation) {
    const double factor = dresspack.hose_strain_factor.value_or(1);
    return {factor, factor, outer};
  }
  const Corrugation& profile = *dresspack.hose_corrugation;
  const Fold fold = fold_of(profile);
  const double depth = profile.height - profile.wall;
  return {profile.wall * profile.pitch * depth / (16 * fold.compliance), profile.pitch / fold.unfolded(),
          outer - profile.height / 2};
}

}  // namespace dresslife::pipeline
