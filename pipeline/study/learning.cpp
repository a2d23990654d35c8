#include "pipeline/study/learning.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "pipeline/files/digest.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/job/sources.h"
#include "pipeline/job/units.h"
#include "pipeline/readable.h"
#include "pipeline/statistics/normal_numbers.h"
#include "pipeline/study/measured_bending.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double endless_log = 41.4;  // ln 1e18: where there is no damage, nobody waits for a break
constexpr double least_log_spread = -6.9;  // ln 0.001: of ln life, where nothing scatters
constexpr int most_rounds = 5;
constexpr double still = 0.25;  // of what is left to know: the centre moves no more
constexpr double deciles = 1.2815515655446004;  // of a normal distribution, in its deviations

// ---- jobs -------------------------------------------------------------------------------------------------

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

/// Whether a parameter can move the job's life.
bool acts(const Job& job, Uncertain parameter) {
  switch (parameter) {
    case Uncertain::friction_inside:
      return any_rubs(job);
    case Uncertain::friction_hose:
    case Uncertain::slack:
    case Uncertain::play:
      return any_in_hose(job);
    case Uncertain::grip:
      return any_grip(job);
    case Uncertain::strength:
    case Uncertain::slope:
    case Uncertain::scatter:
    case Uncertain::model:
      return true;
  }
  return true;
}

/// The jobs of a round: of each variant one at the centre and two along each axis that moves it.
class RoundOfJobs {
 public:
  struct Arms {
    std::size_t low, high;  ///< jobs
  };
  struct Runs {
    std::size_t centre;
    std::array<std::optional<Arms>, uncertain_count> arms;
  };

  RoundOfJobs(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, std::string name,
              VectorXd centre, VectorXd step)
      : sets_(sets), centre_(std::move(centre)), step_(std::move(step)) {
    const Sources read_once;
    study_.name = std::move(name);
    sets_.push_back("uncertainty.enabled=false");
    for (const ObservedTest& test : tests) {
      runs_.emplace_back();
      for (const ObservedTest::Variant& variant : test.variants) runs_.back().push_back(runs_of(test, variant));
    }
  }

  const Study& study() const { return study_; }
  const VectorXd& centre() const { return centre_; }
  const VectorXd& step() const { return step_; }
  const std::vector<std::vector<Runs>>& runs() const { return runs_; }  ///< (test, variant)

 private:
  Runs runs_of(const ObservedTest& test, const ObservedTest::Variant& variant) {
    const auto refuse = [&](const std::string& what, const std::string& remedy) {
      throw InputError(test.where, fmt::format("'{}': {}", test.observation.name, what), remedy);
    };
    if (!variant.failure.empty()) refuse("its job cannot be made: " + variant.failure, "mend it");
    Runs runs;
    try {
      const Job plain = job_from(variant.job, sets_);
      if (plain.calibration) refuse("its job names a calibration, whose observations would count twice", "leave calibration out");
      if (plain.strain.factors != StrainFactors{} || is_changed(plain.fatigue) || plain.fatigue.scatter_factor != 1)
        refuse("its job gives a key that is to be learned", "leave the factors of strain and fatigue out");
      runs.centre = add(variant, centre_);
      for (std::size_t p = 0; p < uncertain_count; ++p) {
        if (!acts(plain, static_cast<Uncertain>(p))) continue;
        if (!test.observation.is_life() && !uncertain_parameters()[p].of_strain) continue;
        VectorXd low = centre_, high = centre_;
        low[static_cast<Index>(p)] -= step_[static_cast<Index>(p)];
        high[static_cast<Index>(p)] += step_[static_cast<Index>(p)];
        runs.arms[p] = Arms{add(variant, low), add(variant, high)};
      }
    } catch (const InputError& problem) {
      if (std::string(problem.what()).find("'" + test.observation.name + "': ") != std::string::npos) throw;
      refuse(fmt::format("its job cannot be made: {}", problem.what()), "mend it");
    }
    return runs;
  }

