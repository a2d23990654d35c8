#include "pipeline/advise/calibrate/learned_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/base/constants.h"
#include "pipeline/base/digest.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/readable.h"
#include "pipeline/files/files.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/job/uncertainty.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;

double to_figures(double value, int figures) {
  return value == 0 || !std::isfinite(value) ? value : std::stod(fmt::format("{:.{}g}", value, figures));
}

/// Returns evenly distributed draws with two decimals: the numbers of a job's samples. A percentile's error is at most 6 % of the
/// deviation.
std::vector<double> some_of(const Eigen::VectorXd& draws) {
  constexpr Index most = 1000;
  const Index every = std::max<Index>(1, draws.size() / most);
  std::vector<double> some;
  for (Index k = 0; k < std::min(most, draws.size()); ++k) some.push_back(std::round(100 * draws[k * every]) / 100);
  return some;
}

/// Returns the ranges of bend, twist and strain of the jobs at the centre, from their files.
LearnedWithin within_of(const std::vector<ObservedTest>& tests, const RoundOfJobs& round, const StudyPlaces& places) {
  LearnedWithin within;
  std::set<std::string> materials;
  const auto least = [](std::optional<double>& of, double value) { of = std::min(of.value_or(value), value); };
  const auto most = [](std::optional<double>& of, double value) { of = std::max(of.value_or(value), value); };
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (!tests[t].observation.is_life()) continue;  // a bending test contains no information about lives
    if (const auto cycles = tests[t].observation.cycles)
      least(within.fewest_cycles, *cycles), most(within.most_cycles, *cycles);
    for (const RoundOfJobs::Runs& runs : round.runs()[t]) {
      const std::filesystem::path folder = places.job(round.study().jobs[runs.centre].name);
      const FileReader strain(folder / "strain.h5", strain_format()), life(folder / "life.h5", life_format());
      const auto curvature = strain.read<double>("/deformation/curvature");
      for (std::size_t k = 0; k + 1 < curvature.size(); k += 2)
        most(within.largest_curvature, std::hypot(curvature[k], curvature[k + 1]));
      for (const double twist : strain.read<double>("/deformation/twist")) most(within.largest_twist, std::abs(twist));
      double largest = 0;
      for (const double range : life.read<double>("/cycles/range")) largest = std::max(largest, range);
      if (largest > 0) least(within.least_strain_range, largest), most(within.largest_strain_range, largest);
      const Job& job = *round.study().jobs[runs.centre].job;
      for (const std::string& name : life.read<std::string>("/site/material"))
        materials.insert(material_of(job, name).name);
    }
  }
  for (auto* value : {&within.least_strain_range, &within.largest_strain_range, &within.largest_curvature,
                      &within.largest_twist, &within.fewest_cycles, &within.most_cycles})
    if (*value) **value = to_figures(**value, 4);
  if (within.largest_twist) within.largest_twist = to_figures(*within.largest_twist / degree, 4) * degree;
  within.materials = joined(materials, ", ");
  return within;
}

/// Returns the settings of the jobs at the centre. Tests of stiffness and decay do not depend on materials.
LearnedUnder under_of(const std::vector<ObservedTest>& tests, const RoundOfJobs& round) {
  std::vector<const Job*> all, lives;
  for (std::size_t t = 0; t < tests.size(); ++t)
    for (const RoundOfJobs::Runs& runs : round.runs()[t]) {
      all.push_back(round.study().jobs[runs.centre].job.get());
      if (tests[t].observation.is_life()) lives.push_back(all.back());
    }
  LearnedUnder under = learned_under(all);
  under.materials = learned_under(lives).materials;
  std::set<std::string> motions;
  for (std::size_t t = 0; t < tests.size(); ++t)
    for (const RoundOfJobs::Runs& runs : round.runs()[t])
      if (!tests[t].observation.service.empty()) motions.insert(motion_digest(*round.study().jobs[runs.centre].job));
  under.motions = joined(motions, ", ");
  return under;
}

