// Stress along a strain path: elastic, or of a metal that has reached its stable cyclic curve.
//
// Cyclic curve (Ramberg and Osgood 1943), (F2):        eps = s / E + (s / K')^(1 / n')
// Branches (Masing 1926), (F3):                        d_eps / 2 = curve(d_s / 2), from the last open reversal
// Material memory (Clormann and Seeger 1985), (F4):    a strain beyond the largest |strain| so far lies on the cyclic curve
// itself. A branch that returns to the reversal below its origin closes this loop, and the interrupted branch continues as
// without the loop. Assumptions: one axis, stable metal (no softening; relaxation.h adds the relaxation of mean stress), equal in
// tension and compression.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/fatigue.h"
#include "pipeline/job/material.h"

namespace dresslife::fatigue {

/// (F2) for strain and stress of either sign.
class CyclicCurve {
 public:
  /// Precondition: E > 0, K' > 0, 0 < n' <= 1.
  CyclicCurve(double youngs_modulus, double strength, double hardening_exponent);
  /// Uses K' and n' of the material. Missing values follow from compatibility with (8), (F5): n' = b / c, K' = sf' / ef'^n'.
  explicit CyclicCurve(const pipeline::Material& material);

  double strain(double stress) const;                                                      ///< [1]
  double stress(double strain) const;                                                      ///< exact to rounding [Pa]
  double stress_range(double strain_range) const { return 2 * stress(strain_range / 2); }  ///< of a branch (F3) [Pa]

  double youngs_modulus() const { return modulus_; }                 ///< E [Pa]
  double strength() const { return strength_; }                      ///< K' [Pa]
  double hardening_exponent() const { return hardening_exponent_; }  ///< n'

 private:
  double modulus_, strength_, hardening_exponent_;
};

/// Returns a warning when the material's own K' or n' differs by more than a tenth from (F5). Then elastic and plastic strain of
/// the cyclic curve are not those of the life curve, so cyclic stress and life contradict each other. std::nullopt if they agree
/// or are not given.
std::optional<pipeline::Warning> compatibility_warning(const pipeline::Material& material);

/// Masing branches with material memory (F3, F4) over a curve for values >= 0. Starts at rest in the origin. With stress(strain)
/// as curve the response is the stress along a strain path; with a notch rule's curves it is the local stress or strain along a
/// path of nominal stress.
class MemoryPath {
 public:
  explicit MemoryPath(std::function<double(double)> curve) : curve_(std::move(curve)) {}
  /// Moves monotonically from the present input to `input`. Returns the response there.
  double go_to(double input);

 private:
  struct Point {
    double input, response;
  };
  double on_curve(double input) const;
  std::function<double(double)> curve_;
  double largest_ = 0;               // largest |input| so far
  std::vector<Point> open_{{0, 0}};  // reversals of open loops, and the present point
};

}  // namespace dresslife::fatigue
