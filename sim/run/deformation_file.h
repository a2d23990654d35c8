// A prescribed deformation from CSV: a header whose names carry the units, then one row per time and place.
//
//   t_s, position_m, kappa_1_1_per_m, kappa_2_1_per_m, twist_deg_per_m, elongation
//
// Columns in any order. t_s is needed, from 0 and increasing; rows of one time stand together, in the order
// of position_m, and every time has the same places; without position_m one row per time holds all along. At
// least one of the other columns is needed, what is absent is 0: twist_rad_per_m may stand for
// twist_deg_per_m, and tension_N for elongation, which it becomes by the dresspack's E A (prescribed.h).
// Every row becomes a sample of motion.h5 as it is; between places a value lies on a line, beyond the
// outermost it stays.
#pragma once

#include "sim/run/prescribed.h"

namespace dresslife::sim {

/// Errors: InputError at line and column of the file: unknown, doubled or missing columns, cells that are no
/// finite numbers, times or places out of order, a turn of more than 120 deg from one segment to the next, an
/// elongation beyond a half.
PrescribedDeformation read_deformation(const pipeline::Setup& setup);

/// The largest turn from the centre of one segment to that of the next: beyond, the way round is not clear
/// [rad].
inline constexpr double most_turn = 2 * EIGEN_PI / 3;

}  // namespace dresslife::sim