/// Returns the warnings of records whose job exceeds limits, and the doubts of single observations.
std::vector<std::string> doubts_of(const Learned& learned) {
  constexpr double surprising = 2.6;  // one of 100 observations is as far off, the limit of records in service
  std::vector<std::string> doubts = learned.warnings;
  for (const LearnedTest& test : learned.tests)
    if (const std::string doubt = doubt_of(test, surprising); !doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

/// Returns whether other dresspacks have the same value of the parameter of an axis.
bool is_shared(const Axes& axes, Index axis) {
  const Index p = axes.places()[static_cast<std::size_t>(axis)];
  return uncertain_parameters()[static_cast<std::size_t>(p)].shared != SharedBy::installation;
}

std::string digest_of(const ObservedTest& test) {
  const std::filesystem::path& table = test.observation.bending;
  return xxh3(test.text + (table.empty() ? "" : xxh3_of_file(table)));
}

}  // namespace

Calibration calibration_of(const Learned& learned, const std::vector<ObservedTest>& tests, const RoundOfJobs& round,
                           const StudyPlaces& places) {
  const Axes axes(round);
  constexpr double decimals = 1e6;
  const auto rounded = [&](double value) { return std::round(value * decimals) / decimals; };
  Calibration calibration;
  if (learned.own_spread) calibration.own_spread = to_figures(learned.own_spread->factor, 3);
  const Posterior& posterior = learned.posterior;
  calibration.typical = std::any_of(tests.begin(), tests.end(), [](const ObservedTest& test) { return test.typical; });
  calibration.note = fmt::format(
      "{} observations, {} rounds{}; draws worth {} independent ones, chains disagree by {:.3f}", learned.tests.size(),
      learned.rounds, learned.settled ? "" : " (not settled)", readable(posterior.worth, 2), posterior.chains_disagree);
  std::vector<std::string> contradictions;
  for (const LearnedTest& test : learned.tests)
    if (const auto warning = contradiction_of(test)) contradictions.push_back(warning->words);
  calibration.contradiction = joined(contradictions, " ");
  if (!calibration.typical) calibration.doubts = joined(doubts_of(learned), "\n");
  std::vector<Index> shared;  // axes that the next dresspack has in common with those of the tests
  for (Index i = 0; i < axes.size(); ++i)
    if (is_shared(axes, i)) shared.push_back(i);
  for (const Index i : shared) {
    const auto p = static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(i)]);
    LearnedParameter parameter;
    parameter.name = uncertain_parameters()[p].name;
    parameter.median = rounded(posterior.median[i]);
    parameter.mean = rounded(posterior.mean[i]);
    parameter.prior = rounded(axes.prior()[axes.places()[static_cast<std::size_t>(i)]]);
    for (const Index j : shared) parameter.covariance.push_back(rounded(posterior.covariance(i, j)));
    if (!calibration.typical) parameter.samples = some_of(posterior.draws.col(i));
    parameter.value = to_figures(learned.axes[p].after[1], 4);
    parameter.value_p10 = to_figures(learned.axes[p].after[0], 4);
    parameter.value_p90 = to_figures(learned.axes[p].after[2], 4);
    calibration.parameters.push_back(parameter);
  }
  for (const LearnedWall& wall : learned.walls) {
    for (LearnedParameter& other : calibration.parameters) other.covariance.push_back(0);
    const auto factor = [](double z) { return to_figures(std::pow(wall_strength_step, z), 4); };
    LearnedParameter& parameter = calibration.parameters.emplace_back();
    parameter.name = wall.name;
    parameter.median = rounded(wall.median), parameter.mean = rounded(wall.mean);
    parameter.covariance.assign(calibration.parameters.size(), 0);
    parameter.covariance.back() = rounded(wall.deviation * wall.deviation);
    parameter.value = factor(wall.median), parameter.value_p10 = factor(wall.low),
    parameter.value_p90 = factor(wall.high);
  }
  calibration.under = under_of(tests, round);
  if (calibration.typical) calibration.under.cables.clear();  // the calibration belongs to none of these cables
  calibration.within = within_of(tests, round, places);
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const LearnedTest& test = learned.tests[t];
    calibration.observations.push_back({test.observation.name, observed_text(test.observation), words_of(test.before),
                                        words_of(test.after), digest_of(tests[t])});
  }
  return calibration;
}

}  // namespace dresslife::pipeline
