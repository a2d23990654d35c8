// Excess length of a loose cable in its room, and the compressive force of longer cables.
//
// A cable that is longer than its path by the share s is compressed by F / E A. The remaining excess winds it into a helix of
// radius c, the radius of its room:  (k c)^2 / 2 = s - F / E A. Its bending energy per length is E I (c k^2)^2 / 2 = 2 E I (s - F
// / E A)^2 / c^2, and F is the derivative of this energy with respect to s:
//     s = F / E A + F c^2 / (4 E I)
// (a compressed rod in a straight tube: Lubinski, Althouse and Logan 1962). F / E A is the strain of the cable's wires at F
// (cable_force.h).
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/job/setup.h"

namespace dresslife::pipeline {

/// Returns the largest excess in equilibrium with a compressive force [N]. room: c [m]; 0: no room.
double excess_at_force(const CableForce& cable, double force, double room);
/// Returns the compressive force of a cable with this excess [N], the inverse of excess_at_force().
double force_of_excess(const CableForce& cable, double excess, double room);
/// Returns the room in which a cable with this excess has this force [m]; 0: it needs no room.
double room_of_excess(const CableForce& cable, double excess, double force);

/// A loose component of the dresspack, with the smallest room of its parts.
struct LooseRoom {
  const Component* component;
  double room;   ///< c [m]; infinite: no limit
  bool in_ring;  ///< each of its parts can turn around the hose's axis only together with its neighbours (room.h)
};
std::vector<LooseRoom> loose_rooms(const Dresspack& dresspack);

/// Returns a warning for each cable that is too long for its room even in the straight hose, which no routing can cure. A warning
/// states the cable, its force as a share of its strength, its room, and the slack_percent that fits.
std::vector<Warning> slack_warnings(const Dresspack& dresspack);

/// Returns the slack with which a cable of a ring winds once around the hose's axis between two clamps. On a radius r and a
/// length L [m], one turn adds (2 pi r / L)^2 / 2. Then the cable is equally on the outer and the inner side of a uniform bend of
/// the hose, which does not pull it. 0: its lay makes this turn already, it is in no ring, or the dresspack does not have
/// exactly two clamps. component: of the dresspack.
double winding_slack(const MountedDresspack& mounted, const Component& component);
/// Returns the slack to propose if a cable has less than it needs to wind: at least usual_slack. With short bends it needs
/// several turns; usual_slack gives two to three in the shipped dresspacks.
double slack_to_lay(double winding_slack);

/// Returns a warning for each cable on a robot with less than half of the slack of one turn, so that bends of the hose pull it.
/// The factor of a half is from a KUKA KR 16: runs warned of forces at 0.4 of this slack, but not at 0.9. Short bends can pull
/// cables with more slack; only a run detects this. key: of the dresspack as a line of its job, for the remedy.
std::vector<Warning> tight_warnings(const std::string& key, const MountedDresspack& mounted);

/// Returns warnings about a dresspack that do not depend on its motion: implausible values, overlapping parts, a stiffness that
/// differs from that of its parts and, if cables may slide, excess length without room.
std::vector<Warning> construction_warnings(const Dresspack& dresspack, bool may_slide);

/// Returns construction_warnings() with a job's key path as the place of each part, "dresspack.components.2", and in remedies. key: of
/// the dresspack.
std::vector<Warning> construction_warnings_at(const std::string& key, Dresspack dresspack, bool may_slide);

/// Returns a percentage rounded down to two digits, for limits: "0.05".
std::string percent_below(double share);
/// Returns a percentage rounded up to two digits, for requirements: "0.06".
std::string percent_above(double share);

}  // namespace dresslife::pipeline
