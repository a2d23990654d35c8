// The stiffness of a filled hose from its contents: `bending_stiffness_Nm2: from_construction`, so that the
// simulation moves the hose whose wires the strain stage strains.
//
// Cables that lie straight in a hose share its bend and its twist, each about its own axis. What fills the
// middle and the wall share them, too:
//     E I = sum of (polymer + M(kappa) / kappa of its wires, cable_bending.h) + wall + core,
//     G J = sum of (2/3 polymer + its wires', its length free where it has slack) + wall + core,
//     E A = sum of its wires' where it has no slack                               + wall + core.
// What a cable off the axis gains in a bend it keeps or loses along the whole hose: that is a force from
// clamp to clamp (W34 of strain/README.md), no stiffness of the cross-section, and nothing where it has
// slack. Only glued cables (`stuck`) add E A R^2 / 2 to E I. Parts without wires (plain_part.h) count as
// polymer, in E A too.
//
// state: `sliding`, nothing rubs; `stuck`, nothing slides; `friction`, what friction and pressures hold at
// construction_curvature. That is the secant of the first bend. A bend to and fro between -kappa and kappa
// ends where the first bend did (Masing). In that state a simulated hose moves with the sliding stiffness and its friction
// beside it (bending_friction), never with the secant as a spring.
// Twist is alike all along a lay, so slip does not reduce it: G J has two values only.
//
// The wall of a corrugated hose is a folded beam (W22): pulled by F per length around, a corrugation gives by
// 4 F J / D, D = E wall^3 / 12, so that E A = 2 pi R pitch E wall^3 / (48 J), E I = E A R^2 / 2; twist shears
// it along its unfolded length: G J = 2 pi R^3 wall G pitch / (4 a + 2 pi r). A smooth wall is a tube.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Of one part [kg/m]: given properties_of() what is without wires (plain_part.h), else its wires of 8900
/// kg/m3, longer by their lays, in a polymer of 1200.
double mass_of_part(const Component& part);
/// Of the dresspack [kg/m]: its parts, as they are given or by mass_of_part(), and a polymer wall; what fills
/// its core and what flows in it is left out. Of what is no hose, a jacket fills what its parts leave.
double mass_of_construction(const Dresspack& dresspack);

struct HoseStiffness {
  double bending = 0;    ///< E I [N m2]
  double torsional = 0;  ///< G J [N m2]
  double axial = 0;      ///< E A [N]
};

/// Of the dresspack's construction in this state. curvature: of state `friction` [1/m]. Parts without
/// friction and pressures slide. Errors: InputError for a measured bending stiffness that no friction gives.
HoseStiffness stiffness_of_construction(const Dresspack& dresspack, SlipState state, double curvature);

/// What friction holds of a bend, as elements whose sum is the friction's share of M(kappa) at their own curvatures, and
/// less between them: F at four curvatures, from the first, where a third of all friction is held or, if that is
/// further, the elements together are nine times as stiff as the sliding hose, to the last, from which all slides.
/// sliding: E I of the hose [N m2].
std::vector<BendingFriction> friction_of_construction(const Dresspack& dresspack, double sliding);

/// What bends a straight hose for the first time [N m], (bend): E I without friction, and what friction holds, by a factor of it.
std::vector<double> bending_moments(const Dresspack& dresspack, double friction, const std::vector<double>& curvature);

/// The parts of the construction that those numbers leave out, as words: "what fills its core (...)". Empty:
/// nothing.
std::vector<std::string> missing_in_construction(const Dresspack& dresspack);

/// Sets the mass, the stiffnesses and the friction that the dresspack takes from its construction. Precondition: it is
/// checked (check_dresspack). Errors: InputError where that has none.
void take_from_construction(Dresspack& dresspack);

/// Warnings of these cases. Hose: the given E I differs by more than a factor of two from that of its parts with the
/// given friction and pressures, or is below that of its parts without friction. A value above is checked only if the
/// construction is complete. Cable with a jacket (the jacket's own stiffness is unknown): E I is below that of
/// sliding wires or above that of glued ones. Stiffnesses from an incomplete construction: a hose without its wall
/// has hardly any E A.
std::vector<Warning> stiffness_warnings(const Dresspack& dresspack);

/// For people: "E I 8.23 N m2 from construction (friction at 1 1/m); ...", one line for each of the three,
/// before them one for a mass from construction, ending with line feeds.
std::string stiffness_text(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