  /// The job's place in the study; one that is there already under the same settings is not added again.
  std::size_t add(const ObservedTest::Variant& variant, const VectorXd& z) {
    std::vector<std::string> sets = sets_;
    for (const std::string& set : sets_at(std::vector<double>(z.begin(), z.end()))) sets.push_back(set);
    const auto job = std::make_shared<const Job>(job_from(variant.job, sets));
    const std::string settings =
        part_text(*job, Part::sim) + part_text(*job, Part::strain) + part_text(*job, Part::fatigue);
    const auto [known, fresh] = known_.try_emplace(xxh3(settings), study_.jobs.size());
    constexpr std::size_t digits = 12;
    if (fresh) study_.jobs.push_back({variant.name + "_" + known->first.substr(0, digits), job, ""});
    return known->second;
  }

  std::vector<std::string> sets_;
  VectorXd centre_, step_;
  Study study_;
  std::map<std::string, std::size_t> known_;
  std::vector<std::vector<Runs>> runs_;
};

// ---- from rows to likelihoods -----------------------------------------------------------------------------

class RowsByJob {
 public:
  RowsByJob(const Study& study, const std::vector<RankingRow>& rows) : study_(study) {
    for (const RankingRow& row : rows) by_name_[row.job] = &row;
  }
  const RankingRow* done(std::size_t job) const {
    const auto found = by_name_.find(study_.jobs[job].name);
    return found != by_name_.end() && found->second->done() ? found->second : nullptr;
  }
  std::string failure(std::size_t job) const {
    const auto found = by_name_.find(study_.jobs[job].name);
    return found == by_name_.end() ? "it was not computed" : found->second->failure;
  }

 private:
  const Study& study_;
  std::map<std::string, const RankingRow*> by_name_;
};

struct LogLife {
  double median, spread;  ///< ln of life, and ln of the deviation of it
};
LogLife log_life_of(const Observation& observation, const RankingRow& row) {
  const std::array<double, 3> lives = lives_of(observation, row);
  if (!std::isfinite(lives[2])) return {endless_log, least_log_spread};
  const double spread = std::log(lives[2] / lives[0]) / (2 * deciles);
  return {std::min(endless_log, std::log(lives[1])), std::max(least_log_spread, std::log(spread))};
}

LifeEnd end_of(ObservedEnd end) {
  if (bounds_above(end) && bounds_below(end)) return LifeEnd::broken;
  return bounds_below(end) ? LifeEnd::at_least : LifeEnd::at_most;
}

double observed_value(const Observation& observation) { return observation.cycles ? *observation.cycles : *observation.hours; }

/// What was run of a test: a life, or how a cable bends, of each variant.
struct EmulatedTest {
  std::optional<ObservedLife> life{};
  std::vector<Measurement> bending{};  ///< (variant), of the same numbers
  std::size_t shown = 0;             ///< number that is told
  double per_shown = 1;              ///< by which it is divided: a stiffness by its curvature

  double log_likelihood_at(const VectorXd& z) const {
    if (life) return log_likelihood(*life, z);
    std::vector<double> terms;
    for (const Measurement& variant : bending) terms.push_back(log_likelihood(variant, z));
    return log_mean(terms);
  }
};

class Emulation {
 public:
  Emulation(const std::vector<ObservedTest>& tests, const RoundOfJobs& round, const std::vector<RankingRow>& rows,
            const StudyPlaces& places)
      : round_(round), rows_(round.study(), rows), places_(places) {
    for (std::size_t t = 0; t < tests.size(); ++t)
      tests_.push_back(tests[t].observation.is_life() ? EmulatedTest{observed_life(tests[t], round.runs()[t])}
                                                      : observed_bending(tests[t], round.runs()[t]));
  }

  const std::vector<EmulatedTest>& tests() const { return tests_; }
  const std::set<std::string>& notes() const { return notes_; }

