// Bending moment of a stranded conductor under tension, M(curvature) with hysteresis (W20 of strain/theory.md): the stiffness
// that follows from the slip of W16 and W17.
//
// A glued wire has the strain R cos^2(alpha) kappa sin(theta). A slider at each angle holds the part of it that friction
// allows. M = EI of the wires alone x kappa + sum over layers of K E A cos(alpha) R x mean(held sin(theta)). The friction
// limit grows in proportion to the angle from the neutral axis, where slip begins, up to the limit of W16: the field of
// Papailiou's model. A wire is pressed inward by its own tension, T sin^2(alpha)/R. With `outer_layers_press` the pressure of
// the layers outside is added, and the wire rubs with that pressure on both of its sides. Jacket and tape press a layer and,
// through it, the layers inside. A jacket that fills the gussets holds a share elastically (W30).
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
  double line_load = 0;         ///< inward pressure of jacket and tape on one wire [N/m]
  double jacket_stiffness = 0;  ///< stiffness of the material that holds a wire along its path (W30) [N/m2]
};

struct Strand {
  std::vector<StrandLayer> layers;  ///< innermost first
  double tension = 0;               ///< of the whole strand, shared among the wires by stiffness [N]
  double friction = 0;              ///< Coulomb coefficient between wires
  bool outer_layers_press = true;
};

class StrandBending {
 public:
  explicit StrandBending(const Strand& strand);

  double slipped_stiffness() const { return own_stiffness_; }  ///< EI if every wire slides without friction [N m2]
  double stuck_stiffness() const;                              ///< EI if every wire is glued [N m2]

  /// Changes the curvature [1/m], in one plane, to `curvature`. Returns the moment [N m].
  double moment(double curvature);

 private:
  struct Fibre {  ///< wires of a layer at one angle of the first quarter; the other quarters mirror it
    double strain_per_curvature, moment_per_strain, cap, elastic;
    Slider slider;
  };
  double own_stiffness_ = 0;
  std::vector<Fibre> fibres_;
};

}  // namespace dresslife::strain
