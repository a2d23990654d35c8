// What a straight cable of nested helices answers to bending, pull and twist: M(curvature) with each
// conductor in the cable and each wire in the conductors held by friction (W29 of strain/README.md), and from
// a measured stiffness back to the friction; E A, G J and what couples them.
//
// The cable is deformed from straight for the first time, uniformly and by little. Every part and wire feels
// what the strain stage says (W6, W10, W11), to first order in the size x of that: its strain's deviation D x
// from the mean over its pitch, that mean m' x, its own bending and torsion. Along a part D is a wave, A sin(phi).
// Of the deviation h is held, elastically and by friction (W30, W16), and by virtual work, per length of the
// cable, the answer is:
//     sum over wires of [E I (k_n'^2 + k_b'^2) + G J t'^2 + E A m'^2] x
//         + sum over layers of their parts' E A x mean of h(phi) D(phi),                 (W29)
// ' per x. Part by part E A is that of all wires in it. What is held in a part shifts the levels inside by
// second order only, which is left out.
//
// Friction gathers from the neutral axis, phi = 0, as in (W20): a part whose force may change by mu p per length
// and that is bent for the first time has h(phi) = min(A x sin(phi), cap 2 phi/pi), with (W16)'s cap at
// phi = pi/2. The strain stage follows each wire through any history with that cap, which bounds the worst wire
// of a layer exactly and its others from above (friction.h). A^2 is twice the mean of D^2.
#pragma once

#include <vector>

#include "pipeline/cable/helix.h"
#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

/// E A of a part along its own axis, of its wires alone [N]. A helix of stiffness E A has E A cos^3(alpha)
/// along its parent: strain and force are cos^2 and cos of those along the parent. A soft bed leaves a share of it.
double axial_stiffness(const Dresspack& dresspack, const Component& part);

/// (W31) Share of a part's strain that the bed of its helix leaves; 1: a rigid bed.
double left_by_bed(const Dresspack& dresspack, const Component& part);

/// Straight parts off the axis of straight ones even out over the whole length: how much of a bend's strain
/// that leaves is a matter of the length and its ends.
enum class StraightParts { refused, slide };

class CableBending {
 public:
  /// cable: a component that holds parts, of this dresspack. Errors: InputError for straight parts off the
  /// axis of straight ones where these are refused; else they slide, and hold in stuck_stiffness() only.
  CableBending(const Dresspack& dresspack, const Component& cable,
               StraightParts straight = StraightParts::refused);

  /// Of one cable's wires [N m]. curvature [1/m]; friction_level: factor of every radial line load in it,
  /// besides what measured stiffnesses of parts in it say.
  double moment(double curvature, double friction_level) const;
  double free_stiffness() const;                 ///< nothing holds [N m2]
  double stuck_stiffness(int levels = 0) const;  ///< everything does, or the innermost `levels` alone [N m2]

 private:
  /// Parts or wires of a layer.
  struct HeldLayer {
    int depth = 0;         ///< levels below the cable, 1 = in it
    double stiffness = 0;  ///< E A x how many per length of the cable [N]
    double glued = 0;      ///< that x mean of D^2 [N m2]
    double share = 1;      ///< of the strain that the bed leaves (W31)
    double by_tension = 0, by_line_load = 0;  ///< the cap (W16), the latter at friction level 1
    double elastic = 0;                       ///< share held whatever the cap (W30)
  };
  int depth_ = 0;
  double own_stiffness_ = 0;  ///< of wires whose deviation is free [N m2]
  std::vector<HeldLayer> held_;
};

/// What a straight cable's wires answer to elongation and twist, per length of it: pull = pull_by_elongation
/// e + coupling t, torque = coupling e + torque_by_twist t. Slip within relieves none of it: both are alike
/// all along a lay.
struct PullAndTwist {
  double pull_by_elongation = 0;  ///< E A, twist held [N]
  double coupling = 0;            ///< [N m]
  double torque_by_twist = 0;     ///< G J, length held [N m2]
  double relaxed() const;         ///< G J where nothing pulls: it shortens as it is twisted [N m2]
};
PullAndTwist pull_and_twist(const Dresspack& dresspack, const Component& cable);

/// The common factor on the radial line loads in `cable` at which its wires and polymer together have its
/// measured_bending_stiffness at measured_at_curvature. Errors: InputError when no friction gives that.
double friction_level(const Dresspack& dresspack, const Component& cable);

/// Of the jacket and insulation of a cable this wide, where nothing is given [N m2].
double jacket_bending(double radius);
/// Of a part's jacket and insulation: given, else by its width. A measured stiffness has it in it.
double polymer_bending(const Component& part);
/// Of one cable by itself, moment over curvature at measured_at_curvature [N m2]: measured, else of its polymer
/// and its wires with their friction.
double cable_stiffness(const Dresspack& dresspack, const Component& cable);

/// What bends a cable by itself from straight for the first time [N m], its polymer included; friction:
/// factor of that of all its parts, besides what a measured stiffness says. curvature (bend) [1/m]. Errors:
/// InputError as above.
std::vector<double> bending_moments(const Dresspack& dresspack, Component cable, double friction,
                                    const std::vector<double>& curvature);

}  // namespace dresslife::pipeline
