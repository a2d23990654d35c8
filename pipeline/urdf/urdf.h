// A robot that its maker or ROS describes as URDF, as the tree of a catalogue entry: the same keys as a robot
// in YAML, each with its place in the URDF. So one description of keys checks, echoes and documents both, and
// a resolved job holds the robot written out.
//
// From the tree of links the chain from its root to `tip` is taken: 4 to 7 axes that turn (revolute,
// continuous), before them at most sliding ones that carry the whole robot (prismatic: external axes). Links
// on fixed joints belong to the link that carries them, their shapes too; a joint that mimics another follows
// it, and its limits become the other's. Links on joints beside the chain are left out.
//
// Collision shapes: box and mesh as they are (package:// and relative names). A sphere becomes a capsule
// without length. A cylinder becomes a capsule of the same length, with four boxes that cross in its axis for
// its ends: an octagon inside it, within 8 % of the radius.
//
// A joint without <axis> turns about (or slides along) x, the default of the specification. A continuous joint gets +-100 turns. Accelerations and the pose in the world are not in a URDF.
// Source: http://wiki.ros.org/urdf/XML; read by urdfdom, which only urdf.cpp includes.
#pragma once

#include <string>

#include "pipeline/resolve/urdf_request.h"

namespace dresslife::pipeline {

/// robot_from_urdf() for a URDF's text; request.urdf names it. Errors: InputError at the line of the joint or
/// link in the URDF, as far as it is known.
Node robot_from_urdf(const UrdfRequest& request, const std::string& text);

}  // namespace dresslife::pipeline
