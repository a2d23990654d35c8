// A single cable, as in a test rig: a dresspack that consists of one cable.
//
//   dresspack:
//     cable: {from: spot_welding, part: signal cable}     a cable of a dresspack of the catalogue
//     cable: sensor_cable                                 for a dresspack with one cable, or one that is a cable
//     cable: {name: .., radius_mm: .., components: ..}    the cable itself; keys as in dresspack.components
//
// The cable is straight on the axis, so its levels are the same as in its dresspack: cable, conductors, wires. Its keys for a
// place among other cables (slack, play, grips) are removed. Stiffness, mass and damping may be absent, because only a simulation
// needs them.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Returns whether a dresspack has cables in a hose; otherwise a jacket holds its parts, and it is a cable itself.
bool is_hose(const Node& dresspack);

/// Returns the names of a dresspack's cables: its parts that have parts, or its own name if it is a cable.
std::vector<std::string> cables_of(const Node& dresspack);

/// Returns a dresspack that consists of one of these cables. part: name of the cable; empty: the only one. asked: place of the
/// request. Errors: InputError with the names of the cables.
Node cable_alone(const Node& dresspack, const std::string& part, const Where& asked);

/// Returns a dresspack that consists of this cable, which has the keys of a component.
Node cable_alone(const Node& cable);

}  // namespace dresslife::pipeline
