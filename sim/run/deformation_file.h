// A prescribed deformation from CSV: a header whose names carry the units, then one row per time and place.
//
//   t_s, position_m, kappa_1_1_per_m, kappa_2_1_per_m, twist_deg_per_m, elongation
//
// Columns may have any order. t_s is required, from 0 and increasing. Rows of one time are consecutive, in the order
// of position_m, and every time has the same places; without position_m one row per time is valid for the whole length. At
// least one of the other columns is required; an absent column is 0. twist_rad_per_m may replace
// twist_deg_per_m, and tension_N may replace elongation, to which it is converted by the dresspack's E A (prescribed.h).
// Every row becomes an unchanged sample of motion.h5. Between places a value is interpolated linearly; beyond the
// outermost places it is constant.
#pragma once

#include "sim/run/prescribed.h"

namespace dresslife::sim {

/// Reads a deformation. Errors: InputError with line and column of the file: unknown, repeated or missing columns, cells that are
/// no finite numbers, times or places in wrong order, a rotation of more than 120 deg from one segment to the next, an
/// elongation beyond 0.5.
PrescribedDeformation read_deformation(const pipeline::Setup& setup);

/// Warns of a deformation of a file whose times may be in another unit: the strain at the surface changes too fast or too slowly.
std::vector<pipeline::Warning> doubts_of_times(const PrescribedDeformation& deformation, const pipeline::Setup& setup);

/// Largest rotation between the centres of two successive segments [rad]: beyond it the direction of rotation is ambiguous.
inline constexpr double most_turn = 2 * EIGEN_PI / 3;

}  // namespace dresslife::sim
