// Strain along one part of any lay that slides in its parent, from the stretch of its path, friction along it and the grips of
// its clamps ((W34) in strain/theory.md).
//
// g_i is the growth of element i of the path relative to the path on which the part was installed, with slack. Without sliding
// its strain is gamma_i = (1 + g_i) / (1 + slack) - 1. The part slides along its path by u at the nodes between elements, and
// its strain is eps_i = gamma_i + (u_{i+1} - u_i) / l_i. The change of its
// force T_i = E A eps_i from element to element is at most the friction at the node between them:
//     |T_i - T_{i-1}| <= f_i.
// At either clamp the force is at most the grip. A node slides only where its limit is reached, against friction. Over a step
// this is the minimum of elastic energy plus work of friction. The dual problem is a projection,
//     sum l_i (T_i - E A (eps_i before + gamma_i's change))^2 / (2 E A)  ->  least, under the limits above.
// Dynamic programming solves it exactly: d_i(T) is the slope of the least sum up to element i that ends in T. It is piecewise
// linear and rising. A limit f moves the two sides of its zero apart by 2 f, and an element adds a line
// (N. Johnson, J. Comput. Graph. Stat. 22 (2013), for the same sums in statistics).
// Without friction T is uniform, with the mean strain. With limits beyond all forces the part is glued.
#pragma once

#include <span>
#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

class SlidingLine {
 public:
  /// lengths: of the elements at rest [m]. axial_stiffness: E A [N]. grips: force limits at base and tool clamp [N].
  SlidingLine(std::vector<double> lengths, double axial_stiffness, double base_grip, double tool_grip);

  /// Computes the next sample. unslid: gamma (element). limits: f at the node between elements i - 1 and i, at index i [N]
  /// (element; index 0 is not used).
  void next(std::span<const double> unslid, std::span<const double> limits) {
    attempt(unslid, limits);
    keep();
  }
  /// next() in two steps, for limits that depend on the forces: attempt() changes only force(), keep() accepts the last attempt.
  void attempt(std::span<const double> unslid, std::span<const double> limits);
  void keep();

  std::span<const double> force() const { return force_; }  ///< (element) [N]
  double strain(std::size_t element) const { return force_[element] / stiffness_; }
  /// Length that entered at the base clamp so far [m]; negative: was pulled out.
  double let_in_at_base() const { return let_in_[0]; }
  /// Sliding distance at the clamp, both directions added [m].
  double travel_at_base() const { return travel_[0]; }
  double travel_at_tool() const { return travel_[1]; }

 private:
  /// A bend of the slope of the least sum: above `at` plus its side's shift the slope rises by `bend` more.
  struct Knot {
    double at, bend;
  };

  std::vector<double> lengths_;
  double stiffness_, base_grip_, tool_grip_;
  std::vector<double> slid_;  ///< (element) (u_{i+1} - u_i) / l_i
  std::vector<double> force_, tried_, least_;
  std::vector<Knot> below_, above_;  ///< room for those on each side of the minimum
  double length_, soft_weight_;
  double let_in_[2]{}, travel_[2]{};
};

}  // namespace dresslife::strain
