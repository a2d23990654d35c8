// Arranges cables and hoses in the bore of a hose: the key `place: auto` of a dresspack's components.
//
// Parts lie in rings around the axis. Neighbours i and j on a circle of radius R need the angle
//     2 asin((r_i + r_j) / (2 R)),
// and all gaps share the rest of the turn equally. The circle is chosen so that the parts have a gap to the wall of half of the
// gap to each other, but it is at least so large that they fit beside the core. If the parts do not fit into one ring, the
// thickest part goes to the middle, then as many as needed into inner rings. A single part lies in the middle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Returns the bore of a dresspack as written [mm]; 0: unknown.
double bore_of(const Node& dresspack);

/// Returns the keys of the dresspack as written with a bore [mm] that is wide enough (wider_hose()).
std::string wider_hose_of(const Node& dresspack, double bore);

struct PlacedPart {
  double helix_radius = 0;  ///< [m]
  double phase = 0;         ///< [rad]
};

/// Returns the places of parts in a bore around a core, (part); radii [m]. std::nullopt: the parts do not fit.
std::optional<std::vector<PlacedPart>> pack_in_bore(const std::vector<double>& radii, double bore, double core);

/// Replaces `place: auto` of a dresspack's components by helix_radius_mm and phase_deg. A component of several parts that are not
/// evenly spaced on one circle becomes one component for each part ("signal cable a", "signal cable b"), and all get
/// `entry`, the number of their component as written. Precondition: data
/// sheets are expanded. Problems, under `path`: an unknown bore, parts that do not fit (with a bore that is large enough), other
/// keys of the place, or parts off the axis without `place: auto`.
void expand_places(Node& dresspack, const std::string& path, Problems& problems);

}  // namespace dresslife::pipeline
