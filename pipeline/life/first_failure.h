// When a dresspack fails first, over the same samples of everything that is uncertain.
//
// A dresspack fails by the first of its failure modes (competing risks). Each mode has a response
// (life_response.h). A sample is one value of every uncertain parameter and of the scatter of each mode's
// wires; what jobs share (SharedBy) has the same value in all of them. The life of a sample is the least of
// its modes.
//
// Shares of the uncertainty are Shapley effects (Owen 2014): with f the log10 life, V(S) the variance of f's
// mean over all causes but those in S, d causes,
//     share of i = sum over S without i of |S|! (d - |S| - 1)! / d! (V(S + i) - V(S)) / V(all).
// They add up to 1 by construction, also for causes that depend on each other. V(S) is the covariance of f
// over two samples that have S in common.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/life/life_response.h"

namespace dresslife::pipeline {

/// The modes of one job, at least one.
using FailureModes = std::vector<LifeResponse>;

/// As one text, for an attribute of a file; and back, also from a text of one response alone. Errors:
/// std::invalid_argument for a text that is none.
std::string modes_text(const FailureModes& modes);
FailureModes modes_from_text(const std::string& text);

constexpr std::size_t life_samples = 10000;

using LifePercentiles = std::array<double, 3>;  ///< repeats until 10, 50, 90 % have failed

/// What a job's lives are like.
struct FirstFailures {
  std::vector<double> log10_life;  ///< (sample) repeats; infinite: no mode fails
  LifePercentiles percentiles{}, glued{}, free{};
  std::vector<double> first;  ///< (mode) share of the samples with a failure in which it is the first
  /// Share of the variance of log10 life, (parameter), and the scatter of wires the last. All 0: no variance.
  std::array<double, uncertain_count + 1> share{};
  /// The parameter whose test (UncertainParameter::test) narrows 10 .. 90 % most; absent: none does.
  std::optional<std::size_t> best_test;
  LifePercentiles after_test{};  ///< if that test confirms today's median of the parameter
  /// Standard error of each of `percentiles`, as a factor of at least 1; NaN: a life without end. See error_factors().
  LifePercentiles error_factor{};
};

/// Standard errors of percentiles, as factors: of the number of samples, and of what the response puts between and
/// beside the lives that were computed. The square of log10 of a factor is the sum of the squares of these changes of
/// log10 of the percentile:
///     samples     half the way between the lives at the ranks n s -+ sqrt(n s (1 - s)), s the share (order statistics
///                 of independent samples; a Latin hypercube is better)
///     nodes       without one node of friction, slack or strength, each in turn. A straight line's error grows with
///                 the square of the distance of nodes, so this is three times the error there. It counts in full,
///                 because other intervals are as wide as the one without the node
///     other rests without one node of friction along the hose, play or grips, each in turn: the line through 0 and the
///                 node on the other side goes on. These parameters change lives less than another rest of the cables does
///     together()  friction and slack put together by it, instead of their computed combinations; where further
///                 parameters are put together so
/// Not in it: errors beyond the outermost nodes of friction and slack (strain/measurements.md, response and full
/// evaluations). log10_lives: first_failures() of the same arguments.
LifePercentiles error_factors(const FailureModes& modes, const std::string& job, std::size_t samples,
                              const std::vector<double>& log10_lives);

/// (sample) log10 lives in repeats. job: names what only it has. The same names give the same samples,
/// anywhere; of each parameter every stratum of its distribution occurs once (Latin hypercube).
std::vector<double> first_failures(const FailureModes& modes, const std::string& job,
                                   std::size_t samples = life_samples, Inside inside = Inside::as_is);
/// The same with what follows from them.
FirstFailures summary_of(const FailureModes& modes, const std::string& job,
                         std::size_t samples = life_samples);

/// (mode, sample) the same of each mode by itself.
std::vector<std::vector<double>> mode_lives(const FailureModes& modes, const std::string& job,
                                            std::size_t samples = life_samples);
/// (sample) standard normal numbers: every stratum once, in an order that the name decides.
std::vector<double> standard_normals(const std::string& name, std::size_t samples);
/// (sample) f of these normal numbers, which is computed once for each stratum. values: f(standard_strata()).
std::vector<double> in_order_of(const std::string& name, std::vector<double> values);
/// The normal numbers in the middles of as many equal shares, rising.
const std::vector<double>& standard_strata(std::size_t samples);

/// (sample) z of a parameter that dresspacks share, in the samples of any job. Precondition: not of SharedBy::installation.
std::vector<double> shared_samples(const LifeResponse& mode, std::size_t parameter, std::size_t samples);

/// Of log10 lives, in any order.
LifePercentiles percentiles_of(std::vector<double> log10_lives);

/// Share of samples in which `one` lives longer than `other`; equal lives count half. Precondition: as many
/// of both.
double share_outliving(const std::vector<double>& one, const std::vector<double>& other);

/// "friction_inside 41 %; model 30 %; ...", largest first; the last is "other" for all below 1 %. Whole per
/// cents that add up to 100. Empty: no variance.
std::string share_words(const std::array<double, uncertain_count + 1>& share);
/// The cause with the largest share: its index, uncertain_count for the wires' scatter.
std::size_t largest_share(const std::array<double, uncertain_count + 1>& share);

}  // namespace dresslife::pipeline
