// What a soft jacket and a soft bed leave of a part's strain (W30 and W31 of strain/README.md).
#pragma once

namespace dresslife::helices {

/// Rate at which a part turns about the bent cable that holds it [rad/m], per length of the part. A right-handed
/// lay (lay_angle > 0) adds to that of the parent, per length of the parent, a left-handed one takes from it: a
/// wire whose hand differs from its conductor's stays longer on one side of the cable.
double turning(double of_parent, double lay_angle, double helix_radius);

/// Length of a part over which the strain of a bend evens out (W10), one wave: 2 pi/|turning|, of two nested
/// lays 1/(1/p + 1/p') or 1/|1/p - 1/p'|. longest: beyond which the bend itself does not go on [m].
double evening_length(double turning, double longest);

/// A jacket that fills the gussets holds a part by a spring along its path, of jacket_stiffness k per length
/// [N/m2]. Of a deviation that is a wave over the evening length s [m] it leaves to friction what equilibrium
/// k u = E A u'' leaves: the share k / (k + E A (2 pi/s)^2) is held elastically (W30).
double elastic_share(double jacket_stiffness, double axial_stiffness, double evening_length);

/// A helix that pulls with T presses its bed with T sin^2(alpha)/R per length; where that gives by 1/k_r of
/// it (radial_stiffness [N/m2]; infinite: rigid) the helix shortens by sin^2(alpha)/R of the give, so that of
/// its strain 1 / (1 + E A sin^4(alpha)/(R^2 k_r)) is left (W31).
double radial_share(double axial_stiffness, double lay_angle, double helix_radius, double radial_stiffness);

}  // namespace dresslife::helices
