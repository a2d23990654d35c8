#include "pipeline/advise/calibrate/learning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/advise/calibrate/learned_calibration.h"
#include "pipeline/advise/calibrate/typical_cables.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_rounds = 5;
// Standard deviations of the prior. One of ten parameters exceeds this limit in one of 1,600 cases; beyond 4.8 keys leave their
// allowed range.
constexpr double farthest = 4;
constexpr double still = 0.25;  // of the remaining deviation: the largest change of a converged centre of bending tests
// Half of the distance to the outermost runs of a life's response (W38), in standard deviations. Within it lives are
// interpolated.
constexpr double within_response = 0.7;

/// Returns whether a bending test has runs to either side along this parameter.
bool has_arms(const RoundOfJobs& round, Index parameter) {
  for (const std::vector<RoundOfJobs::Runs>& variants : round.runs())
    for (const RoundOfJobs::Runs& runs : variants)
      if (runs.arms[static_cast<std::size_t>(parameter)]) return true;
  return false;
}

bool of_typical_cables(const std::vector<ObservedTest>& tests) {
  return std::any_of(tests.begin(), tests.end(), [](const ObservedTest& test) { return test.typical; });
}

/// typical: the tests belong to different makers' cables, and the posterior to a cable that is none of them.
Posterior posterior_of(std::vector<LogLikelihood> terms, const Axes& axes, const VectorXd& start, bool typical,
                       const SamplerSettings& settings = {}) {
  terms.push_back(prior_of_deviations(typical ? common_deviations(axes.places()) : axes.some(axes.prior())));
  Posterior posterior = posterior_of(terms, start, settings);
  if (typical) add_own_deviations(posterior, axes.places());
  return posterior;
}

/// Throws InputError at the row that differs most from its prediction, if the most likely parameters are beyond `farthest`.
void refuse_contradiction(const std::vector<ObservedTest>& tests, const std::vector<LearnedTest>& learned,
                          const Axes& axes, const VectorXd& most_likely) {
  const VectorXd off = most_likely.cwiseQuotient(axes.some(axes.prior())).head(axes.size()).cwiseAbs();
  Index axis = 0;
  if (off.maxCoeff(&axis) <= farthest) return;
  std::size_t row = 0;
  for (std::size_t t = 1; t < tests.size(); ++t)
    if (surprise(learned[t]) > surprise(learned[row])) row = t;
  const Observation& observation = tests[row].observation;
  const std::optional<ObservedAges>& ages = learned[row].fit.observed;
  throw InputError(
      tests[row].where,
      fmt::format(
          "'{}': the observation ({}) contradicts the prediction ({}): it would need a {} {:.1f} standard deviations "
          "from what was assumed (limit {:g})",
          observation.name, observed_text(observation), words_of(learned[row].before),
          uncertain_parameters()[static_cast<std::size_t>(axes.places()[static_cast<std::size_t>(axis)])].name,
          off[axis], farthest),
      observation.service.empty()
          ? "correct the unit of the observation, or its job; else leave the row out"
          : "correct the reasons (preventive), dates and hours per week of the rows, or their job" +
                (ages ? "; until then plan with the observed hours: " + words_of(*ages) : ""));
}

/// Predicts each test from all others. This shows a test that contradicts the model, which a prediction that includes the test
/// itself might hide.
void predict_by_others(const std::vector<EmulatedTest>& emulated_tests, const Axes& axes, const VectorXd& start,
                       bool typical, std::vector<LearnedTest>& tests) {
  // error of a decile: 4 % of the deviation, if 1,000 draws are independent
  constexpr SamplerSettings short_chains{.draws = 3000};
  const std::vector<LogLikelihood> terms = terms_of(emulated_tests, axes);
  for (std::size_t t = 0; t < tests.size(); ++t) {
    std::vector<LogLikelihood> others = terms;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
    tests[t].by_others =
        others.empty()
            ? tests[t].before
            : predicted_deciles(
                  emulated_tests[t],
                  with_one_spread(posterior_draws(posterior_of(others, axes, start, typical, short_chains), axes)),
                  false);
  }
}

