// Bending of a strand whose layers touch where their wires cross (strain/theory.md, W24): the model of
// tests/strain/strand_bending.h with equilibrium along each wire and contacts that deform before they slide.
//
// All wires of a layer behave alike, each at its own angle phi from the neutral axis, so a layer is one function of phi. Let
// u be a wire's displacement along itself against the plane section, and kappa_i = 2 pi / lay length the angle that the wire
// turns per length. Then, per length of the strand and radian,
//     eps = R cos^2(alpha) kappa sin(phi) + kappa_i cos(alpha) du/dphi,
//     n E A kappa_i / (2 pi) d eps/dphi = tau_inner + tau_outer                                   (W24)
// where tau is the shear force that the crossings of an interface transmit: K (u + u') while they stick, at most mu times
// the radial load of all layers outside the interface. The displacements of the two layers add up because the layers have
// opposite hands: where one layer moves forward, the other moves back. Therefore a layer's outer face holds it as well as its
// inner face. A crossing is a Hertz contact of two cylinders at the angle beta = alpha + alpha' with the equivalent radius
// sqrt(r r') / sin(beta). Its contact radius a follows from the load; its tangential stiffness is Mindlin's 8 a G*. Wires
// have contact lines with the straight core: this contact is rigid.
// Not modelled: slip that grows inside a contact before the whole contact slides (Mindlin and Deresiewicz), contacts
// flattened by yielding (larger, stiffer), contact between the wires of a layer.
//
// Source: R. D. Mindlin, J. Appl. Mech. 16 (1949); the idea for conductors: J.-P. Paradis and F. Legeron,
// Modelling of the free bending behavior of a multilayer cable taking into account the tangential compliance
// of contact interfaces.
#pragma once

#include <vector>

#include "tests/strain/strand_bending.h"

namespace dresslife::strain {

class StrandContact {
 public:
  enum class Contacts { elastic, rigid };

  /// Adjacent layers have opposite hands. All layers except the core are helices. `outer_layers_press` is ignored.
  /// Errors: InputError if a layer has a jacket's stiffness.
  StrandContact(const Strand& strand, Contacts contacts);

  /// Changes the curvature [1/m], in one plane, to `curvature`. Returns the moment [N m].
  double moment(double curvature);

 private:
  struct Layer {
    double strain_per_curvature, moment_per_strain;  ///< at phi = pi/2; moment of the layer per mean of eps sin(phi)
    double gradient;                                 ///< kappa_i cos(alpha) [1/m]
    double force;                                    ///< n E A kappa_i / (2 pi) [N/m]
  };
  struct Interface {  ///< between layer j - 1 (0: the core) and layer j
    double stiffness, cap;
    std::vector<double> slip;  ///< (node)
    std::vector<int> sliding;  ///< (node) -1, 0, 1
  };
  std::vector<std::vector<double>> displacements(double curvature) const;
  double traction(const Interface& interface, std::size_t node, double displacement) const;
  bool settle(const std::vector<std::vector<double>>& u);

  double own_stiffness_ = 0;
  std::vector<Layer> layers_;          ///< innermost first
  std::vector<Interface> interfaces_;  ///< inner face of each layer
};

}  // namespace dresslife::strain
