#include "pipeline/advise/calibrate/round_of_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "pipeline/advise/calibrate/own_spread.h"
#include "pipeline/base/digest.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

bool any_rubs(const Job& job) {
  return std::any_of(job.strain.slip.begin(), job.strain.slip.end(), [](Slip slip) { return rubs(slip); });
}

bool any_grip(const Job& job) {
  for (const MountedDresspack& mounted : job.dresspacks)
    for (const Component& component : mounted.dresspack.components)
      if (component.laying.base_grip || component.laying.tool_grip) return true;
  return false;
}

bool any_in_hose(const Job& job) {
  return std::any_of(job.dresspacks.begin(), job.dresspacks.end(),
                     [](const MountedDresspack& mounted) { return !mounted.dresspack.cable_alone; });
}

/// Returns whether a parameter can change the job's life.
bool acts(const Job& job, Uncertain parameter) {
  switch (parameter) {
    case Uncertain::friction_inside:
      return any_rubs(job);
    case Uncertain::friction_hose:
    case Uncertain::slack:
    case Uncertain::play:
    case Uncertain::rest:
      return any_in_hose(job);
    case Uncertain::grip:
      return any_grip(job);
    case Uncertain::strength:
    case Uncertain::slope:
    case Uncertain::scatter:
    case Uncertain::model:
      return true;
    case Uncertain::hose_stiffness:
      return !job.motion.is_prescribed();
    case Uncertain::motion:
      return !job.robot.joints.empty();
  }
  return true;
}

}  // namespace

RoundOfJobs::RoundOfJobs(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, std::string name,
                         VectorXd centre, VectorXd step)
    : sets_(sets), centre_(std::move(centre)), step_(std::move(step)) {
  const Sources read_once;
  sets_.push_back("uncertainty.ratings=none");  // ratings would be used twice, and z is relative to the keys' defaults
  study_.name = std::move(name);
  for (const ObservedTest& test : tests) {
    runs_.emplace_back();
    if (std::ranges::any_of(test.observation.service, &ServiceRecord::failed)) has_failures_in_service_ = true;
    for (const ObservedTest::Variant& variant : test.variants) runs_.back().push_back(runs_of(test, variant));
  }
}

RoundOfJobs::Runs RoundOfJobs::runs_of(const ObservedTest& test, const ObservedTest::Variant& variant) {
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw InputError(test.where, fmt::format("'{}': {}", test.observation.name, what), remedy);
  };
  if (!variant.failure.empty()) refuse("its job cannot be made: " + variant.failure, "correct it");
  Runs runs;
  try {
    const Job plain = job_from(variant.job, sets_);
    if (plain.calibration)
      refuse("its job names a calibration, whose observations would count twice", "leave calibration out");
    if (plain.strain.factors != StrainFactors{} || plain.strain.rest != 0 || plain.simulation.stiffness_factor != 1 ||
        is_changed(plain.fatigue) || plain.fatigue.scatter_factor != 1)
      refuse("its job gives a key that is to be learned", "leave the factors of simulation, strain and fatigue out");
    if (test.typical && plain.uncertainty.spread != Uncertainty::default_spread())
      refuse("its job gives uncertainties of its own, but typical cables are learned with the default ones",
             "leave section uncertainty out of its job");
    const VectorXd prior = prior_of(plain.uncertainty).covariance.diagonal().cwiseSqrt();
    if (prior_.size() == 0) prior_ = prior;
    if (prior != prior_)
      refuse("its job gives other uncertainties than the first job, but all rows of a calibration must have the same",
             "give section uncertainty of all jobs the same values, or leave it out of all of them");
    runs.centre = add(test, variant, centre_);
    for (std::size_t p = 0; p < uncertain_count; ++p) {
      if (!acts(plain, static_cast<Uncertain>(p)) || is_known(plain.uncertainty, static_cast<Uncertain>(p))) continue;
      if (!test.observation.is_life() && !uncertain_parameters()[p].of_strain) continue;
      const bool is_own =
          uncertain_parameters()[p].shared == SharedBy::installation && !test.observation.service.empty();
      (is_own ? runs.own : runs.moves)[p] = true;
      if (test.observation.is_life()) continue;
      VectorXd low = centre_, high = centre_;
      low[static_cast<Index>(p)] -= step_[static_cast<Index>(p)];
      high[static_cast<Index>(p)] += step_[static_cast<Index>(p)];
      runs.arms[p] = Arms{add(test, variant, low), add(test, variant, high)};
    }
  } catch (const InputError& problem) {
    if (std::string(problem.what()).find("'" + test.observation.name + "': ") != std::string::npos) throw;
    refuse(fmt::format("its job cannot be made: {}", problem.what()), "correct it");
  }
  return runs;
}

/// Returns the index of the job in the study. A job with the same settings as an earlier one is not added again.
std::size_t RoundOfJobs::add(const ObservedTest& test, const ObservedTest::Variant& variant, const VectorXd& z) {
  std::vector<std::string> sets = sets_;
  sets.push_back(fmt::format("uncertainty.enabled={}", test.observation.is_life()));
  for (const std::string& set : sets_at(std::vector<double>(z.begin(), z.end()))) sets.push_back(set);
  const auto job = std::make_shared<const Job>(job_from(variant.job, sets));
  const std::string settings =
      part_text(*job, JobPart::sim) + part_text(*job, JobPart::strain) + part_text(*job, JobPart::fatigue);
  const auto [known, fresh] = known_.try_emplace(xxh3(settings), study_.jobs.size());
  constexpr std::size_t digits = 12;
  if (fresh) study_.jobs.push_back({variant.name + "_" + known->first.substr(0, digits), job, ""});
  return known->second;
}

Axes::Axes(const RoundOfJobs& round)
    : prior_(VectorXd::Ones(own_spread_place + 1)), has_own_spread_(round.has_failures_in_service()) {
  prior_.head(own_spread_place) = round.prior();
  for (const auto& variants : round.runs())
    for (const RoundOfJobs::Runs& runs : variants)
      for (std::size_t p = 0; p < uncertain_count; ++p) own_[p] = own_[p] || runs.own[p];
  for (std::size_t p = 0; p < uncertain_count; ++p)
    if (std::any_of(round.runs().begin(), round.runs().end(), [&](const auto& variants) {
          return std::any_of(variants.begin(), variants.end(), [&](const auto& runs) { return runs.moves[p]; });
        }))
      places_.push_back(static_cast<Index>(p));
}

VectorXd Axes::all(const VectorXd& some) const {
  VectorXd z = VectorXd::Zero(own_spread_place + 1);
  for (Index i = 0; i < size(); ++i) z[places_[static_cast<std::size_t>(i)]] = some[i];
  z[own_spread_place] = has_own_spread_ ? some[size()] : own_spread_as_is;
  return z;
}

VectorXd Axes::some(const VectorXd& all_of_them) const {
  VectorXd z(size() + has_own_spread_);
  for (Index i = 0; i < size(); ++i) z[i] = all_of_them[places_[static_cast<std::size_t>(i)]];
  if (has_own_spread_) z[size()] = all_of_them[own_spread_place];
  return z;
}

}  // namespace dresslife::pipeline
