// Stiffness of a filled hose from its contents: `bending_stiffness_Nm2: from_construction`. Then the simulation and the strain
// stage use the same hose.
//
// Cables that lie straight in a hose are bent and twisted with it, each about its own axis. The core and the wall are bent and
// twisted too:
//     E I = sum of (polymer + M(kappa) / kappa of its wires, cable_bending.h) + wall + core,
//     G J = sum of (2/3 polymer + that of its wires, at free length if it has slack) + wall + core,
//     E A = sum of that of its wires if it has no slack                              + wall + core.
// The layers of a single cable without a hose have G J together at the cable's free length.
// The elongation of a cable off the axis in a bend is constant along the whole hose. It is a force from clamp to clamp (W34 of
// strain/theory.md), not a stiffness of the cross-section, and 0 with slack. Only glued cables (`stuck`) add E A R^2 / 2 to E I.
// Parts without wires (plain_part.h) count as polymer, also in E A.
//
// state: `sliding`: no friction; `stuck`: no sliding; `friction`: friction and pressures at construction_curvature. `friction` is
// the secant of the first bend. A cyclic bend between -kappa and kappa has the same end points (Masing). A simulated hose in this
// state has the sliding stiffness and a friction in parallel (bending_friction), never the secant as a spring. Twist is uniform
// along a lay, so slip does not reduce it: G J has only two values.
//
// The wall of a corrugated hose is a folded beam (W22). A pull F per length around the hose stretches a corrugation by 4 F J / D,
// D = E wall^3 / 12, so E A = 2 pi R pitch E wall^3 / (48 J), E I = E A R^2 / 2. Twist shears it along its unfolded length: G J =
// 2 pi R^3 wall G pitch / (4 a + 2 pi r). A smooth wall is a tube.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Returns the mass of one part [kg/m]: properties_of() of a part without wires (plain_part.h), otherwise that of wires with the
/// densities of their materials along their lays in a polymer of 1200 kg/m3.
double mass_of_part(const Dresspack& dresspack, const Component& part);
/// Returns the mass of the dresspack [kg/m]: its parts (given, or by mass_of_part()), its wall and its sleeve, without the core and
/// the contents of hoses. If it is no hose, a jacket fills the space between its parts. Wall and sleeve without a density have 1200
/// kg/m3.
double mass_of_construction(const Dresspack& dresspack);

struct HoseStiffness {
  double bending = 0;    ///< E I [N m2]
  double torsional = 0;  ///< G J [N m2]
  double axial = 0;      ///< E A [N]
};

/// Returns the stiffness of the dresspack's construction in this state. curvature: of state `friction` [1/m]. Parts without
/// friction or pressure slide. Errors: InputError for a measured bending stiffness that no friction gives.
HoseStiffness stiffness_of_construction(const Dresspack& dresspack, SlipState state, double curvature);

/// Returns the moments that bend a straight hose for the first time [N m], (bend): E I without friction, plus `friction` times
/// the friction. curvature: (bend) [1/m].
std::vector<double> bending_moments(const Dresspack& dresspack, double friction, const std::vector<double>& curvature);

/// Returns the keys of a hose's wall, with usual values, if E I from the construction lacks this wall: "hose_material:
/// hose_polyamide and hose_corrugation: {...}". Empty: nothing is missing, or the dresspack is a cable.
std::string missing_wall(const Dresspack& dresspack);

/// Returns the parts of the construction that are missing in these numbers, in words: "what fills its core (...)". Empty: none.
std::vector<std::string> missing_in_construction(const Dresspack& dresspack);

/// Sets the mass, the stiffnesses and the friction that the dresspack computes from its construction. A bending stiffness as a
/// number without bending_friction gets the friction of the parts, if that is more than a tenth. Precondition: check_dresspack().
/// Errors: InputError if the construction is missing.
void take_from_construction(Dresspack& dresspack);

/// Returns warnings. Hose: the given E I differs by more than a factor of two from that of its parts with the given friction and
/// pressures, or is below that of its parts without friction. A value above is checked only if the construction is complete.
/// Cable in a jacket (whose own stiffness is unknown): E I is below that of sliding wires or above that of glued ones.
/// Stiffnesses from an incomplete construction: a hose without its wall has almost no E A.
std::vector<Warning> stiffness_warnings(const Dresspack& dresspack);

/// Returns lines for people: "E I 8.23 N m2 from construction (friction at 1 1/m); ...", one for each of the three stiffnesses. A
/// line for a mass from construction comes first. Each line ends with a line feed.
std::string stiffness_text(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
