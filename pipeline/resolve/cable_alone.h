// A cable by itself, as it lies in a test rig: a dresspack that is nothing but one cable.
//
//   dresspack:
//     cable: {from: spot_welding, part: signal cable}     a cable of a dresspack of the catalogue
//     cable: sensor_cable                                 the same where it has but one, or is itself a cable
//     cable: {name: .., radius_mm: .., components: ..}    the cable itself; keys as in dresspack.components
//
// It lies on the axis, straight, so that its levels are those that it has in its dresspack: first the cable,
// then conductors, then wires. Where it lay among others, its slack, play and grips are left out. Stiffness,
// mass and damping may be absent: only a simulation needs them.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Whether a dresspack holds cables in a hose; else its parts are held by a jacket, and it is a cable itself.
bool is_hose(const Node& dresspack);

/// Names of the cables that a dresspack holds: its parts with parts, or its own name where it is a cable.
std::vector<std::string> cables_of(const Node& dresspack);

/// The dresspack that is one of those cables alone. part: its name; empty: the only one. asked: who wants it.
/// Errors: InputError with the names of the cables.
Node cable_alone(const Node& dresspack, const std::string& part, const Where& asked);

/// The same of the cable itself, keys as of a component.
Node cable_alone(const Node& cable);

}  // namespace dresslife::pipeline
