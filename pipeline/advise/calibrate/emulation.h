// The rows of a round as functions of the uncertain parameters: each observed life and each bending test, for every
// variant.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/likelihood.h"
#include "pipeline/advise/calibrate/round_of_jobs.h"

namespace dresslife::pipeline {

/// Emulators of one test: a life or a bending moment, for each variant.
struct EmulatedTest {
  std::optional<ObservedLife> life{};
  std::vector<Measurement> bending{};  ///< (variant) emulators of the same measurement
  std::size_t shown = 0;               ///< index of the measured number that tables show
  double per_shown = 1;                ///< divisor of that number: the curvature for a stiffness
  std::string fails_first{};  ///< mode that fails first at the centre, for a life: "wires of signal cable, 100 %"

  std::map<std::string, ObservedLife>
      walls{};  ///< for a life, by the name of the strength: ages of hoses that had not cracked
  /// for a life: factors of the median for one deviation of a parameter, "model 2.0, strength 1.8"
  std::string moved_by{};

  double log_likelihood_at(const Eigen::VectorXd& z) const;
};

/// Returns the emulators of all tests. rows: rows of the round's jobs, in any order, with their files at `places`. Errors:
/// InputError at the row of a test whose job at the centre failed, or contains no bending of its cable.
std::vector<EmulatedTest> emulate(const std::vector<ObservedTest>& tests, const RoundOfJobs& round,
                                  const std::vector<RankingRow>& rows, const StudyPlaces& places);

/// Returns the likelihood of each test over the axes. The result keeps references to both arguments.
std::vector<LogLikelihood> terms_of(const std::vector<EmulatedTest>& tests, const Axes& axes);

}  // namespace dresslife::pipeline