/// Returns warnings of dresspacks in service whose jobs exceed limits: the model does not include what may have ended them.
std::vector<std::string> spoiled_records(const std::vector<ObservedTest>& tests, const RoundOfJobs& round,
                                         const std::vector<RankingRow>& rows) {
  std::vector<std::string> warnings;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    if (tests[t].observation.service.empty()) continue;
    std::set<std::string> kinds;
    for (const RoundOfJobs::Runs& runs : round.runs()[t]) {
      const RankingRow* const row = find_in(rows, &RankingRow::job, round.study().jobs[runs.centre].name);
      if (!row) continue;
      for (const Warning& warning : warnings_of(*row))
        if (spoils_plan(warning.kind)) kinds.insert(title(warning.kind));
    }
    if (!kinds.empty())
      warnings.push_back(fmt::format(
          "'{}': its job exceeds limits ({}). The model does not include such damage, so these records may teach wrong "
          "parameters. Remedy: dresslife run of the job shows the limits; correct the job if the plant's dresspacks keep them",
          tests[t].observation.name, joined(kinds, ", ")));
  }
  return warnings;
}

}  // namespace

Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, const StudyPlaces& places,
              const MakeRows& make_rows) {
  Learned learned;
  VectorXd centre = VectorXd::Zero(own_spread_place + 1), step = VectorXd::Ones(own_spread_place);
  const bool typical = of_typical_cables(tests);
  const std::string name = places.folder.filename().string();
  for (const ObservedTest& test : tests) learned.tests.push_back({test.observation});
  while (!learned.settled && learned.rounds < most_rounds) {
    const RoundOfJobs round(tests, sets, name, centre.head(own_spread_place), step);
    const std::vector<RankingRow> rows = make_rows(round.study());
    const std::vector<EmulatedTest> emulated_tests = emulate(tests, round, rows, places);
    const Axes axes(round);
    learned.posterior = posterior_of(terms_of(emulated_tests, axes), axes, axes.some(centre), typical);
    ++learned.rounds;
    const VectorXd there = axes.all(learned.posterior.laplace.most_likely);
    learned.settled = true;
    for (Index i = 0; i < axes.size(); ++i) {
      const Index p = axes.places()[static_cast<std::size_t>(i)];
      const double left = std::min(1.0, std::sqrt(learned.posterior.covariance(i, i)));
      // The outermost runs along the hose's stiffness are nearer if the jobs state a small deviation.
      const double near = within_response * std::min(1.0, axes.prior()[p]);
      if (std::abs(there[p] - centre[p]) > (has_arms(round, p) ? still * left : near)) learned.settled = false;
      step[p] = std::clamp(2 * left, 0.25, 1.0);
    }
    if (axes.has_own_spread()) learned.own_spread = own_spread_of(learned.posterior.draws.col(axes.size()));
    const Eigen::MatrixXd drawn = posterior_draws(learned.posterior, axes);
    for (std::size_t t = 0; t < tests.size(); ++t) {
      const EmulatedTest& emulated = emulated_tests[t];
      if (learned.rounds == 1) learned.tests[t].before = predicted_deciles(emulated, prior_draws(axes), false);
      learned.tests[t].after = predicted_deciles(emulated, with_one_spread(drawn), true);
      if (const std::vector<ServiceRecord>& records = tests[t].observation.service; !records.empty()) {
        if (learned.rounds == 1)
          learned.tests[t].chance_before = service_chance(*emulated.life, records, prior_draws(axes));
        learned.tests[t].chance_after = service_chance(*emulated.life, records, drawn);
        learned.tests[t].fit = service_fit(*emulated.life, records, drawn);
      }
      learned.tests[t].fails_first = emulated.fails_first;
      learned.tests[t].moved_by = emulated.moved_by;
      if (!emulated.life)
        learned.tests[t].misfit = least_misfit(emulated, drawn), learned.tests[t].usual_misfit = usual_misfit(emulated),
        learned.tests[t].measured = emulated.bending[0].numbers[emulated.shown].value / emulated.per_shown;
    }
    refuse_contradiction(tests, learned.tests, axes, learned.posterior.laplace.most_likely);
    centre = there;
    if (!learned.settled && learned.rounds < most_rounds) continue;
    learned.warnings = spoiled_records(tests, round, rows);
    for (const LearnedTest& test : learned.tests)
      if (const std::string misfit = misfit_of(test); !misfit.empty()) learned.warnings.push_back(misfit);
    learned.axes = learned_axes(learned.posterior, axes);
    predict_by_others(emulated_tests, axes, learned.posterior.laplace.most_likely, typical, learned.tests);
    learned.walls = learned_walls(emulated_tests);
    learned.calibration = calibration_of(learned, tests, round, places);
    add_doubts(learned, axes);
  }
  return learned;
}

}  // namespace dresslife::pipeline
