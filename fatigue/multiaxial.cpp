#include "fatigue/multiaxial.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace dresslife::fatigue {
namespace {

double lean_of(int plane, int planes) { return std::numbers::pi * (double(plane) / planes - 0.5); }

}  // namespace

std::vector<double> plane_strain(std::span<const double> strain, std::span<const double> shear, double poisson_ratio,
                                 double theta) {
  assert(strain.size() == shear.size());
  const double c = std::cos(theta), s = std::sin(theta);
  std::vector<double> result;
  for (std::size_t t = 0; t < strain.size(); ++t)
    result.push_back(strain[t] * (c * c - poisson_ratio * s * s) + shear[t] * s * c);
  return result;
}

CriticalPlane critical_plane(std::span<const double> strain, std::span<const double> shear, double poisson_ratio,
                             const DamageCounter& counter, DamageCounter::Workspace& workspace, int planes) {
  std::vector<std::vector<float>> reversals(planes);
  std::vector<StrainList> lists;
  for (int plane = 0; plane < planes; ++plane) {
    for (const Reversal& reversal : find_reversals(plane_strain(strain, shear, poisson_ratio, lean_of(plane, planes))))
      reversals[plane].push_back(static_cast<float>(reversal.strain));
    lists.push_back({reversals[plane].data(), reversals[plane].size()});
  }
  std::vector<double> damage(planes);
  counter(lists, damage, workspace);
  CriticalPlane worst;
  for (int plane = 0; plane < planes; ++plane)
    if (damage[plane] > worst.damage) worst = {lean_of(plane, planes), damage[plane]};
  return worst;
}

}  // namespace dresslife::fatigue
