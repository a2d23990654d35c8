// The arc of a CIRC through the start, a point on the way and the target; its length by an angle (CA); and the
// tool's rotation along it.
#pragma once

#include <optional>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim::krl {

struct Arc {
  Vector3 centre, axis;  ///< centre [m]; unit vector, the motion is a positive rotation about it
  double angle;          ///< from the first point through the second to the third [rad], 0 to 2 pi
};

/// Returns the arc through three points [m]; std::nullopt: two points coincide, or all lie on a line.
std::optional<Arc> arc_through(const Vector3& first, const Vector3& second, const Vector3& third);

/// Returns poses along the arc, from the pose `start` on it over `angle` [rad]. The arc is divided into steps of less
/// than half a circle; each step gives its middle and its end pose. turning: the tool turns with the path (#PATH),
/// else it keeps its orientation.
std::vector<Frame> poses_along(const Arc& arc, const Frame& start, double angle, bool turning);

}  // namespace dresslife::sim::krl
