// Mounting of the dresspacks on the robot: computes the state in which a simulation starts.
//
// (R7) The procedure of an installer: the robot stands in the mounting pose. One dresspack after the other, and
// span by span from its base, the hose is held without contact to the robot and the earlier dresspacks and is
// clamped. Its far end is rotated until it has no torsion (unless this clamp has a roll). Then it is released until
// it rests on the objects that it meets. Then the robot moves slowly to the first waypoint, which keeps full turns of
// the hose. "Held without contact": static equilibria are found without obstacles, under gravity after the hose was pulled a
// little to the left, or far to the side that routing.side states; then under gravity to a side and reversed. The first one
// without an overlap, else the one with the least, is the start of the release. All dresspacks are released together.
#pragma once

#include <memory>

#include "sim/contact/world.h"
#include "sim/rod/rod.h"
#include "sim/run/clamp_path.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// Returns a world with all dresspacks in `state`, the links of the robot (null: none), the guide rings and the floor of
/// the job.
std::unique_ptr<World> make_world(const pipeline::Setup& setup, const Rod& rod, const RobotPath* robot,
                                  const RodState& state, const Pose& pose);

/// Returns the chain at rest in the clamps of time 0. Rotates the robot's clamps permanently. robot: `path` if it is a robot's
/// path, else null. Throws InputError at the routing when a hose overlaps the robot or other dresspacks in every start,
/// is too short or does not come to rest.
RodState mount(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, RobotPath* robot);

}  // namespace dresslife::sim
