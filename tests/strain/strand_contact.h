// Bending of a strand whose layers touch where their wires cross (README W24): the model of
// tests/strain/strand_bending.h with equilibrium along each wire and contacts that give before they slide.
//
// All wires of a layer do the same, each at its own angle phi from the neutral axis, so a layer is one
// function of phi. Let u be how far a wire is displaced along itself against the plane section, kappa_i = 2
// pi / lay length the angle it turns per length. Then, per length of the strand and radian,
//     eps = R cos^2(alpha) kappa sin(phi) + kappa_i cos(alpha) du/dphi,
//     n E A kappa_i / (2 pi) d eps/dphi = tau_inner + tau_outer                                   (W24)
// where tau is what the crossings of an interface carry: K (u + u') while they stick, never more than mu
// times the radial load of all layers outside it. The displacements of the two layers add up: their hands
// differ, so where one moves forward the other moves back. That is why a layer's outer face holds it as well
// as its inner one. A crossing is a Hertz contact of two cylinders at the angle beta = alpha + alpha' with
// the equivalent radius sqrt(r r') / sin(beta); its radius a follows from the load, its tangential stiffness
// is Mindlin's 8 a G*. Against the core, which is straight, wires have contact lines: rigid.
//
// Left out: slip that grows inside a contact before the whole slides (Mindlin and Deresiewicz), contacts
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

  /// Layers lie in alternating hands, all but the core on helices. `outer_layers_press` does not
  /// count. Errors: InputError for a jacket's stiffness.
  StrandContact(const Strand& strand, Contacts contacts);

  /// The moment [N m] once the curvature [1/m], in one plane, has moved on to `curvature`.
  double moment(double curvature);

 private:
  struct Layer {
    double strain_per_curvature, moment_per_strain;  ///< at phi = pi/2; of the layer by its mean eps sin(phi)
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
