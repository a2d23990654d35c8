// Force of a cable for a given strain, and its strength (strain/theory.md, W37). A strain is credible only if the force that
// causes it is.
//
// A wire has a lay angle alpha at each level of the cable. Its strain is the cable's strain times the product of cos^2(alpha) and
// of the shares of soft beds (W31). It contributes its force times the product of cos(alpha). The stress
// of a metal wire follows its cyclic curve,
//     strain = sigma / E + (sigma / K')^(1/n')    (F7 of fatigue/theory.md),
// an increasing odd function. Insulation is neglected. A part without wires (plain_part.h) is elastic.
#pragma once

#include <vector>

#include "pipeline/job/dresspack.h"

namespace dresslife::pipeline {

class CableForce {
 public:
  CableForce() = default;
  CableForce(const Dresspack& dresspack, const Component& cable);

  double force(double strain) const;                ///< sum of A sigma [N]
  double strain_at(double force) const;             ///< inverse of force(), for a force of any sign [N]
  double strength() const { return strength_; }     ///< breaking force [N]; 0: unknown
  double mass_per_length() const { return mass_; }  ///< mass_of_part() (stiffness.h) [kg/m]
  /// E I [N m2]: cable_stiffness() of a cable, properties_of() of a part without wires.
  double bending_stiffness() const { return bending_; }

 private:
  /// The wires of one layer.
  struct Wires {
    double area;                                 ///< times the product of cos(alpha) [m2]
    double share;                                ///< strain of the wires / strain of the cable
    double modulus, cyclic_strength, hardening;  ///< E, K' [Pa], n'
    double stress(double strain) const;
  };
  void add(const Dresspack& dresspack, const Component& part, double count, double cosines, double share);

  std::vector<Wires> wires_;
  double strength_ = 0, mass_ = 0, bending_ = 0;
  bool all_strengths_known_ = true;
};

}  // namespace dresslife::pipeline