 private:
  ObservedLife observed_life(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& variants) {
    const Observation& observation = test.observation;
    ObservedLife life;
    life.log_life = std::log(observed_value(observation));
    life.end = end_of(observation.outcome);
    // A maker promises it of a cable that somebody buys.
    life.specimens = observation.outcome == ObservedEnd::rating ? 1 : observation.specimens;
    life.unshared_spread = observation.unshared_log10 * std::numbers::ln10;
    for (const RoundOfJobs::Runs& runs : variants) {
      life.variants.push_back(variant_of(observation, runs, log_life_of(observation, row_of(test, runs.centre))));
      life.common_share = std::max(life.common_share, common_share(runs, life.variants.back()));
    }
    return life;
  }

  const RankingRow& row_of(const ObservedTest& test, std::size_t job) const {
    if (const RankingRow* const row = rows_.done(job)) return *row;
    throw InputError(test.where, fmt::format("'{}': its job failed: {}", test.observation.name, rows_.failure(job)),
                     "mend it, or leave the row out");
  }

  EmulatedTest observed_bending(const ObservedTest& test, const std::vector<RoundOfJobs::Runs>& variants) {
    const Observation& observation = test.observation;
    const std::vector<BendingPoint> points =
        observation.stiffness ? std::vector<BendingPoint>{{observation.at_curvature, *observation.stiffness * observation.at_curvature}}
                              : read_bending(observation.bending);
    const BendingNumbers bent = bending_numbers(points, observation.noise_percent / 100);
    EmulatedTest made;
    if (observation.stiffness) made.per_shown = observation.at_curvature;
    for (std::size_t k = 0; k < bent.numbers.size(); ++k)
      if (std::abs(bent.numbers[k].value) > std::abs(bent.numbers[made.shown].value)) made.shown = k;
    for (const RoundOfJobs::Runs& runs : variants) made.bending.push_back({moments_over(test, runs, bent.curvatures), bent.numbers});
    return made;
  }

  /// ln of the first-bend moment at each curvature over z.
  std::vector<Emulator> moments_over(const ObservedTest& test, const RoundOfJobs::Runs& runs,
                                     const std::vector<double>& curvatures) const {
    const auto said = [&](std::size_t job) {
      row_of(test, job);
      const FileReader strain(places_.job(round_.study().jobs[job].name) / "strain.h5", strain_format());
      if (!strain.has("/bending/moment"))
        throw InputError(test.where,
                         fmt::format("'{}': nothing is told of how its cable bends (that needs one cable, in which "
                                     "strain.slip lets something rub and no part lies straight beside the axis)",
                                     test.observation.name),
                         "give dresspack.cable, and strain.slip such as [free, friction, friction]");
      const auto curvature = strain.read<double>("/bending/curvature"), moment = strain.read<double>("/bending/moment");
      VectorXd values(static_cast<Index>(curvatures.size()));
      for (std::size_t c = 0; c < curvatures.size(); ++c)
        values[static_cast<Index>(c)] = log_moment(curvature, moment, curvatures[c]);
      return values;
    };
    const VectorXd middle = said(runs.centre);
    Eigen::MatrixXd low = middle.replicate(1, uncertain_count), high = low;
    for (std::size_t p = 0; p < uncertain_count; ++p) {
      if (!runs.arms[p]) continue;
      low.col(static_cast<Index>(p)) = said(runs.arms[p]->low);
      high.col(static_cast<Index>(p)) = said(runs.arms[p]->high);
    }
    std::vector<Emulator> made;
    for (Index c = 0; c < middle.size(); ++c)
      made.emplace_back(round_.centre(), round_.step(), middle[c], low.row(c).transpose(), high.row(c).transpose());
    return made;
  }

