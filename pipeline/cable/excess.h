// How much excess length fits into the room of a loose cable, and the force of what does not fit.
//
// A cable that is longer than its path by the share s is compressed by F / E A, and winds with the rest into a helix
// of radius c, the radius of its room:  (k c)^2 / 2 = s - F / E A. Its bending energy per length is
// E I (c k^2)^2 / 2 = 2 E I (s - F / E A)^2 / c^2, and F is the slope of that over s:
//     s = F / E A + F c^2 / (4 E I)
// (a pressed rod in a straight tube: Lubinski, Althouse and Logan 1962). Here F / E A is the strain of the cable's wires
// at F (cable_force.h).
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/job/setup.h"

namespace dresslife::pipeline {

/// Largest excess that a compressive force [N] keeps. room: c [m]; 0: none.
double excess_at_force(const CableForce& cable, double force, double room);
/// Compressive force of a cable that is too long by a share [N], the inverse of excess_at_force().
double force_of_excess(const CableForce& cable, double excess, double room);
/// Room in which a cable keeps this excess at this force [m]; 0: it needs none.
double room_of_excess(const CableForce& cable, double excess, double force);

/// A component of the dresspack that lies loose, with the least room that one of its parts has.
struct LooseRoom {
  const Component* component;
  double room;  ///< c [m]; infinite: nothing stops it
  bool in_ring;  ///< each of its parts turns around the hose's axis with its neighbours only (room.h)
};
std::vector<LooseRoom> loose_rooms(const Dresspack& dresspack);

/// Cables that are too long for their room even in the straight hose: no routing can cure that. Each warning names
/// the cable, its force over its strength, its room, and the slack_percent that fits.
std::vector<Warning> slack_warnings(const Dresspack& dresspack);

/// Slack with which a cable of a ring winds once around the hose's axis between two clamps: on a radius r and a length
/// L [m] a turn is longer by (2 pi r / L)^2 / 2. Then it lies as much on the outer as on the inner side of a bend that is
/// spread over the hose, which does not pull it. 0: its lay winds it so far, it is in no ring, or the dresspack has
/// other than two clamps. component: of the dresspack.
double winding_slack(const MountedDresspack& mounted, const Component& component);
/// What to lay instead of less than it needs to wind: usual_slack, or more. Where bends are short it needs some turns, and
/// usual_slack gives shipped dresspacks two to three.
double slack_to_lay(double winding_slack);

/// Cables on a robot that have less than half of the slack of one turn, so that bends of the hose pull them. Half: on
/// a KUKA KR 16 runs warned of forces at 0.4 of it and did not at 0.9. Short bends pull cables with more, of which only
/// a run warns. key: of the dresspack as a line of its job, for the remedy.
std::vector<Warning> tight_warnings(const std::string& key, const MountedDresspack& mounted);

/// What is wrong in the description of a dresspack, whatever its motion: values that no dresspack has, parts that
/// overlap, a stiffness that is not that of its parts, and, where its cables may slide, excess length without room.
std::vector<Warning> construction_warnings(const Dresspack& dresspack, bool may_slide);

/// The same with the key path of a job's line as the place of each part: "dresspack.components.2". key: of the dresspack.
std::vector<Warning> construction_warnings_at(const std::string& key, Dresspack dresspack, bool may_slide);

/// "0.05", a percentage rounded down to two digits: what fits.
std::string percent_below(double share);
/// "0.06": rounded up, what is needed.
std::string percent_above(double share);

}  // namespace dresslife::pipeline
