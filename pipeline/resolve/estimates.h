// Estimates for missing keys of a dresspack.
//
// Each estimate is added to the document as if the user had written it, and is listed in dresspack.estimates, so that every
// output can mark it. The values and their sources are in config/defaults.md.
#pragma once

#include "pipeline/cable/believable.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Coulomb friction of parts of a cable on each other, of a cable on its hose, and of a hose on a robot. ESTIMATE: jackets on
/// conduits have 0.35 .. 0.5, lubricated 0.1, polyethylene on steel 0.12 .. 0.22.
inline constexpr double estimated_friction = 0.3;

/// Pressure of a jacket and its tapes on the parts inside; the line load of a part is proportional to its width [Pa]. ESTIMATE:
/// with estimated_friction, sensor_cable and control_cable have the friction moment of published jacketed cables: 16 kPa times
/// the cube of the diameter, the median of seven (10 .. 90 %: 7 .. 52 kPa).
inline constexpr double estimated_jacket_pressure = 0.17e6;

/// Excess length of a loose cable [%]. ESTIMATE: 2 cm in 2 m, which is the length that a twist of the hose by 0.5 rad takes from
/// a cable on its ring. Makers of dresspacks require cables without pull.
inline constexpr double estimated_slack = 100 * usual_slack;

/// Kelvin-Voigt time of twist [ms]. ESTIMATE: a damping ratio of 0.1 at 1.8 Hz.
inline constexpr double estimated_damping_time = 20;

/// Loss factor of bending in addition to friction, of a filled hose and of a jacketed cable. ESTIMATE: eight hanging cables
/// (Tiburzio and others 2024) swing as with 0.6 and the friction of their loops at rest; their damping ratios, extrapolated to a
/// hose, are 0.15 (10 .. 90 %: 0.06 .. 0.33).
inline constexpr double estimated_hose_loss = 0.3, estimated_cable_loss = 0.6;

/// Axial stiffness of a hose with cables if no part is known to carry a pull [N]. ESTIMATE: that of spot_welding, whose own mass
/// stretches it by less than 1e-3; a hose on a robot does not get longer.
inline constexpr double estimated_axial_stiffness = 1e5;

/// Adds estimates for the missing keys. dresspack: a catalogue entry as written, with its data sheets expanded. Values that
/// cannot be read are ignored; the reader of the settings reports them. on_robot: a robot moves it; on a rig a cable alone needs
/// neither mass nor stiffness.
void add_estimates(Node& dresspack, bool on_robot);

}  // namespace dresslife::pipeline
