// Best estimates for the keys of a dresspack that its user left out.
//
// Each estimate is added to the document as if the user had written it, and is listed in dresspack.estimates,
// so that every output can mark it. The values and their sources stand in config/defaults.md.
#pragma once

#include "pipeline/cable/believable.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Coulomb friction of parts of a cable on each other, of a cable on its hose, and of a hose on a robot.
/// ESTIMATE: jackets on conduits 0.35 .. 0.5, lubricated 0.1, polyethylene on steel 0.12 .. 0.22.
inline constexpr double estimated_friction = 0.3;

/// Pressure of a jacket and its tapes on the parts inside, on each by its width [Pa]. ESTIMATE: with estimated_friction
/// sensor_cable and control_cable then have the friction moment of published jacketed cables, 16 kPa times the cube
/// of the diameter, the median of seven (10 .. 90 %: 7 .. 52 kPa).
inline constexpr double estimated_jacket_pressure = 0.17e6;

/// Excess length of a loose cable [%]. ESTIMATE: 2 cm in 2 m, as much as a turn of the hose by 0.5 rad takes
/// from a cable on its ring. Makers of dresspacks ask for cables that feel no pull.
inline constexpr double estimated_slack = 100 * usual_slack;

/// Kelvin-Voigt time of twist [ms]. ESTIMATE: a damping ratio of 0.1 at 1.8 Hz.
inline constexpr double estimated_damping_time = 20;

/// Loss factor of bending besides friction, of a filled hose and of a jacketed cable. ESTIMATE: eight hanging cables
/// (Tiburzio and others 2024) swing as with 0.6 and the friction of their loops at rest; their damping ratios extrapolated to
/// a hose are 0.15 (10 .. 90 %: 0.06 .. 0.33).
inline constexpr double estimated_hose_loss = 0.3, estimated_cable_loss = 0.6;

/// Axial stiffness of a hose with cables of which none is known to carry [N]. ESTIMATE: that of spot_welding, whose own
/// mass stretches it by less than 1e-3; a hose on a robot does not get longer.
inline constexpr double estimated_axial_stiffness = 1e5;

/// Adds what is missing. dresspack: a catalogue entry as written, its data sheets already expanded. What
/// cannot be read is left for the reader of the settings, which reports it.
void add_estimates(Node& dresspack);

}  // namespace dresslife::pipeline
