// Bending moment of a stranded conductor under tension, M(curvature) with hysteresis (W20 of strain/theory.md): the slip
// of W16 and W17 turned into a stiffness.
//
// Every wire feels R cos^2(alpha) kappa sin(theta) when glued; a slider at each angle holds of it what
// friction can. M = EI of the wires alone x kappa + sum over layers of K E A cos(alpha) R x mean(held
// sin(theta)). The cap grows from the neutral axis, where slip begins, in proportion to the angle from it, up
// to that of W16: the field of Papailiou's model. A wire is pressed by its own tension, T sin^2(alpha)/R, and,
// when `outer_layers_press`, by what the layers outside it press, with which it rubs on both of its sides. Jacket and tape press a layer
// and, through it, those inside; a jacket that fills the gussets holds a share elastically (W30).
//
// Source: K. Papailiou, IEEE Trans. Power Delivery 12 (1997); F. Foti and L. Martinelli, J. Sound Vib. 370
// (2016).
#pragma once

#include <vector>

#include "strain/friction.h"

namespace dresslife::strain {

struct StrandLayer {
  int count = 1;
  double wire_radius = 0;       ///< [m]
  double youngs_modulus = 0;    ///< [Pa]
  double helix_radius = 0;      ///< 0: the core wire [m]
  double lay_angle = 0;         ///< either hand [rad]
  double line_load = 0;         ///< by which jacket and tape press a wire of it inward [N/m]
  double jacket_stiffness = 0;  ///< of what holds a wire along its path (W30) [N/m2]
};

struct Strand {
  std::vector<StrandLayer> layers;  ///< innermost first
  double tension = 0;               ///< of the whole, shared by stiffness [N]
  double friction = 0;              ///< Coulomb, between wires
  bool outer_layers_press = true;
};

class StrandBending {
 public:
  explicit StrandBending(const Strand& strand);

  double slipped_stiffness() const { return own_stiffness_; }  ///< EI with every wire sliding freely [N m2]
  double stuck_stiffness() const;                              ///< EI with every wire glued [N m2]

  /// The moment [N m] once the curvature [1/m], in one plane, has moved on to `curvature`.
  double moment(double curvature);

 private:
  struct Fibre {  ///< wires of a layer around one angle of the first quarter; the other quarters mirror it
    double strain_per_curvature, moment_per_strain, cap, elastic;
    Slider slider;
  };
  double own_stiffness_ = 0;
  std::vector<Fibre> fibres_;
};

}  // namespace dresslife::strain
