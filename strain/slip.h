// Which way each layer of components slides (README W10, W11).
//
// `stick` glues a component to its parent. `free` lets it slide along its path without friction: its axial
// strain is then the mean of its glued strain over the length within which it evens out,
//     (path length now) / (path length at rest) - 1   of that length.
// - over_pitch: a helix shorter than the free length: the mean over its own phase, at the parent's state in
// the segment.
// - clamp_to_clamp: straight (or a pitch beyond the free length) in straight ancestors: the mean over all
// segments.
// - along_ancestor: straight in a helical ancestor: the mean over that ancestor's pitch, its own phase held.
// `friction` keeps the mean of `free` and lets the deviation from it build up to a cap (strain/friction.h).
// A component's bending and torsion per path length stay as they are.
#pragma once

#include <vector>

#include "pipeline/job/strain.h"
#include "strain/construction.h"

namespace dresslife::strain {

enum class Sliding { glued, over_pitch, clamp_to_clamp, along_ancestor };

/// Largest deviation of the strain from its mean that friction can hold (README W16): constant + per_mean x
/// mean, not below 0. The mean strain is what tension the part has beyond that at rest.
struct FrictionCap {
  double constant = 0, per_mean = 0;
  bool operator==(const FrictionCap&) const = default;
};

struct LayerSlip {
  Sliding sliding = Sliding::glued;
  int helical_level = 0;  ///< of along_ancestor: level of the nearest helical ancestor
  bool friction = false;  ///< slides only when its deviation from the mean reaches the cap
  FrictionCap cap;
  bool operator==(const LayerSlip&) const = default;
};

/// One entry per layer of the construction. slip: one for every level or one per level, outermost first; the
/// last holds for all deeper ones. free_length: of the dresspack between the clamps [m].
std::vector<LayerSlip> plan_slip(const Construction& construction, const std::vector<pipeline::Slip>& slip,
                                 double free_length);

}  // namespace dresslife::strain