  LifeVariant variant_of(const Observation& observation, const RoundOfJobs::Runs& runs, const LogLife& middle) {
    VectorXd low_life = VectorXd::Constant(uncertain_count, middle.median), high_life = low_life;
    VectorXd low_spread = VectorXd::Constant(uncertain_count, middle.spread), high_spread = low_spread;
    for (std::size_t p = 0; p < uncertain_count; ++p) {
      if (!runs.arms[p]) continue;
      const auto at = static_cast<Index>(p);
      const auto side = [&](std::size_t job) -> std::optional<LogLife> {
        const RankingRow* row = rows_.done(job);
        return row ? std::optional(log_life_of(observation, *row)) : std::nullopt;
      };
      std::optional<LogLife> low = side(runs.arms[p]->low), high = side(runs.arms[p]->high);
      if (!low || !high)
        notes_.insert(fmt::format("'{}': a job to one side of {} failed ({}); the other side alone tells of it",
                                  observation.name, uncertain_parameters()[p].name,
                                  rows_.failure(low ? runs.arms[p]->high : runs.arms[p]->low)));
      const auto mirrored = [&](const std::optional<LogLife>& of) {
        return of ? LogLife{2 * middle.median - of->median, 2 * middle.spread - of->spread} : middle;
      };
      if (!low) low = mirrored(high);
      if (!high) high = mirrored(low);
      low_life[at] = low->median, high_life[at] = high->median;
      low_spread[at] = low->spread, high_spread[at] = high->spread;
    }
    return {{round_.centre(), round_.step(), middle.median, low_life, high_life},
            {round_.centre(), round_.step(), middle.spread, low_spread, high_spread}};
  }

  /// Of the variance of a specimen's ln life, what all of a spool have in common.
  double common_share(const RoundOfJobs::Runs& runs, const LifeVariant& variant) const {
    const Fatigue& fatigue = round_.study().jobs[runs.centre].job->fatigue;
    const double wires = fatigue.scatter_log10 * fatigue.scatter_factor * std::numbers::ln10;
    const double spread = std::exp(variant.log_spread.at_centre());
    return std::min(1.0, fatigue.scatter_shared * wires * wires / (spread * spread));
  }

  const RoundOfJobs& round_;
  RowsByJob rows_;
  const StudyPlaces& places_;
  std::vector<EmulatedTest> tests_;
  std::set<std::string> notes_;
};

// ---- axes -------------------------------------------------------------------------------------------------

/// Between all parameters and those that some test hangs on.
class Axes {
 public:
  explicit Axes(const RoundOfJobs& round) {
    for (std::size_t p = 0; p < uncertain_count; ++p)
      if (std::any_of(round.runs().begin(), round.runs().end(), [&](const auto& variants) {
            return std::any_of(variants.begin(), variants.end(), [&](const auto& runs) { return runs.arms[p].has_value(); });
          }))
        places_.push_back(static_cast<Index>(p));
  }
  const std::vector<Index>& places() const { return places_; }
  Index size() const { return static_cast<Index>(places_.size()); }
  VectorXd all(const VectorXd& some) const {
    VectorXd z = VectorXd::Zero(uncertain_count);
    for (Index i = 0; i < size(); ++i) z[places_[static_cast<std::size_t>(i)]] = some[i];
    return z;
  }
  VectorXd some(const VectorXd& all_of_them) const {
    VectorXd z(size());
    for (Index i = 0; i < size(); ++i) z[i] = all_of_them[places_[static_cast<std::size_t>(i)]];
    return z;
  }

 private:
  std::vector<Index> places_;
};

std::vector<LogLikelihood> terms_of(const std::vector<EmulatedTest>& tests, const Axes& axes) {
  std::vector<LogLikelihood> terms;
  for (const EmulatedTest& test : tests)
    terms.push_back([&test, &axes](const VectorXd& some) { return test.log_likelihood_at(axes.all(some)); });
  return terms;
}

// ---- what is told -----------------------------------------------------------------------------------------

Foretold quantiles(const std::vector<double>& numbers) {
  return {quantile(numbers, 0.1), quantile(numbers, 0.5), quantile(numbers, 0.9)};
}

