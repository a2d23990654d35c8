#include "pipeline/cable/bend_limit.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/job/parts_room.h"

namespace dresslife::pipeline {
namespace {

/// Returns whether the rule applies to the parts in the dresspack instead of the dresspack itself.
bool bends_by_folds(const Dresspack& dresspack) {
  return dresspack.hose_corrugation && !(dresspack.components.empty() && dresspack.core_components.empty());
}

double limit_of(const Component& part) { return least_bend_diameters * 2 * part.radius + part.helix_radius; }

/// Precondition: the dresspack has components.
const Component& stiffest_part(const Dresspack& dresspack) {
  const Component* stiffest = nullptr;
  for (const auto* list : {&dresspack.components, &dresspack.core_components})
    for (const Component& part : *list)
      if (!stiffest || limit_of(part) > limit_of(*stiffest)) stiffest = &part;
  return *stiffest;
}

/// Returns the diameter of the largest part of the core that no component describes.
double unknown_core(const Dresspack& dresspack) {
  double free = dresspack.core_diameter * dresspack.core_diameter;  // area, times 4 / pi
  for (const Component& part : dresspack.core_components) free -= part.count * 4 * part.radius * part.radius;
  return std::sqrt(std::max(0.0, free));
}

}  // namespace

double least_bend_radius(const Dresspack& dresspack) {
  if (dresspack.least_bend_radius) return *dresspack.least_bend_radius;
  if (!bends_by_folds(dresspack)) return least_bend_diameters * dresspack.diameter;
  return std::max({tightest_hose * dresspack.diameter, least_bend_diameters * unknown_core(dresspack),
                   limit_of(stiffest_part(dresspack))});
}

std::string bend_rule(const Dresspack& dresspack) {
  if (!bends_by_folds(dresspack)) {
    const bool cable = is_single_cable(dresspack);
    return fmt::format("ten diameters of the {} ({:.4g} mm) count{}", cable ? "cable" : "hose",
                       1e3 * dresspack.diameter,
                       cable ? "" : ", because it has no hose_corrugation that bends by its folds");
  }
  const Component& part = stiffest_part(dresspack);
  const double core = least_bend_diameters * unknown_core(dresspack), folds = tightest_hose * dresspack.diameter;
  if (folds >= std::max(core, limit_of(part)))
    return fmt::format(
        "{:g} diameters of the hose ({:.4g} mm) count, the smallest radius that makers of moved hoses state",
        tightest_hose, 1e3 * dresspack.diameter);
  return fmt::format("ten diameters of {} count, because a corrugated hose itself bends by its folds",
                     core > limit_of(part) ? fmt::format("{} ({:.4g} mm)",
                                                         dresspack.core_components.empty()
                                                             ? "its core"
                                                             : "a core with the area that no core component takes",
                                                         1e3 * unknown_core(dresspack))
                                           : fmt::format("'{}' ({:.4g} mm) in the hose, {:.4g} mm off its axis,",
                                                         part.name, 2e3 * part.radius, 1e3 * part.helix_radius));
}

}  // namespace dresslife::pipeline
