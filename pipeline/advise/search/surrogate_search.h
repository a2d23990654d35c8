// Looks where a model of all looks so far promises most (README.md: (Q1) to (Q6)).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/advise/search/look_models.h"
#include "pipeline/advise/search/minimise.h"
#include "pipeline/advise/search/search.h"
#include "pipeline/base/random.h"

namespace dresslife::pipeline {

struct SurrogateSettings {
  std::uint64_t seed = 1;
  int first_looks = 0;   ///< spread over the box before a model is made; 0: twice as many as variables, and 2
  std::size_t aims = 1;  ///< 2: places along the front between both
  int rehearsals = 0;    ///< most before the first look is asked for; 0: 40 times as many as variables
};

class SurrogateSearch : public Search {
 public:
  /// rehearse: empty, or looks that cost a small part of one; what they tell, nothing is rejected beforehand
  /// for.
  SurrogateSearch(Eigen::Index variables, const SurrogateSettings& settings, Screen screen,
                  Rehearse rehearse = {});
  std::vector<Eigen::VectorXd> ask(int count) override;
  void tell(const std::vector<Look>& looks) override;

  /// Without aims, in their order.
  const std::vector<Look>& rehearsals() const { return rehearsals_; }

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

  Eigen::VectorXd first_look();
  double distance_to_known(const Eigen::VectorXd& place) const;
  LookModels models_of(const std::vector<Look>& looks, std::size_t first = 0);
  std::vector<Eigen::VectorXd> ranked(const LookModels& models, const Eigen::VectorXd& best, double width,
                                      const Trust& trust);
  std::vector<Eigen::VectorXd> promising(const LookModels& models) const;
  std::optional<Eigen::VectorXd> spread_look(const LookModels& models) const;
  Eigen::VectorXd rehearsed_pick(LookModels& models, const std::vector<Eigen::VectorXd>& by_merit,
                                 const Trust& trust);
  Eigen::VectorXd nearest_rehearsal(const LookModels& models, std::size_t first = 0) const;
  std::vector<Look> rehearsals_from(std::size_t first) const;
  void rehearse_spread(int count);
  std::vector<Eigen::VectorXd> next_rehearsals(LookModels& models, const Eigen::VectorXd& centre,
                                               std::size_t count);
  void rehearse_ahead(int wanted);
  bool is_hopeless() const;
  void rehearse_looks(const std::vector<Look>& looks);
  void rehearse(const std::vector<Eigen::VectorXd>& places);
  std::vector<Eigen::VectorXd> candidates(const SearchBox& box, const Eigen::VectorXd& centre, double share);
  Eigen::VectorXd allowed(const std::vector<Eigen::VectorXd>& by_merit);
  bool is_known(const Eigen::VectorXd& place) const;
  bool is_rehearsed(const Eigen::VectorXd& place) const;
  std::vector<Look> by_weight(double weight) const;

  Eigen::Index variables_;
  SurrogateSettings settings_;
  Screen screen_;
  Rehearse rehearse_;
  RandomNumbers numbers_;
  std::vector<Look> looks_;  // told
  std::vector<Look> rehearsals_;
  std::vector<Eigen::VectorXd> pending_;        // asked for, not yet told
  std::vector<GaussianProcess::Shape> shapes_;  // of the models, the last found
  std::size_t shapes_of_looks_ = 0;             // that they were found from
  double shapes_of_ = 0;                        // likewise, with rehearsals
  std::vector<Region> regions_;
  std::size_t region_ = 0;      // of the last places asked for
  double ahead_width_;          // of the region about the rehearsal that is nearest to keeping its limits ...
  std::size_t ahead_from_ = 0;  // ... of those from here on
  int asked_ = 0, picks_ = 0;
};

}  // namespace dresslife::pipeline
