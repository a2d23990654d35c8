// Reads a robot from a URDF of its maker or of ROS, as the tree of a catalogue entry. It has the keys of a robot in YAML, each
// with its place in the URDF. So one description of keys is used to check, echo and document both, and a resolved job contains
// the whole robot.
//
// The chain from the root of the links to `tip` becomes the robot: 4 to 7 rotary axes (revolute, continuous), before them only
// sliding axes that carry the whole robot (prismatic: external axes). Links before the first sliding axis do not move
// (fixed_links). The shapes of links between two sliding axes are left out, with a warning. Links on fixed joints, and their
// shapes, become part of the link that carries them. A joint that mimics another one follows it, and its limits are added to
// those of the other. Links on joints that are not in the chain are left out.
//
// Collision shapes: box and mesh are unchanged (package:// and relative names). A sphere becomes a capsule of length 0. A
// cylinder becomes a capsule of the same length, and for its ends four boxes that cross at its axis: an octagon inside of the
// cylinder, within 8 % of the radius.
//
// A joint without <axis> has the axis x, the default of the specification. A continuous joint gets limits of +-100 turns. A URDF
// has no accelerations and no pose in the world.
// Source: http://wiki.ros.org/urdf/XML; read by urdfdom, which only urdf.cpp includes.
#pragma once

#include <string>

#include "pipeline/resolve/urdf_request.h"

namespace dresslife::pipeline {

/// Implements robot_from_urdf() for a URDF's text; request.urdf is its name. Errors: InputError at the line of the joint or link
/// in the URDF, if it is known.
Node robot_from_urdf(const UrdfRequest& request, const std::string& text);

}  // namespace dresslife::pipeline
