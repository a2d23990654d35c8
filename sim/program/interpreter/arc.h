// The arc of a CIRC: through the start, a point on the way and the target, or on along that circle by an
// angle (CA), and how the tool turns along it.
#pragma once

#include <optional>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim::krl {

struct Arc {
  Vector3 centre, axis;  ///< [m]; the way is positive about the axis
  double angle;          ///< from the first point over the second to the third [rad], 0 to 2 pi
};

/// Absent: two of the points are one, or all lie on a line.
std::optional<Arc> arc_through(const Vector3& first, const Vector3& second, const Vector3& third);

/// Poses of a way by `angle` along the arc from a pose on it, in steps of less than half a circle: one on the
/// way and one at the end of each step. The tool keeps its orientation, or turns with the way (#PATH).
std::vector<Frame> poses_along(const Arc& arc, const Frame& start, double angle, bool turning);

}  // namespace dresslife::sim::krl
