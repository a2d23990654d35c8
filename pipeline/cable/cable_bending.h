// Resistance of a straight cable of nested helices to bending, pull and twist. Bending: M(curvature), with friction at each
// conductor in the cable and each wire in the conductors (W29 of strain/theory.md), and the friction that explains a measured
// stiffness. Pull and twist: E A, G J and their coupling.
//
// The cable is deformed uniformly from straight, for the first time, by a small amount x. The strain of every part and wire is
// that of the strain stage (W6, W10, W11) to first order in x: the deviation D x from the mean over its pitch, the mean m' x, and
// its own bending and torsion. Along a part, D is a wave, A sin(phi). The part h of the deviation is held elastically and by
// friction (W30, W16). By virtual work, the generalised force per length of the cable is:
//     sum over wires of [E I (k_n'^2 + k_b'^2) + G J t'^2 + E A m'^2] x
//         + sum over layers of their parts' E A x mean of h(phi) D(phi),                 (W29)
// where ' means per x. A soft bed under a helix of parts adds its own energy (own_stiffness() in cable_bending.cpp). E A of a part is
// that of all wires in it. The part held at one level changes the inner levels only to second order, which is neglected.
//
// Friction accumulates from the neutral axis, phi = 0, as in (W20). A part whose force can change by mu p per length has in its
// first bend h(phi) = min(A x sin(phi), cap 2 phi/pi), with the cap of (W16) at phi = pi/2. The strain stage follows each wire
// through any history with this cap. It is exact for the worst wire of a layer and an upper bound for the others (friction.h).
// A^2 is twice the mean of D^2.
#pragma once

#include <vector>

#include "pipeline/cable/helix.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// Returns E A of a part along its own axis, only of its wires [N]. A helix of stiffness E A has E A cos^3(alpha) along its
/// parent: its strain is cos^2 of the parent's, and its force contributes with cos. A soft bed reduces the result (W31).
double axial_stiffness(const Dresspack& dresspack, const Component& part);

/// Returns the share of a part's strain that the bed of its helix leaves (W31); 1: a rigid bed.
double left_by_bed(const Dresspack& dresspack, const Component& part);

/// Treatment of straight parts off the axis of straight parts. Their strain evens out over the whole length, so the remaining
/// strain in a bend depends on the length and its ends.
enum class StraightParts { refused, slide };

class CableBending {
 public:
  /// cable: a component with parts, of this dresspack. Errors: InputError for straight parts off the axis of straight ones if
  /// these are refused. Otherwise they slide, and contribute only to stuck_stiffness().
  CableBending(const Dresspack& dresspack, const Component& cable, StraightParts straight = StraightParts::refused);

  /// Returns the moment of one cable's wires [N m]. curvature [1/m]. friction_level: factor of every radial line load in the
  /// cable, in addition to the factors from measured stiffnesses of its parts.
  double moment(double curvature, double friction_level) const;
  /// Returns the part of the moment by friction alone [N m]. For f times the friction of all parts it is f times that at 1/f times
  /// the curvature.
  double friction(double curvature, double friction_level) const;
  double free_stiffness() const;  ///< without friction [N m2]
  double stuck_stiffness(
      int levels = 0) const;  ///< if no part slides, or only the innermost `levels` do not slide [N m2]

 private:
  /// A layer of parts or wires.
  struct HeldLayer {
    int depth = 0;                            ///< levels below the cable; 1: in the cable
    double stiffness = 0;                     ///< E A times the number of parts per length of the cable [N]
    double glued = 0;                         ///< stiffness times the mean of D^2 [N m2]
    double share = 1;                         ///< of the strain that the bed leaves (W31)
    double by_tension = 0, by_line_load = 0;  ///< terms of the cap (W16); the second at friction level 1
    double elastic = 0;                       ///< share that is held elastically for any cap (W30)
  };
  int depth_ = 0;
  double own_stiffness_ = 0;  ///< of wires without resistance to their deviation [N m2]
  std::vector<HeldLayer> held_;
};

/// Pull and torque of a straight cable's wires per elongation e and twist t: pull = pull_by_elongation e + coupling t, torque =
/// coupling e + torque_by_twist t. Slip does not reduce them, because both deformations are uniform along a lay.
struct PullAndTwist {
  double pull_by_elongation = 0;  ///< E A at constant twist [N]
  double coupling = 0;            ///< [N m]
  double torque_by_twist = 0;     ///< G J at constant length [N m2]
  double relaxed() const;         ///< G J without pull: the cable shortens when it is twisted [N m2]
};
PullAndTwist pull_and_twist(const Dresspack& dresspack, const Component& cable);

/// Returns the common factor of the radial line loads in `cable` for which its wires and polymer together have
/// measured_bending_stiffness at measured_at_curvature. Errors: InputError if no friction gives this stiffness.
double friction_level(const Dresspack& dresspack, const Component& cable);

/// Returns E I of the jacket and insulation of a cable of this radius, for an unknown construction [N m2].
double jacket_bending(double radius);
/// Returns E I of a part's jacket and insulation: the given value, otherwise by its radius. A measured stiffness includes it.
double polymer_bending(const Component& part);
/// Returns moment / curvature of a single cable at measured_at_curvature [N m2]: the measured value, otherwise that of its
/// polymer and its wires with friction.
double cable_stiffness(const Dresspack& dresspack, const Component& cable);

/// Returns the moments that bend a single cable from straight for the first time [N m], (bend), including its polymer. friction:
/// factor of the friction of all its parts, in addition to the factor from a measured stiffness. curvature: (bend) [1/m]. Errors:
/// InputError like friction_level().
std::vector<double> bending_moments(const Dresspack& dresspack, const Component& cable, double friction,
                                    const std::vector<double>& curvature);

}  // namespace dresslife::pipeline
