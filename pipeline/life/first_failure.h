// The first failure of a dresspack, computed from one set of samples of all uncertain parameters.
//
// A dresspack fails by the first of its failure modes (competing risks). Each mode has a response (life_response.h). A sample is
// one value of every uncertain parameter and of the scatter of each mode's wires. Parameters that jobs share (SharedBy) have
// equal values in all of them. The life of a sample is the shortest life of its modes.
//
// Shares of the uncertainty are Shapley effects (Owen 2014). Let f be the log10 life of d causes, and V(S) the variance of the
// mean of f over all causes that are not in S:
//     share of i = sum over S without i of |S|! (d - |S| - 1)! / d! (V(S + i) - V(S)) / V(all).
// The shares add up to 1 by construction, also for dependent causes. V(S) is the covariance of f over two samples with equal
// causes in S.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/life/life_response.h"

namespace dresslife::pipeline {

/// The modes of one job, at least one.
using FailureModes = std::vector<LifeResponse>;

/// modes_text returns the modes as text for an attribute of a file. modes_from_text reads it back, and also reads a text of a
/// single response. Errors: std::invalid_argument for any other text. Precondition: all modes have equal knowledge.samples.
std::string modes_text(const FailureModes& modes);
FailureModes modes_from_text(const std::string& text);

constexpr std::size_t life_samples = 10000;
/// Standard deviation of log10 lives of the full chain from the response, at values of the parameters that differ from the nodes.
/// Lives are no smooth function of the hose's stiffness and the cables' slack: after a change the ring of cables comes to another
/// rest, or the hose to another side of the robot. Measured: 0.66 in `hard`, 0.58 in `side_panel` (sim/measurements.md, other
/// stiffnesses of the hose). If lives depend on stiffness, slack or another parameter that moves the cables, a normal number with
/// this deviation is added to each sample, one for each dresspack of a job.
constexpr double residual_decades = 0.6;

using LifePercentiles = std::array<double, 3>;  ///< repeats until 10, 50, 90 % have failed
/// Shares of the variance of log10 life: of each parameter, of the scatter of wires, and of the residual. All 0: no variance.
using CauseShares = std::array<double, uncertain_count + 2>;

/// Lives of a job.
struct FirstFailures {
  std::vector<double> log10_life;  ///< (sample) repeats; infinite: no mode fails
  LifePercentiles percentiles{}, glued{}, free{};
  std::vector<double> first;  ///< (mode) share of the samples with a failure in which this mode is the first
  CauseShares share{};
  /// Parameter whose test (UncertainParameter::test) reduces the range of 10 .. 90 % most; std::nullopt: no test reduces it.
  std::optional<std::size_t> best_test;
  LifePercentiles after_test{};  ///< if the result of that test is the present median of the parameter
  /// Standard error of each of `percentiles`, as a factor of at least 1; NaN: an infinite life. Its parts: error_factors() in
  /// first_failure.cpp.
  LifePercentiles error_factor{};
};

/// Returns the log10 lives in repeats, (sample). job: name for the random numbers of this job alone. Equal names give equal
/// samples on every machine. Every stratum of each parameter's distribution occurs once (Latin hypercube).
std::vector<double> first_failures(const FailureModes& modes, const std::string& job,
                                   std::size_t samples = life_samples, Inside inside = Inside::as_is);
/// The same for a comparison of jobs. moved_as: name for the random numbers of the parameter `motion`, equal for jobs with the same
/// simulation, whose hoses swing in the same way.
std::vector<double> compared_failures(const FailureModes& modes, const std::string& job, const std::string& moved_as,
                                      std::size_t samples);
/// Returns the lives of first_failures() and the results computed from them.
FirstFailures summary_of(const FailureModes& modes, const std::string& job, std::size_t samples = life_samples);

/// Returns the standard deviation of the residual of these modes: residual_decades times LifeResponse::residual_spread, or 0 if no life
/// depends on the place of the cables.
double residual_of(const FailureModes& modes);
/// Returns the log10 lives of each mode by itself, (mode, sample).
std::vector<std::vector<double>> mode_lives(const FailureModes& modes, const std::string& job,
                                            std::size_t samples = life_samples);

/// The modes of a job, prepared for many sets of samples.
struct PreparedModes {
  explicit PreparedModes(const FailureModes& modes);  ///< keeps a reference

  const FailureModes& modes;
  std::vector<LifeSurface> surfaces;  ///< (mode)
  std::vector<char> has_residual;     ///< (mode) whether its lives depend on the place of the cables
};

/// Computes mode_lives() of many programs under one name. Modes with equal knowledge, construction and material have equal samples,
/// which are computed once.
class ModeLives {
 public:
  ModeLives(std::string job, std::size_t samples);
  ~ModeLives();
  ModeLives(const ModeLives&) = delete;
  ModeLives& operator=(const ModeLives&) = delete;
  /// Returns mode_lives() of the modes. memory: a list that is no longer needed; the result takes its memory.
  std::vector<std::vector<double>> of(const PreparedModes& prepared, std::vector<std::vector<double>> memory = {});

 private:
  struct Known;
  const Known& samples_for(const LifeResponse& mode, bool has_residual);

  std::string job_;
  std::size_t samples_;
  std::vector<std::unique_ptr<Known>> known_;
};

/// Returns standard normal numbers, (sample): one from every stratum, in an order that depends on the name.
std::vector<double> standard_normals(const std::string& name, std::size_t samples);
/// Returns f of the numbers of standard_normals(name), (sample). f is computed once per stratum. values: f(standard_strata()).
std::vector<double> in_order_of(const std::string& name, std::vector<double> values);
/// Returns the normal numbers in the middle of each of `samples` strata of equal probability, increasing.
const std::vector<double>& standard_strata(std::size_t samples);

/// Returns z of a parameter that dresspacks share, as in the samples of every job, (sample). Precondition: it is not of
/// SharedBy::installation.
std::vector<double> shared_samples(const LifeResponse& mode, std::size_t parameter, std::size_t samples);

/// Returns the percentiles of log10 lives in any order.
LifePercentiles percentiles_of(std::vector<double> log10_lives);

/// Returns the share of samples in which `one` has a longer life than `other`; equal lives count half. Precondition: both have
/// the same number of samples.
double share_outliving(const std::vector<double>& one, const std::vector<double>& other);

/// Returns "friction_inside 41 %; model 30 %; ...", largest first; the last is "other", the sum of all below 1 %. The numbers are
/// integers and add up to 100. A negative share, which is an error of sampling, counts as 0. Empty: no variance.
std::string share_words(const CauseShares& share);
/// Returns the index of the cause with the largest share, without the residual; uncertain_count: the wires' scatter.
std::size_t largest_share(const CauseShares& share);

}  // namespace dresslife::pipeline
