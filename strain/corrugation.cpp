#include "strain/corrugation.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace dresslife::strain {

WallFactors wall_factors(const pipeline::Dresspack& dresspack) {
  const double outer = dresspack.diameter / 2;
  if (!dresspack.hose_corrugation) {
    const double factor = dresspack.hose_strain_factor.value_or(1);
    return {factor, factor, outer};
  }
  constexpr double pi = std::numbers::pi;
  const pipeline::Corrugation& profile = *dresspack.hose_corrugation;
  const double depth = profile.height - profile.wall, r = profile.pitch / 4, a = depth / 2 - r;
  assert(a >= 0);
  const double compliance = a * a * a / 3 + r * (pi * a * a / 2 + 2 * a * r + pi * r * r / 4);
  return {profile.wall * profile.pitch * depth / (16 * compliance), profile.pitch / (4 * a + 2 * pi * r),
          outer - profile.height / 2};
}

}  // namespace dresslife::strain
