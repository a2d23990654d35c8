// What the cores of a cable lie on, where a dresspack does not tell.
#pragma once

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Gives every part that holds parts and lies in a cable a radial_stiffness_N_per_m2, that of the polymer between it
/// and the cable's axis (polymer.h), unless it has one. Wires lie on wires: their bed stays rigid. Cables in a hose
/// have lays that press little. The thesis knows no bed: nothing is added where strain.kinematics is thesis.
/// dresspack: a catalogue entry as written, its data sheets expanded.
void add_beds(Node& dresspack, const Node& job);

}  // namespace dresslife::pipeline
