// Bending moment of a cable, M(curvature): conductors in the cable, wires in the conductors, each held by
// friction (README W29); and from a measured stiffness back to the friction.
//
// The cable is bent from straight for the first time, in one plane. Every part and wire feels what the strain
// stage says (W6, W10, W11), to first order in the curvature kappa: its strain's deviation D kappa from the
// mean over its pitch, that mean, its own bending and torsion. Of the deviation h(D kappa) is held,
// elastically and by friction (W16, W17, W30), and by virtual work, per length of the cable,
//     M = sum over wires of [E I (k_n'^2 + k_b'^2) + G J t'^2 + E A m'^2] kappa
//         + sum over parts and wires of E A h(D kappa) D,                                    (W29)
// ' per curvature, m the mean strain (twist of a conductor stretches its wires). Part by part E A is that of
// all wires in it. What is held in a part shifts the levels inside by second order only, which is left out.
#pragma once

#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::strain {

class CableBending {
 public:
  /// cable: a component that holds parts, of this dresspack. Errors: InputError for straight parts off the
  /// axis of straight ones: how far they slide is a matter of the sample's length.
  CableBending(const pipeline::Dresspack& dresspack, const pipeline::Component& cable);

  /// Of one cable's wires [N m]. curvature [1/m]; friction_level: factor of every radial line load in it.
  double moment(double curvature, double friction_level) const;
  double free_stiffness() const;                 ///< nothing holds [N m2]
  double stuck_stiffness(int levels = 0) const;  ///< everything does, or the innermost `levels` alone [N m2]

 private:
  /// Parts or wires of a layer at one angle.
  struct Held {
    int depth;                        ///< levels below the cable, 1 = in it
    double strain_rate;               ///< D [m]
    double moment_per_strain;         ///< E A D x how many per length of the cable [N m]
    double by_tension, by_line_load;  ///< the cap (W16), the latter at friction level 1
    double elastic;                   ///< share held whatever the cap (W30)
  };
  struct Bent;
  void add(const pipeline::Dresspack& dresspack, const pipeline::Component& layer, const Bent& parent);

  double own_stiffness_ = 0;  ///< of wires whose deviation is free [N m2]
  int depth_ = 0;
  std::vector<Held> held_;
};

/// The common factor on the radial line loads in `cable` at which its wires and polymer together have its
/// measured_bending_stiffness at measured_at_curvature. Errors: InputError when no friction gives that.
double friction_level(const pipeline::Dresspack& dresspack, const pipeline::Component& cable);

/// What bends a cable by itself from straight for the first time [N m], its polymer included; friction: factor of that of all its
/// parts, besides what a measured stiffness says. curvature (bend) [1/m]. Errors: InputError as above.
std::vector<double> bending_moments(const pipeline::Dresspack& dresspack, pipeline::Component cable, double friction,
                                    const std::vector<double>& curvature);

}  // namespace dresslife::strain
