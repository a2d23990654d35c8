// How each layer of components slides ((W10) and (W11) in strain/theory.md).
//
// `stick` glues a component to its parent. `free` lets it slide along its path without friction: its axial strain is the mean
// of its glued strain over the length within which the strain evens out:
//     (path length now) / (path length at rest) - 1   of this length.
// - clamp_to_clamp: a cable (a part of the first level that contains parts) of any lay. Its path, slack, friction and grips
//   decide (strain/cable_paths.h). Also components that are straight, or have fewer than four turns between the clamps, in
//   straight ancestors or in a cable: the mean over all segments.
// - over_pitch: other helices: the mean over the own phase, at the parent's state in the segment.
// - along_ancestor: components that are straight in a helical ancestor below the first level: the mean over the pitch of this
//   ancestor at constant own phase.
//
// `friction` keeps the mean of `free`. The deviation from it builds up to a cap (strain/friction.h). Bending and torsion of a
// component per path length do not change.
//
// The cap follows from the length over which the deviation evens out (evening_length): one wave about the bent cable, at most
// the length between the clamps. Nested lays of opposite hands make a long wave. The formula assumes a bend that is at least
// as long as this wave. Comparison with wires that slide as lines through a bend that changes over the wave length L
// (friction_lines_test.cpp): with an evening length of L/4 friction holds 1.0 to 1.2 times the cap, for glued strains up to
// four times the cap. Near L it holds up to 2.5 times the cap, because the strain then does not even out to the mean of this
// place. The cap counts with at most L.
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
  bool loose = false;     ///< a cable that lies where it rests (strain/cable_paths.h); false: held at its place
  FrictionCap cap;
  double evening = 0;       ///< with friction: length over which the strain evens out [m]
  double elastic = 0;       ///< with friction: share of the deviation that a jacket holds elastically (W30)
  double radial_share = 1;  ///< share of its strain that remains with the bed of the layer (W31)
  bool operator==(const LayerSlip&) const = default;
};

/// Returns one entry per layer of the construction. slip: one value for every level, or one per level, outermost first; the
/// last value holds for all deeper levels. free_length: of the dresspack from clamp to clamp, in a rig of the whole cable [m].
std::vector<LayerSlip> plan_slip(const Construction& construction, const std::vector<pipeline::Slip>& slip,
                                 double free_length);

/// Share of the wave length of a bend. The model is not accurate for strains that even out over a greater length.
constexpr double believable_evening = 0.25;

/// A plan whose friction gathers over at most one wave of the bend [m]. longest: of the layers on which friction has an effect,
/// the one with the greatest evening length; -1: none.
struct ShortenedPlan {
  std::vector<LayerSlip> plan;
  int longest = -1;
  double evening = 0;  ///< evening length of this layer before the limit [m]
};
ShortenedPlan shortened(const Construction& construction, std::vector<LayerSlip> plan, double bend_wave);

}  // namespace dresslife::strain