/// A specimen's life in each draw of z: a variant by how likely it makes the observation there (`weighed`) or any, and its
/// scatter.
Foretold foretold(const ObservedLife& life, const Eigen::MatrixXd& draws, bool weighed) {
  NormalNumbers numbers(7);
  std::vector<double> lives;
  for (Index k = 0; k < draws.rows(); ++k) {
    const VectorXd z = draws.row(k).transpose();
    std::vector<double> weight;
    for (const LifeVariant& variant : life.variants) {
      ObservedLife alone = life;
      alone.variants = {variant};
      weight.push_back(weighed ? log_likelihood(alone, z) : 0);
    }
    const double most = *std::max_element(weight.begin(), weight.end());
    double sum = 0;
    for (double& one : weight) sum += one = std::exp(one - most);
    double left = numbers.uniform() * sum;
    std::size_t chosen = 0;
    while (chosen + 1 < weight.size() && left > weight[chosen]) left -= weight[chosen++];
    const LifeVariant& variant = life.variants[chosen];
    const double spread = std::hypot(std::exp(variant.log_spread(z)), life.unshared_spread);
    lives.push_back(variant.log_life(z) + spread * numbers.next());
  }
  Foretold told = quantiles(lives);
  for (double& one : told) one = one >= endless_log - 3 ? HUGE_VAL : std::exp(one);
  return told;
}

Foretold foretold(const EmulatedTest& test, const Eigen::MatrixXd& draws, bool weighed) {
  if (test.life) return foretold(*test.life, draws, weighed);
  std::vector<double> values;
  for (Index k = 0; k < draws.rows(); ++k) {
    const Measurement& variant = test.bending[static_cast<std::size_t>(k) % test.bending.size()];
    values.push_back(said_by_model(variant, variant.numbers[test.shown], draws.row(k).transpose()) / test.per_shown);
  }
  return quantiles(values);
}

/// So many draws of all parameters: of the prior, or of what was learned beside a prior of the others.
constexpr int told_draws = 2000;
Eigen::MatrixXd prior_draws() {
  NormalNumbers numbers(5);
  Eigen::MatrixXd draws(told_draws, static_cast<Index>(uncertain_count));
  for (Index k = 0; k < draws.rows(); ++k) draws.row(k) = numbers.vector(draws.cols()).transpose();
  return draws;
}
Eigen::MatrixXd posterior_draws(const Posterior& posterior, const Axes& axes) {
  Eigen::MatrixXd draws = prior_draws();
  const Index every = posterior.draws.rows() / draws.rows();
  for (Index k = 0; k < draws.rows(); ++k)
    for (Index i = 0; i < axes.size(); ++i)
      draws(k, axes.places()[static_cast<std::size_t>(i)]) = posterior.draws(k * every, i);
  return draws;
}

std::vector<LearnedAxis> learned_axes(const Posterior& posterior, const Axes& axes) {
  std::vector<LearnedAxis> learned(uncertain_count);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    learned[p].before = {parameter.value(-deciles), parameter.value(0), parameter.value(deciles)};
    learned[p].after = learned[p].before;
  }
  for (Index i = 0; i < axes.size(); ++i) {
    const auto p = static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(i)]);
    const UncertainParameter& parameter = uncertain_parameters()[p];
    learned[p].learned = true;
    learned[p].after = {parameter.value(posterior.low[i]), parameter.value(posterior.median[i]),
                        parameter.value(posterior.high[i])};
    learned[p].narrowed = std::sqrt(posterior.covariance(i, i));
  }
  return learned;
}

std::string life_words(double life) { return std::isfinite(life) ? readable(life, 2) : "no damage"; }
std::string words_of(const Foretold& told) {
  return fmt::format("{} ({} .. {})", life_words(told[1]), life_words(told[0]), life_words(told[2]));
}

double to_figures(double value, int figures) {
  return value == 0 || !std::isfinite(value) ? value : std::stod(fmt::format("{:.{}g}", value, figures));
}

