// Strain of a corrugated wall when the hose stretches (W22 of strain/theory.md).
//
// Along the hose, one corrugation is a thin folded beam: round crests and roots of mean radius r = pitch/4, joined by straight
// flanks across the hose. Let w = height - wall be the depth of the wall's middle surface and a = w/2 - r half a flank. A pull F
// (per length around the hose) bends the beam by M = F y, where y is measured from half height. Castigliano's theorem over four
// equal quarters (y = s along the flank, y = a + r sin(phi) around the crest) gives the stretch of one corrugation
//     e = 4 F J / D,   J = integral of y^2 ds = a^3/3 + r (pi a^2/2 + 2 a r + pi r^2/4)
// where D is the bending stiffness of the wall per length around the hose. The moment M = F w/2 at the crest strains its surfaces
// by M wall / (2 D). Divided by the hose's own strain e/pitch:
//     factor = wall pitch w / (16 J)                                                                   (W22)
// r -> 0 gives 1.5 wall pitch / w^2. The formula of the Expansion Joint Manufacturers for this stress, S6 = 5 E t e / (3 w^2
// C_d), has 5/3 instead of 1.5, which is 1.5 / (1 - nu^2) with nu = 0.3. The C_d of their chart for round crests is 24 J / w^3
// here (tests: 1.63 in a printed example, 1.70 here). The circumferential stiffness is neglected: it stiffens short corrugations
// of narrow hoses and so reduces the bending.
// Twist shears the wall along its unfolded length, which is longer than the pitch:
//     shear factor = pitch / (4 a + 2 pi r)                                                            (W23)
//
// Assumptions: wall thin against r, corrugation shallow against the hose's radius, material elastic.
// Sources: Castigliano; EJMA Standards, equations for unreinforced bellows. The factor applies to both surfaces of crest and
// root, with either sign.
#pragma once

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

struct WallFactors {
  double strain = 1;  ///< meridional strain at the surface of crest and root / strain of the hose
  double shear = 1;   ///< shear along the wall / shear of a smooth tube
  double radius = 0;  ///< at which the stretch by bending and the shear by twist are computed [m]
};

/// One corrugation.
struct Fold {
  double radius = 0;        ///< r, of crests and roots [m]
  double half_flank = 0;    ///< a [m]
  double compliance = 0;    ///< J [m3]
  double unfolded() const;  ///< length along the wall [m]
};
Fold fold_of(const Corrugation& profile);

/// Returns the factors of a dresspack's wall: those of hose_corrugation, otherwise hose_strain_factor at half the diameter.
/// Precondition: the dresspack was checked when the job was read.
WallFactors wall_factors(const Dresspack& dresspack);

}  // namespace dresslife::pipeline
