#include "pipeline/advise/calibrate/own_spread.h"

#include <vector>

#include "pipeline/advise/calibrate/posterior.h"

namespace dresslife::pipeline {

OwnSpread own_spread_of(const Eigen::VectorXd& z) {
  const Eigen::VectorXd f = z.unaryExpr(&own_spread_at);
  const std::vector<double> factors(f.begin(), f.end());
  return {std::sqrt(f.squaredNorm() / static_cast<double>(f.size())), quantile(factors, 0.1), quantile(factors, 0.9)};
}

}  // namespace dresslife::pipeline
