// Constrained Bayesian optimisation in a trust region (pipeline/advise/search/README.md: (Q1) to (Q6)).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/advise/search/candidate_models.h"
#include "pipeline/advise/search/minimise.h"
#include "pipeline/advise/search/search.h"
#include "pipeline/base/random.h"

namespace dresslife::pipeline {

struct SurrogateSettings {
  std::uint64_t seed = 1;
  int first_candidates = 0;  ///< number of candidates spread over the box before the first model; 0: 2 variables + 2
  std::size_t aims = 1;      ///< number of objectives; 2: candidates along the Pareto front
  int short_runs = 0;  ///< largest number of short runs before the first candidate; 0: 40 times the number of variables
};

class SurrogateSearch : public Search {
 public:
  /// make_short_runs: low-fidelity evaluation, or empty. The screen ignores the constraints that this evaluation computes.
  SurrogateSearch(Eigen::Index variables, const SurrogateSettings& settings, Screen screen,
                  ShortRuns make_short_runs = {});
  std::vector<Eigen::VectorXd> ask(int count) override;
  void tell(const std::vector<Candidate>& candidates) override;

  /// Returns the short runs in their order, without objectives.
  const std::vector<Candidate>& short_runs() const { return short_runs_; }

 private:
  /// A trust region (Q2) around the best candidate for one weight of two objectives. One objective has one region.
  struct Region {
    double weight = 1;  ///< weight of the first objective
    double width = 0;   ///< half of the length of each side
    int hits = 0, misses = 0;
  };
  /// Numbers of deviations for objective and constraints in the choice of a candidate (Q1).
  struct Trust {
    double of_aim, of_limits;  ///< b, c
    bool anywhere;             ///< false: only in the trust region
  };

  Eigen::VectorXd first_candidate();
  double distance_to_known(const Eigen::VectorXd& place) const;
  CandidateModels models_of(const std::vector<Candidate>& candidates, std::size_t first = 0);
  std::vector<Eigen::VectorXd> ranked(const CandidateModels& models, const Eigen::VectorXd& best, double width,
                                      const Trust& trust);
  std::vector<Eigen::VectorXd> promising(const CandidateModels& models) const;
  std::optional<Eigen::VectorXd> spread_candidate(const CandidateModels& models) const;
  Eigen::VectorXd pick_by_short_runs(CandidateModels& models, const std::vector<Eigen::VectorXd>& by_merit,
                                     const Trust& trust);
  Eigen::VectorXd nearest_short_run(const CandidateModels& models, std::size_t first = 0) const;
  std::vector<Candidate> short_runs_from(std::size_t first) const;
  void make_spread_runs(int count);
  std::vector<Eigen::VectorXd> next_short_runs(CandidateModels& models, const Eigen::VectorXd& centre,
                                               std::size_t count);
  void make_runs_ahead(int wanted);
  bool is_hopeless() const;
  void make_runs_of_evaluated(const std::vector<Candidate>& candidates);
  void make_short_runs(const std::vector<Eigen::VectorXd>& places);
  std::vector<Eigen::VectorXd> candidates(const SearchBox& box, const Eigen::VectorXd& centre, double share);
  Eigen::VectorXd allowed(const std::vector<Eigen::VectorXd>& by_merit);
  bool is_known(const Eigen::VectorXd& place) const;
  bool has_short_run(const Eigen::VectorXd& place) const;
  std::vector<Candidate> by_weight(double weight) const;

  Eigen::Index variables_;
  SurrogateSettings settings_;
  Screen screen_;
  ShortRuns make_short_runs_;
  RandomNumbers numbers_;
  std::vector<Candidate> evaluated_;  // results received
  std::vector<Candidate> short_runs_;
  std::vector<Eigen::VectorXd> pending_;        // candidates without results
  std::vector<GaussianProcess::Shape> shapes_;  // shapes of the models, from the last fit
  std::size_t shapes_of_evaluated_ = 0;         // number of results at the last fit of the shapes
  double shapes_of_ = 0;                        // number of results and short runs at the last fit
  std::vector<Region> regions_;
  std::size_t region_ = 0;      // region of the last candidates
  double ahead_width_;          // width of the region around the best short run
  std::size_t ahead_from_ = 0;  // index of the first short run of this region
  int asked_ = 0, picks_ = 0;
};

}  // namespace dresslife::pipeline