/// What the jobs at the centre went through, from their files.
LearnedWithin within_of(const std::vector<ObservedTest>& tests, const RoundOfJobs& round, const StudyPlaces& places) {
  LearnedWithin within;
  std::set<std::string> materials;
  const auto least = [](std::optional<double>& of, double value) { of = std::min(of.value_or(value), value); };
  const auto most = [](std::optional<double>& of, double value) { of = std::max(of.value_or(value), value); };
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (!tests[t].observation.is_life()) continue;  // it says nothing of lives
    if (const auto cycles = tests[t].observation.cycles) least(within.fewest_cycles, *cycles), most(within.most_cycles, *cycles);
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
  constexpr double degree = std::numbers::pi / 180;  // the unit of the file
  if (within.largest_twist) within.largest_twist = to_figures(*within.largest_twist / degree, 4) * degree;
  within.materials = fmt::format("{}", fmt::join(materials, ", "));
  return within;
}

std::string digest_of(const ObservedTest& test) {
  const std::filesystem::path& table = test.observation.bending;
  return xxh3(test.text + (table.empty() ? "" : xxh3_of_file(table)));
}

Calibration calibration_of(const Learned& learned, const Axes& axes) {
  constexpr double decimals = 1e6;
  const auto rounded = [&](double value) { return std::round(value * decimals) / decimals; };
  Calibration calibration;
  const Posterior& posterior = learned.posterior;
  calibration.note = fmt::format("{} observations, {} rounds{}; draws worth {} independent ones, chains disagree by {:.3f}",
                                 learned.tests.size(), learned.rounds, learned.settled ? "" : " (not settled)",
                                 readable(posterior.worth, 2), posterior.chains_disagree);
  for (Index i = 0; i < axes.size(); ++i) {
    const auto p = static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(i)]);
    LearnedParameter parameter;
    parameter.name = uncertain_parameters()[p].name;
    parameter.median = rounded(posterior.median[i]);
    parameter.mean = rounded(posterior.mean[i]);
    for (Index j = 0; j < axes.size(); ++j) parameter.covariance.push_back(rounded(posterior.covariance(i, j)));
    parameter.value = to_figures(learned.axes[p].after[1], 4);
    parameter.value_p10 = to_figures(learned.axes[p].after[0], 4);
    parameter.value_p90 = to_figures(learned.axes[p].after[2], 4);
    calibration.parameters.push_back(parameter);
  }
  return calibration;
}

/// How many of its deviations a prediction lies short of what was seen, or beyond it; 0 where it agrees.
double surprise(const LearnedTest& test) {
  const Observation& observation = test.observation;
  const double seen = observation.is_life() ? observed_value(observation) : test.measured;
  const auto off = [&](double side) { return std::log(seen / test.before[1]) / (std::log(side / test.before[1]) / deciles); };
  if (!(seen > 0) || !std::isfinite(test.before[2])) return 0;
  const bool both = !observation.is_life() || observation.outcome == ObservedEnd::broken;
  if (seen > test.before[1]) return both || bounds_below(observation.outcome) ? off(test.before[2]) : 0;
  return both || bounds_above(observation.outcome) ? off(test.before[0]) : 0;
}

