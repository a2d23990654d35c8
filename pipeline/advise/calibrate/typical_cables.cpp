#include "pipeline/advise/calibrate/typical_cables.h"

#include <cmath>

#include "pipeline/base/random.h"

namespace dresslife::pipeline {

using Eigen::Index;

double share_between_cables(std::size_t parameter) {
  switch (uncertain_parameters()[parameter].shared) {
    case SharedBy::construction:
      return 6.0 / 7;  // the prior is the scatter of seven cables, whose mean has a seventh of their variance
    case SharedBy::material:
      // ESTIMATE: half comes from the rule that gave the constants, half from the maker's wire: 220 to 250 MPa, tin, alloys
      return 0.5;
    case SharedBy::everything:
      return 0;
    case SharedBy::installation:
      break;
  }
  return 0.99;  // no common part, but its variance must be above 0
}

Eigen::VectorXd common_deviations(const std::vector<Index>& parameters) {
  Eigen::VectorXd deviations(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < deviations.size(); ++i)
    deviations[i] =
        std::sqrt(1 - share_between_cables(static_cast<std::size_t>(parameters[static_cast<std::size_t>(i)])));
  return deviations;
}

void add_own_deviations(Posterior& posterior, const std::vector<Index>& parameters) {
  RandomNumbers numbers(11);
  Eigen::MatrixXd& draws = posterior.draws;
  for (Index i = 0; i < draws.cols(); ++i) {
    const double own =
        std::sqrt(share_between_cables(static_cast<std::size_t>(parameters[static_cast<std::size_t>(i)])));
    for (Index k = 0; k < draws.rows(); ++k) draws(k, i) += own * numbers.normal();
  }
  const double disagree = posterior.chains_disagree, worth = posterior.worth;
  summarise(posterior);
  posterior.chains_disagree =
      disagree;  // the value of the chains before the independent draws, which would hide a disagreement
  posterior.worth = worth;
}

}  // namespace dresslife::pipeline
