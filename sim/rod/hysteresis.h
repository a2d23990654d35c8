// Hysteretic bending of a link: friction between parts and the loss of polymers, in addition to the elastic spring of (S2).
//
// (S19) bending moment = EI (kappa - kappa_0 + tau dkappa/dt) + sum over elements of K_i e_i, kappa and e_i about d1, d2
// (S20) friction (Jenkin):  e_i follows kappa and is limited to the length y_i: K_i y_i is the largest moment of the element
// (S21) polymer (Maxwell):  de_i/dt = dkappa/dt - e_i/tau_i
// The first bend follows M(kappa) = EI kappa + sum of K_i min(kappa, y_i), every later branch is this curve doubled (Masing).
// With the polymer's elements and tau the loss factor E''/E' equals the given one from 0.8 to 30 Hz, and E' equals the given
// stiffness at 1 Hz, where hoses swing. EI of (S19) is the remaining stiffness at rest.
// sim/rod/theory.md derives the discrete form and why it never gains energy. SI units.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace dresslife::sim {

/// A spring whose moment friction limits to stiffness * yield.
struct FrictionElement {
  double stiffness = 0;  ///< K [N m2]
  double yield = 0;      ///< y > 0 [1/m]
};

/// Memory of a link: its bend and the stretches of its elements, at the begin of the last step.
struct BendMemory {
  static constexpr int frictions = 4, relaxations = 3;
  Eigen::Vector2d bend = Eigen::Vector2d::Zero();                                        ///< kappa about d1, d2 [1/m]
  Eigen::Array<double, frictions, 2> held = Eigen::Array<double, frictions, 2>::Zero();  ///< e_i [1/m]
  Eigen::Array<double, relaxations, 2> relaxing = Eigen::Array<double, relaxations, 2>::Zero();  ///< e_i [1/m]
};

/// Elements of (S21) for a loss factor, for a stiffness of 1 at reference_frequency.
struct PolymerLoss {
  double elastic = 1;                                       ///< EI of (S19)
  std::array<double, BendMemory::relaxations> stiffness{};  ///< K_i
  double dashpot = 0;                                       ///< tau of (S19) [s]

  static constexpr std::array<double, BendMemory::relaxations> corner{0.9, 4, 18};  ///< 1/(2 pi tau_i) [Hz]
  static constexpr double reference_frequency = 1;                                  ///< [Hz]
};

/// Returns the least-squares solution of E'' - factor E' from 0.8 to 30 Hz. Precondition: 0 <= factor <= most_loss_factor. Up to
/// this limit no K_i is negative, and the loss factor is within 2 % of the given one from 1 to 30 Hz (tests).
PolymerLoss polymer_loss(double factor);
inline constexpr double most_loss_factor = 0.7;

/// The elements of one span for steps of one length. advance() and energy() are inline, in sim/rod/hysteresis_steps.h, because
/// their matrices cost 1 s of compile time in each source that includes them.
class Hysteresis {
 public:
  Hysteresis() = default;
  /// bending_stiffness: at 1 Hz, without friction [N m2]; friction: up to BendMemory::frictions elements; step [s].
  Hysteresis(double bending_stiffness, const std::vector<FrictionElement>& friction, double loss_factor, double step);

  /// Moves `memory` to this bend [1/m]. Returns the moment of all elements there [N m].
  Eigen::Vector2d advance(BendMemory& memory, const Eigen::Vector2d& bend) const;
  double energy(const BendMemory& memory) const;  ///< stored in the elements [J/m]
  double tangent() const { return tangent_; }     ///< change of moment per bend within a step, without sliding [N m2]
  double dashpot() const { return dashpot_; }     ///< tau of (S19) [s]

 private:
  using Frictions = Eigen::Array<double, BendMemory::frictions, 1>;
  using Relaxations = Eigen::Array<double, BendMemory::relaxations, 1>;
  Frictions friction_ = Frictions::Zero(), yield_ = Frictions::Ones();
  Relaxations polymer_ = Relaxations::Zero(), keep_ = Relaxations::Zero(), gain_ = Relaxations::Zero();
  double tangent_ = 0, dashpot_ = 0;
};

}  // namespace dresslife::sim