/// What a user should look at before what was learned is believed.
void add_doubts(Learned& learned, const Axes& axes) {
  constexpr double surprising = 2, skewed = 0.3;  // deviations
  for (const LearnedTest& test : learned.tests)
    if (const double off = surprise(test); off > surprising)
      learned.notes.push_back(fmt::format("'{}' lies {:.1f} deviations from what was foretold: look at its construction and at what was "
                                          "done to it before what it teaches is believed",
                                          test.observation.name, off));
  const Posterior& posterior = learned.posterior;
  for (Index i = 0; i < axes.size(); ++i) {
    const double off = (posterior.median[i] - posterior.laplace.most_likely[i]) / std::sqrt(posterior.covariance(i, i));
    if (std::abs(off) > skewed)
      learned.notes.push_back(fmt::format("{}: its median lies {:.1f} deviations from its likeliest value, as what has not failed leaves "
                                          "it; the draws count",
                                          uncertain_parameters()[static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(i)])].name, off));
  }
}

}  // namespace

Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, const StudyPlaces& places,
              const MakeRows& make_rows) {
  Learned learned;
  VectorXd centre = VectorXd::Zero(uncertain_count), step = VectorXd::Ones(uncertain_count);
  const std::string name = places.folder.filename().string();
  std::set<std::string> notes;
  for (const ObservedTest& test : tests) learned.tests.push_back({test.observation});
  while (!learned.settled && learned.rounds < most_rounds) {
    const RoundOfJobs round(tests, sets, name, centre, step);
    const Emulation emulation(tests, round, make_rows(round.study()), places);
    const Axes axes(round);
    notes.insert(emulation.notes().begin(), emulation.notes().end());
    learned.posterior = posterior_of(terms_of(emulation.tests(), axes), axes.some(centre));
    ++learned.rounds;
    const VectorXd there = axes.all(learned.posterior.laplace.most_likely);
    learned.settled = true;
    for (Index i = 0; i < axes.size(); ++i) {
      const Index p = axes.places()[static_cast<std::size_t>(i)];
      const double left = std::min(1.0, std::sqrt(learned.posterior.covariance(i, i)));
      if (std::abs(there[p] - centre[p]) > still * left) learned.settled = false;
      step[p] = std::clamp(2 * left, 0.25, 1.0);
    }
    centre = there;
    for (std::size_t t = 0; t < tests.size(); ++t) {
      const EmulatedTest& emulated = emulation.tests()[t];
      if (learned.rounds == 1) learned.tests[t].before = foretold(emulated, prior_draws(), false);
      learned.tests[t].after = foretold(emulated, posterior_draws(learned.posterior, axes), true);
      if (!emulated.life) learned.tests[t].measured = emulated.bending[0].numbers[emulated.shown].value / emulated.per_shown;
    }
    if (!learned.settled && learned.rounds < most_rounds) continue;
    learned.axes = learned_axes(learned.posterior, axes);
    learned.calibration = calibration_of(learned, axes);
    learned.calibration.within = within_of(tests, round, places);
    learned.notes.assign(notes.begin(), notes.end());
    add_doubts(learned, axes);
  }
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const LearnedTest& told = learned.tests[t];
    learned.calibration.observations.push_back({told.observation.name, observed_text(told.observation), words_of(told.before),
                                                words_of(told.after), digest_of(tests[t])});
  }
  return learned;
}

namespace {

std::string parameter_lines(const Learned& learned) {
  std::string text = fmt::format("{:<17} {:>24} {:>24}  {}\n", "parameter", "before (80 %)", "after (80 %)", "spread left");
  const auto range = [](const Foretold& of) {
    return fmt::format("{} ({} .. {})", readable(of[1]), readable(of[0]), readable(of[2]));
  };
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const LearnedAxis& axis = learned.axes[p];
    text += fmt::format("{:<17} {:>24} {:>24}  {}\n", uncertain_parameters()[p].name, range(axis.before),
                        axis.learned ? range(axis.after) : "-",
                        axis.learned ? fmt::format("{:.0f} %", 100 * axis.narrowed) : "no test hangs on it");
  }
  return text;
}

}  // namespace

std::string learned_table(const Learned& learned) {
  const auto seen = [](const LearnedTest& test) {
    return test.observation.bending.empty() ? observed_text(test.observation) : readable(test.measured, 3) + " N m";
  };
  std::string text = parameter_lines(learned);
  text += fmt::format("\n{:<22} {:>20} {:>34} {:>34}\n", "observation", "observed", "foretold before", "foretold after");
  for (const LearnedTest& test : learned.tests)
    text += fmt::format("{:<22} {:>20} {:>34} {:>34}\n", shortened(test.observation.name, 22), seen(test),
                        words_of(test.before), words_of(test.after));
  text += "\nparameters: factors of the job's keys (slope: added to b), median and 80 % of what is likely. Foretold: the life of "
          "one specimen, median and\n80 %, over parameters, what is not known of the test, and scatter; of a bending test its largest moment.\n";
  if (!learned.settled)
    text += fmt::format("warning: after {} rounds the centre still moves; the draws rest on runs beside it\n", learned.rounds);
  for (const std::string& note : learned.notes) text += "note: " + note + "\n";
  return text;
}

}  // namespace dresslife::pipeline
