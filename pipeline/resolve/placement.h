// Cables and hoses packed into the bore of a hose: the key `place: auto` of a dresspack's components.
//
// Parts lie in rings around the axis. Parts i and j that are neighbours on a circle of radius R ask for the angle
//     2 asin((r_i + r_j) / (2 R)),
// and what is left of the whole turn is shared equally by all gaps. A ring lies where its parts have as much room to the
// wall as half of a gap to each other, and no nearer to the core than they fit. If they do not fit into one ring, the
// thickest part goes to the middle, then as many as needed go to rings inside. One part alone lies in the middle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// Of a dresspack as it is written [mm]; 0: not known.
double bore_of(const Node& dresspack);

struct PlacedPart {
  double helix_radius = 0;  ///< [m]
  double phase = 0;         ///< [rad]
};

/// (part) places in a bore around a core, radii [m]; nothing where they do not fit.
std::optional<std::vector<PlacedPart>> pack_in_bore(const std::vector<double>& radii, double bore, double core);

/// Replaces `place: auto` of a dresspack's components by helix_radius_mm and phase_deg; a component of several parts
/// becomes one component for each part where they do not lie evenly on one circle ("signal cable a", "signal cable b").
/// Precondition: data sheets are expanded. Problems, under `path`: the bore is not known, the parts do not fit (with the
/// bore that would do), other keys of the place are given, or parts without the key lie off the axis.
void expand_places(Node& dresspack, const std::string& path, Problems& problems);

}  // namespace dresslife::pipeline
