// Minimum of a function in a box under constraints: one function for the methods of NLopt.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace dresslife::pipeline {

struct SearchBox {
  Eigen::VectorXd low, high;  ///< (variable), low < high
};

/// Constraints as a vector; an entry <= 0: the constraint is satisfied.
struct LimitFunctions {
  int count = 0;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> beyond;
};

/// Returns the best place that a local search without derivatives finds from `start` with at most `evaluations` evaluations.
/// Equal calls give equal places. Without limits it uses Sbplx (T. Rowan, 1990), with limits COBYLA (M. Powell, 1994). step:
/// first change of each variable. Preconditions: `start` lies in the box; the functions are finite in the box.
Eigen::VectorXd minimised(const std::function<double(const Eigen::VectorXd&)>& function, const LimitFunctions& limits,
                          const SearchBox& box, Eigen::VectorXd start, double step, int evaluations);

}  // namespace dresslife::pipeline
