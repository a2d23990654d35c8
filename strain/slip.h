// Which way each layer of components slides (README W10, W11).
//
// `stick` glues a component to its parent. `free` lets it slide along its path without friction: its axial
// strain is then the mean of its glued strain over the length within which it evens out,
//     (path length now) / (path length at rest) - 1   of that length:
// - clamp_to_clamp: a cable (a part of the first level that holds parts), whatever its lay: its path, its
//   slack, friction and grips decide (strain/cable_paths.h). And what is straight, or has fewer than four
//   turns between the clamps, in straight ancestors or in a cable: the mean over all segments.
// - over_pitch: other helices: the mean over its own phase, at the parent's state in the segment.
// - along_ancestor: straight in a helical ancestor below the first level: the mean over that ancestor's
//   pitch, its own phase held.
//
// `friction` keeps the mean of `free` and lets the deviation from it build up to a cap (strain/friction.h).
// A component's bending and torsion per path length stay as they are.
//
// The cap follows from the length over which the deviation evens out (evening_length): one wave about the bent
// cable, of which nested lays of opposite hands make a long one. The wave is taken as if the bend were as long.
// Against wires that slide as lines through a bend that changes over the wave length L (friction_lines_test.cpp)
// friction then holds, of a quarter of L, 1.0 to 1.2 times as much as the cap says, where the glued strain is up to
// four times the cap. Near L itself it is up to 2.5 times as much: what evens out is no longer the mean of this
// place. The cap never counts with more than L.
#pragma once

#include <vector>

#include "pipeline/job/strain.h"
#include "strain/construction.h"
#include "strain/sliding.h"

namespace dresslife::strain {

struct LayerSlip {
  Sliding sliding = Sliding::glued;
  int helical_level = 0;  ///< of along_ancestor: level of the nearest helical ancestor
  bool friction = false;  ///< slides only when its deviation from the mean reaches the cap
  bool loose = false;     ///< a cable that lies where it rests (strain/cable_paths.h); else at its place
  FrictionCap cap;
  double evening = 0;       ///< with friction: length over which the strain evens out [m]
  double elastic = 0;       ///< with friction: share of the deviation that a jacket holds elastically (W30)
  double radial_share = 1;  ///< of its strain that the bed of the layer leaves (W31)
  bool operator==(const LayerSlip&) const = default;
};

/// One entry per layer of the construction. slip: one for every level or one per level, outermost first; the
/// last holds for all deeper ones. free_length: of the dresspack from clamp to clamp [m], in a rig of the whole cable.
std::vector<LayerSlip> plan_slip(const Construction& construction, const std::vector<pipeline::Slip>& slip,
                                 double free_length);

/// Of the wave length of a bend: the model is not accurate for strains that even out over more.
constexpr double believable_evening = 0.25;

/// The same with friction that gathers over no more than a wave of the bend [m], and the layer that
/// friction holds and whose strain evens out over most of that; -1: none.
struct ShortenedPlan {
  std::vector<LayerSlip> plan;
  int longest = -1;
  double evening = 0;  ///< of that layer, before [m]
};
ShortenedPlan shortened(const Construction& construction, std::vector<LayerSlip> plan, double bend_wave);

}  // namespace dresslife::strain
