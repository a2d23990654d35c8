// What a soft jacket and a soft bed leave of a part's strain (W30 and W31 of strain/README.md).
#pragma once

namespace dresslife::helices {

/// A jacket that fills the gussets holds a part by a spring along its path, of jacket_stiffness k per length
/// [N/m2]. Of a deviation that is a wave over the evening length s [m] it leaves to friction what equilibrium
/// k u = E A u'' leaves: the share k / (k + E A (2 pi/s)^2) is held elastically (W30).
double elastic_share(double jacket_stiffness, double axial_stiffness, double evening_length);

/// A helix that pulls with T presses its bed with T sin^2(alpha)/R per length; where that gives by 1/k_r of
/// it (radial_stiffness [N/m2]; infinite: rigid) the helix shortens by sin^2(alpha)/R of the give, so that of
/// its strain 1 / (1 + E A sin^4(alpha)/(R^2 k_r)) is left (W31).
double radial_share(double axial_stiffness, double lay_angle, double helix_radius, double radial_stiffness);

}  // namespace dresslife::helices
