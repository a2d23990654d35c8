// Looks where a model of all looks so far promises most (README.md: (Q1) to (Q3)).
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/search/gaussian_process.h"
#include "pipeline/search/minimise.h"
#include "pipeline/search/search.h"
#include "pipeline/statistics/normal_numbers.h"

namespace dresslife::pipeline {

struct SurrogateSettings {
  std::uint64_t seed = 1;
  int first_looks = 0;   ///< spread over the box before a model is made; 0: twice as many as variables, and 2
  std::size_t aims = 1;  ///< 2: places along the front between both
};

class SurrogateSearch : public Search {
 public:
  SurrogateSearch(Eigen::Index variables, const SurrogateSettings& settings, Screen screen);
  std::vector<Eigen::VectorXd> ask(int count) override;
  void tell(const std::vector<Look>& looks) override;

 private:
  /// About which weight of two aims, and how far from the best look by it (Q2). One aim: one region.
  struct Region {
    double weight = 1;  ///< of the first aim
    double width = 0;   ///< half of each side
    int hits = 0, misses = 0;
  };
  /// How far a pick trusts the models (Q1).
  struct Trust {
    double of_aim, of_limits;  ///< b, c
    bool anywhere;             ///< else in the trust region
  };
  struct Models;

  Eigen::VectorXd first_look();
  Eigen::VectorXd pick(const Models& models, const Eigen::VectorXd& best, double width, const Trust& trust);
  std::vector<Eigen::VectorXd> candidates(const SearchBox& box, const Eigen::VectorXd& centre, double share);
  Eigen::VectorXd allowed(const std::vector<Eigen::VectorXd>& by_merit);
  bool is_known(const Eigen::VectorXd& place) const;
  std::vector<Look> by_weight(double weight) const;

  Eigen::Index variables_;
  SurrogateSettings settings_;
  Screen screen_;
  NormalNumbers numbers_;
  std::vector<Look> looks_;                     // told
  std::vector<Eigen::VectorXd> pending_;        // asked for, not yet told
  std::vector<GaussianProcess::Shape> shapes_;  // of the models, the last found
  std::vector<Region> regions_;
  std::size_t region_ = 0;  // of the last places asked for
  int asked_ = 0, picks_ = 0;
};

}  // namespace dresslife::pipeline
