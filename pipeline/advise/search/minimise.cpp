#include "pipeline/advise/search/minimise.h"

#include <nlopt.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace dresslife::pipeline {

using Eigen::VectorXd;

namespace {

using Function = std::function<double(const VectorXd&)>;

VectorXd vector_at(unsigned size, const double* values) {
  return Eigen::Map<const VectorXd>(values, static_cast<Eigen::Index>(size));
}

double value_of(unsigned size, const double* place, double*, void* function) {
  return (*static_cast<const Function*>(function))(vector_at(size, place));
}

void limits_at(unsigned count, double* beyond, unsigned size, const double* place, double*, void* limits) {
  Eigen::Map<VectorXd>(beyond, static_cast<Eigen::Index>(count)) =
      static_cast<const LimitFunctions*>(limits)->beyond(vector_at(size, place));
}

void check(nlopt_result result) {
  if (result < 0 && result != NLOPT_ROUNDOFF_LIMITED) throw std::logic_error("NLopt was given what it cannot minimise");
}

}  // namespace

VectorXd minimised(const Function& function, const LimitFunctions& limits, const SearchBox& box, VectorXd start,
                   double step, int evaluations) {
  const auto size = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> search(
      nlopt_create(limits.count > 0 ? NLOPT_LN_COBYLA : NLOPT_LN_SBPLX, size), nlopt_destroy);
  Function callable = function;
  LimitFunctions of = limits;
  check(nlopt_set_min_objective(search.get(), value_of, &callable));
  if (limits.count > 0) {
    const std::vector<double> exact(static_cast<std::size_t>(limits.count), 0.0);
    check(nlopt_add_inequality_mconstraint(search.get(), static_cast<unsigned>(limits.count), limits_at, &of,
                                           exact.data()));
  }
  check(nlopt_set_lower_bounds(search.get(), box.low.data()));
  check(nlopt_set_upper_bounds(search.get(), box.high.data()));
  check(nlopt_set_initial_step1(search.get(), step));
  check(nlopt_set_maxeval(search.get(), evaluations));
  check(nlopt_set_xtol_rel(search.get(), 1e-7));
  start = start.cwiseMax(box.low).cwiseMin(box.high);
  double least = 0;
  check(nlopt_optimize(search.get(), start.data(), &least));
  return start.cwiseMax(box.low).cwiseMin(box.high);
}

}  // namespace dresslife::pipeline
