// What is run to learn from observations: the model at a centre of the uncertain parameters. Of a life the file itself says
// how it depends on them (pipeline/life/life_response.h); a bending test is also run one step to either side along every
// parameter that moves it.
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

/// The jobs of a round. One with the same settings as another is there once.
class RoundOfJobs {
 public:
  struct Arms {
    std::size_t low, high;  ///< jobs
  };
  struct Runs {
    std::size_t centre;  ///< job
    std::array<bool, uncertain_count> moves{};              ///< (parameter) whether it can move the job
    std::array<bool, uncertain_count> own{};    ///< (parameter) whether it can, and each dresspack in service has its own
    std::array<std::optional<Arms>, uncertain_count> arms;  ///< (parameter) of a bending test that it moves
  };

  /// sets: for every job. centre, step: of z, (parameter). Errors: InputError at the row of a job that cannot
  /// be made, or that gives what is to be learned.
  RoundOfJobs(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, std::string name,
              Eigen::VectorXd centre, Eigen::VectorXd step);

  const Study& study() const { return study_; }
  const Eigen::VectorXd& centre() const { return centre_; }
  const Eigen::VectorXd& step() const { return step_; }
  const std::vector<std::vector<Runs>>& runs() const { return runs_; }  ///< (test, variant)

 private:
  Runs runs_of(const ObservedTest& test, const ObservedTest::Variant& variant);
  std::size_t add(const ObservedTest& test, const ObservedTest::Variant& variant, const Eigen::VectorXd& z);

  std::vector<std::string> sets_;
  Eigen::VectorXd centre_, step_;
  Study study_;
  std::map<std::string, std::size_t> known_;  ///< jobs by the digest of their settings
  std::vector<std::vector<Runs>> runs_;
};

/// Between all parameters and those that some test depends on.
class Axes {
 public:
  explicit Axes(const RoundOfJobs& round);
  const std::vector<Eigen::Index>& places() const { return places_; }  ///< parameters
  Eigen::Index size() const { return static_cast<Eigen::Index>(places_.size()); }
  bool has_own(Eigen::Index parameter) const { return own_[static_cast<std::size_t>(parameter)]; }  ///< of some test's Runs
  Eigen::VectorXd all(const Eigen::VectorXd& some) const;  ///< 0 for the others
  Eigen::VectorXd some(const Eigen::VectorXd& all_of_them) const;

 private:
  std::vector<Eigen::Index> places_;
  std::array<bool, uncertain_count> own_{};
};

}  // namespace dresslife::pipeline
