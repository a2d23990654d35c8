// How much a corrugated wall is strained when the hose stretches (W22 of strain/README.md).
//
// Along the hose one corrugation is a thin beam folded to and fro: round crests and roots of mean radius r =
// pitch/4, joined by straight flanks across the hose. Let w = height - wall be the depth of the wall's middle
// surface and a = w/2 - r half a flank. Pulled by F (per length around the hose), the beam bends by M = F y,
// y from the line half-way up. Castigliano's theorem over four equal quarters (y = s along the flank, y = a +
// r sin(phi) around the crest) gives the stretch of one corrugation
//     e = 4 F J / D,   J = integral of y^2 ds = a^3/3 + r (pi a^2/2 + 2 a r + pi r^2/4)
// with D the bending stiffness of the wall per length around, and M = F w/2 at the crest strains its surfaces
// by M wall / (2 D). Over the hose's own strain e/pitch:
//     factor = wall pitch w / (16 J)                                                                   (W22)
// r -> 0 gives 1.5 wall pitch / w^2. The Expansion Joint Manufacturers' formula for the same stress, S6 = 5 E
// t e / (3 w^2 C_d), has 5/3 there, which is 1.5 / (1 - nu^2) with nu = 0.3; their chart's C_d for round
// crests is 24 J / w^3 here (tests: 1.63 in a printed example, 1.70 here). What the hoop adds is left out: it
// stiffens short corrugations of narrow hoses, which lowers the bending.
// Twist shears the wall along its unfolded length, which is longer than the pitch:
//     shear factor = pitch / (4 a + 2 pi r)                                                            (W23)
//
// Assumptions: wall thin against r, corrugation shallow against the hose's radius, material elastic.
// Sources: Castigliano; EJMA Standards, equations for unreinforced bellows; both surfaces of crest and root
// see the factor, with either sign.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

struct WallFactors {
  double strain = 1;  ///< meridional, at the surface of crest and root, over the strain of the hose
  double shear = 1;   ///< along the wall, over that of a smooth tube
  double radius = 0;  ///< at which stretch by bending and shear by twist are taken [m]
};

/// One corrugation.
struct Fold {
  double radius = 0;        ///< r, of crests and roots [m]
  double half_flank = 0;    ///< a [m]
  double compliance = 0;    ///< J [m3]
  double unfolded() const;  ///< length along the wall [m]
};
Fold fold_of(const Corrugation& profile);

/// Of the wall that the dresspack describes: by hose_corrugation, else hose_strain_factor at half the
/// diameter. Precondition: checked when the job was read.
WallFactors wall_factors(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
