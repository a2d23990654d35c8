// How the dresspacks come onto the robot: the state in which a simulation starts.
//
// (R7) As an installer does it: the robot stands in the mounting pose; one dresspack after the other, and
// span by span from its base, the hose is held clear of the robot and of the dresspacks before it and
// clamped, its far end turned until it carries no torsion (unless that clamp has a roll), and let down until
// it rests on whatever it meets. Then the robot goes slowly to the first waypoint, which keeps whole turns of
// the hose. "Held clear": static equilibria under gravity as it is, absent, reversed and to either side are
// found without obstacles; the one that overlaps least is where the hose is let down from; all dresspacks are
// let down together.
#pragma once

#include <memory>

#include "sim/contact/world.h"
#include "sim/rod/rod.h"
#include "sim/run/clamp_path.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// All dresspacks in `state` among the links of the robot (null: none), in the guide rings and on the floor,
/// as the job says.
std::unique_ptr<World> make_world(const pipeline::Setup& setup, const Rod& rod, const RobotPath* robot,
                                  const RodState& state, const Pose& pose);

/// The chain at rest in the clamps of time 0. Turns the robot's clamps for good. robot: `path` if it is
/// one. Throws InputError at the routing when a hose cannot be clear of the robot and the other dresspacks,
/// is too short or does not come to rest.
RodState mount(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, RobotPath* robot);

}  // namespace dresslife::sim
