// The smallest value of a function in a box, under limits: NLopt behind one function.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace dresslife::pipeline {

struct SearchBox {
  Eigen::VectorXd low, high;  ///< (variable), low < high
};

/// LimitFunctions as a vector, each <= 0 where it is kept.
struct LimitFunctions {
  int count = 0;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> beyond;
};

/// The best place found from `start`, which lies in the box, with so many evaluations at most; equal calls,
/// equal places. Without limits Sbplx (T. Rowan, 1990), with limits COBYLA (M. Powell, 1994), neither of
/// which needs derivatives: a local search. step: first change of each variable. Functions must be finite in
/// the box.
Eigen::VectorXd minimised(const std::function<double(const Eigen::VectorXd&)>& function,
                          const LimitFunctions& limits, const SearchBox& box, Eigen::VectorXd start,
                          double step, int evaluations);

}  // namespace dresslife::pipeline
