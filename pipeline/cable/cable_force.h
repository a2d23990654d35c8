// The force of a cable from its strain, and what it bears (strain/README.md, W37): the principle is that a
// strain is believed only with the force that makes it.
//
// Wires at lay angles alpha, one for each level in the cable, have of its strain the product of cos^2(alpha) and of what soft
// beds leave (W31), and give it of their force the product of cos(alpha). A metal wire has the stress of its cyclic curve,
//     strain = sigma / E + (sigma / K')^(1/n')    (F7 of fatigue/README.md),
// rising and odd. Insulation counts nothing. A part without wires (plain_part.h) is elastic.
#pragma once

#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

class CableForce {
 public:
  CableForce() = default;
  CableForce(const Dresspack& dresspack, const Component& cable);

  double force(double strain) const;                ///< sum of A sigma [N]
  double strain_at(double force) const;             ///< its inverse, for a force of any sign [N]
  double strength() const { return strength_; }     ///< at which it tears [N]; 0: not known
  double mass_per_length() const { return mass_; }  ///< mass_of_part() (stiffness.h) [kg/m]
  /// E I: measured, else of its wires, each about its own axis, and of its polymer, given or a round of 50
  /// MPa: a cable whose parts slide past one another [N m2].
  double bending_stiffness() const { return bending_; }

 private:
  /// Wires of one layer.
  struct Wires {
    double area;                                 ///< times the cosines [m2]
    double share;                                ///< of the cable's strain
    double modulus, cyclic_strength, hardening;  ///< E, K' [Pa], n'
    double stress(double strain) const;
  };
  void add(const Dresspack& dresspack, const Component& part, double count, double cosines, double share);

  std::vector<Wires> wires_;
  double strength_ = 0, mass_ = 0, bending_ = 0;
  bool all_strengths_known_ = true;
};

}  // namespace dresslife::pipeline
