#include "pipeline/advise/search/random_search.h"

#include <algorithm>
#include <utility>

namespace dresslife::pipeline {

using Eigen::VectorXd;

RandomSearch::RandomSearch(Eigen::Index variables, std::uint64_t seed, Screen screen)
    : variables_(variables), numbers_(seed), screen_(std::move(screen)) {}

VectorXd RandomSearch::drawn() {
  VectorXd place(variables_);
  for (double& u : place) u = numbers_.uniform();
  return place;
}

std::vector<VectorXd> RandomSearch::ask(int count) {
  // draws per candidate; if all are rejected, the one with the smallest violation is returned
  constexpr std::size_t drawn_for_each = 16;
  std::vector<VectorXd> places;
  while (places.size() < static_cast<std::size_t>(count)) {
    std::vector<VectorXd> some;
    while (some.size() < drawn_for_each) some.push_back(drawn());
    const std::vector<double> beyond = screen_(some);
    places.push_back(some[static_cast<std::size_t>(std::min_element(beyond.begin(), beyond.end()) - beyond.begin())]);
  }
  return places;
}

}  // namespace dresslife::pipeline
