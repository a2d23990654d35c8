// Beds of the cores of a cable, if a dresspack does not describe them.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Adds radial_stiffness_N_per_m2 to every part that has parts and is in a cable, unless it has the key: the stiffness of the
/// polymer between it and the cable's axis (polymer.h). Wires lie on wires, so their bed stays rigid. The lays of cables in a
/// hose cause little pressure, so these get no bed. The thesis has no beds, so nothing is added if strain.kinematics is thesis.
/// dresspack: a catalogue entry as written, with its data sheets expanded.
void add_beds(Node& dresspack, const Node& job);

}  // namespace dresslife::pipeline
