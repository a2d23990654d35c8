// The strain along one part that slides in what it lies in, whatever its lay: from the stretch of its path,
// friction along it and the grips of its clamps (README W34).
//
// Element i of the path has gained g_i over the path on which the part was installed, with slack; if nothing
// slid, its strain would be gamma_i = (1 + g_i) / (1 + slack) - 1. The part slides along its path, by u at
// the nodes between elements, and has the strain eps_i = gamma_i + (u_{i+1} - u_i) / l_i. The change of its
// force T_i = E A eps_i from element to element is at most the friction at the node between them:
//     |T_i - T_{i-1}| <= f_i.
// At either clamp the force is at most the grip. A node slides only where its limit is reached, in the
// direction that friction opposes. Over a step that is the minimum of the elastic energy and the work of
// friction; its dual, a projection
//     sum l_i (T_i - E A (eps_i before + gamma_i's change))^2 / (2 E A)  ->  least, under the limits above,
// is solved exactly by dynamic programming: with d_i(T) the slope of the least sum up to element i that ends
// in T, piecewise linear and rising, a limit f moves its two sides apart by 2 f around its zero, and an
// element adds a line (N. Johnson, J. Comput. Graph. Stat. 22 (2013), for the same sums in statistics).
// No friction: T is everywhere the same, that of the mean. Limits beyond all forces: glued.
//
// Mostly friction is weak and every node slides. Then T_i = T_{i-1} + s_i f_i with s_i = +1 or -1, and T_0 follows from
// sum l_i (T_i - EA tried_i) = 0. This is the minimum if sum_{j<i} l_j (T_j - EA tried_j), which is E A times the slide
// of node i, has the sign s_i at every node. The signs of the sample before are tried first.
#pragma once

#include <span>
#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

class SlidingLine {
 public:
  /// lengths: of the elements at rest [m]. axial_stiffness: E A [N]. grips: forces at base and tool clamp
  /// [N].
  SlidingLine(std::vector<double> lengths, double axial_stiffness, double base_grip, double tool_grip);

  /// The next sample. unslid: gamma (element). limits: f at the node between elements i - 1 and i at i; [N]
  /// (element, the first one is not read).
  void next(std::span<const double> unslid, std::span<const double> limits) {
    attempt(unslid, limits);
    keep();
  }
  /// The same in two steps, where limits depend on the forces: attempts change nothing but force().
  void attempt(std::span<const double> unslid, std::span<const double> limits);
  void keep();

  std::span<const double> force() const { return force_; }  ///< (element) [N]
  double strain(std::size_t element) const { return force_[element] / stiffness_; }
  /// Length that went in at the base and the tool clamp in all [m]; below 0: was pulled out.
  double let_in_at_base() const { return let_in_[0]; }
  /// Both, either way added up [m].
  double travel_at_base() const { return travel_[0]; }
  double travel_at_tool() const { return travel_[1]; }

 private:
  /// Where the slope of the least sum bends: it rises by `bend` more above `at` less the side's shift.
  struct Knot {
    double at, bend;
  };

  bool all_slide(std::span<const double> limits);
  void widen(double limit);
  void add(double weight, double target);

  std::vector<double> lengths_;
  double stiffness_, base_grip_, tool_grip_;
  std::vector<double> slid_;  ///< (element) (u_{i+1} - u_i) / l_i
  std::vector<double> force_, tried_, least_;
  std::vector<double> sign_, slide_;  ///< (element) of the node before it: s, and E A times its slide
  bool all_slid_ = true;              ///< at the last attempt
  double length_, soft_weight_;
  std::vector<Knot> below_, above_;
  double below_shift_ = 0, above_shift_ = 0, slope_ = 0, at_zero_ = 0, lowest_at_ = 0;
  double let_in_[2]{}, travel_[2]{};
};

}  // namespace dresslife::strain
