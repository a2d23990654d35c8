// Reduction of a part's strain by a soft jacket and by a soft bed (W30 and W31 of strain/theory.md).
#pragma once

namespace dresslife::helices {

/// Returns the rate at which a part turns about the bent cable that contains it [rad/m], per length of the part. A right-handed
/// lay (lay_angle > 0) is added to the rate of the parent (per length of the parent), a left-handed one is subtracted: a wire
/// whose hand differs from its conductor's stays longer on one side of the cable.
double turning(double of_parent, double lay_angle, double helix_radius);

/// Returns the length of a part over which the strain of a bend evens out (W10), one wave: 2 pi/|turning|. For two nested lays it
/// is 1/(1/p + 1/p') or 1/|1/p - 1/p'|. longest: upper limit, the length of the bend [m].
double evening_length(double turning, double longest);

/// Returns the share of a strain deviation that a jacket holds elastically (W30); friction acts on the rest. A jacket that fills
/// the gussets is a spring along the part's path, of jacket_stiffness k per length [N/m2]. For a wave over the evening length s
/// [m], the equilibrium k u = E A u'' gives the share k / (k + E A (2 pi/s)^2).
double elastic_share(double jacket_stiffness, double axial_stiffness, double evening_length);

/// Returns the share of a helix's strain that its bed leaves: 1 / (1 + E A sin^4(alpha)/(R^2 k_r)) (W31). A helix with tension T
/// presses its bed with T sin^2(alpha)/R per length. The bed deforms by 1/k_r of this (radial_stiffness k_r [N/m2]; infinite:
/// rigid), and the helix shortens by sin^2(alpha)/R of the deformation.
double radial_share(double axial_stiffness, double lay_angle, double helix_radius, double radial_stiffness);

}  // namespace dresslife::helices
