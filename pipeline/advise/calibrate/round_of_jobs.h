// The jobs that are run to learn from observations: the model at a centre of the uncertain parameters. For a life, the life file
// contains its dependence on them (pipeline/life/life_response.h). A bending test is also run one step to either side along every
// parameter that changes it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/study/study.h"

namespace dresslife::pipeline {

/// The jobs of a round. Jobs with the same settings are included once.
class RoundOfJobs {
 public:
  struct Arms {
    std::size_t low, high;  ///< indices of jobs
  };
  struct Runs {
    std::size_t centre;                         ///< index of the job
    std::array<bool, uncertain_count> moves{};  ///< (parameter) whether it can change the job's result
    /// (parameter) whether it can, with an individual value for each dresspack in service
    std::array<bool, uncertain_count> own{};
    std::array<std::optional<Arms>, uncertain_count>
        arms;  ///< (parameter) jobs of a bending test that this parameter changes
  };

  /// sets: `--set` for every job. centre, step: (parameter) values of z. Errors: InputError at the row of a job that is invalid,
  /// that sets a parameter that is to be learned, or that states other uncertainties than the first job.
  RoundOfJobs(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, std::string name,
              Eigen::VectorXd centre, Eigen::VectorXd step);

  const Study& study() const { return study_; }
  const Eigen::VectorXd& centre() const { return centre_; }
  const Eigen::VectorXd& step() const { return step_; }
  /// Returns the standard deviations of z before the observations (parameter), from the jobs' section `uncertainty`; 1 without it.
  const Eigen::VectorXd& prior() const { return prior_; }
  const std::vector<std::vector<Runs>>& runs() const { return runs_; }  ///< (test, variant)
  /// whether dresspacks in service failed, so that the spread between them can be learned
  bool has_failures_in_service() const { return has_failures_in_service_; }

 private:
  Runs runs_of(const ObservedTest& test, const ObservedTest::Variant& variant);
  std::size_t add(const ObservedTest& test, const ObservedTest::Variant& variant, const Eigen::VectorXd& z);

  std::vector<std::string> sets_;
  Eigen::VectorXd centre_, step_, prior_;
  Study study_;
  std::map<std::string, std::size_t> known_;  ///< job indices by the digest of their settings
  std::vector<std::vector<Runs>> runs_;
  bool has_failures_in_service_ = false;
};

/// Map between all parameters and the axes of a posterior: the parameters on which some test depends, then the spread between
/// dresspacks (own_spread.h) if it is learned. Vectors of all parameters have that spread as their last entry.
class Axes {
 public:
  explicit Axes(const RoundOfJobs& round);
  const std::vector<Eigen::Index>& places() const { return places_; }              ///< indices of the parameters
  Eigen::Index size() const { return static_cast<Eigen::Index>(places_.size()); }  ///< number of parameters
  bool has_own_spread() const { return has_own_spread_; }
  /// whether it is Runs::own in some test
  bool has_own(Eigen::Index parameter) const { return own_[static_cast<std::size_t>(parameter)]; }
  /// RoundOfJobs::prior(), and 1 for the spread between dresspacks
  const Eigen::VectorXd& prior() const { return prior_; }
  /// Returns values of all parameters, 0 for the others, and the spread between dresspacks (1 if it is not learned).
  Eigen::VectorXd all(const Eigen::VectorXd& some) const;
  Eigen::VectorXd some(const Eigen::VectorXd& all_of_them) const;

 private:
  std::vector<Eigen::Index> places_;
  std::array<bool, uncertain_count> own_{};
  Eigen::VectorXd prior_;
  bool has_own_spread_;
};

}  // namespace dresslife::pipeline
