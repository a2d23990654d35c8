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

/// Emulators of a test: a life or a bending moment, of each variant.
struct EmulatedTest {
  std::optional<ObservedLife> life{};
  std::vector<Measurement> bending{};  ///< (variant), of the same measurement
  std::size_t shown = 0;               ///< index of the number that is shown
  double per_shown = 1;                ///< its divisor: the curvature for a stiffness
  std::string fails_first{};           ///< of a life, at the centre: "wires of signal cable, 100 %"

  std::map<std::string, ObservedLife> walls{};  ///< of a life, by the name of their strength: hoses that had not cracked
  std::string moved_by{};              ///< of a life: factors of the median for one deviation, "model 2.0, strength 1.8"

  double log_likelihood_at(const Eigen::VectorXd& z) const;
};

/// rows: of the round's jobs, in any order, with their files at `places`. Errors: InputError at the row of a
/// test whose job at the centre failed, or contains no bending of its cable.
std::vector<EmulatedTest> emulate(const std::vector<ObservedTest>& tests, const RoundOfJobs& round,
                  const std::vector<RankingRow>& rows, const StudyPlaces& places);

/// The likelihood of each test over the axes. The result refers to both arguments.
std::vector<LogLikelihood> terms_of(const std::vector<EmulatedTest>& tests, const Axes& axes);

}  // namespace dresslife::pipeline
