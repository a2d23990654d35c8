// Search with uniform random candidates: the baseline for other searches.
#pragma once

#include "pipeline/advise/search/search.h"
#include "pipeline/base/random.h"

namespace dresslife::pipeline {

class RandomSearch : public Search {
 public:
  /// screen: a rejected candidate is replaced, at most a few times.
  RandomSearch(Eigen::Index variables, std::uint64_t seed, Screen screen);
  std::vector<Eigen::VectorXd> ask(int count) override;
  void tell(const std::vector<Candidate>&) override {}

 private:
  Eigen::VectorXd drawn();

  Eigen::Index variables_;
  RandomNumbers numbers_;
  Screen screen_;
};

}  // namespace dresslife::pipeline
