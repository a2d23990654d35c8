#include "pipeline/advise/calibrate/learning.h"

#include <algorithm>
#include <cmath>

#include "pipeline/advise/calibrate/learned_calibration.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int most_rounds = 5;
constexpr double still = 0.25;  // of what is left to know: the centre moves no more

/// Predicts each test from all others. A model that a test contradicts shows here, and not in a prediction that the test
/// itself has moved.
void predict_by_others(const Emulation& emulation, const Axes& axes, const VectorXd& start, std::vector<LearnedTest>& tests) {
  constexpr SamplerSettings short_chains{.draws = 3000};  // a decile to 4 % of the deviation, as far as 1,000 are independent
  const std::vector<LogLikelihood> terms = terms_of(emulation.tests, axes);
  for (std::size_t t = 0; t < tests.size(); ++t) {
    std::vector<LogLikelihood> others = terms;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
    tests[t].by_others = others.empty() ? tests[t].before
                                        : foretold(emulation.tests[t],
                                                   posterior_draws(posterior_of(others, start, short_chains), axes), false);
  }
}

}  // namespace

Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets,
              const StudyPlaces& places, const MakeRows& make_rows) {
  Learned learned;
  VectorXd centre = VectorXd::Zero(uncertain_count), step = VectorXd::Ones(uncertain_count);
  const std::string name = places.folder.filename().string();
  std::set<std::string> notes;
  for (const ObservedTest& test : tests) learned.tests.push_back({test.observation});
  while (!learned.settled && learned.rounds < most_rounds) {
    const RoundOfJobs round(tests, sets, name, centre, step);
    const Emulation emulation = emulate(tests, round, make_rows(round.study()), places);
    const Axes axes(round);
    notes.insert(emulation.notes.begin(), emulation.notes.end());
    learned.posterior = posterior_of(terms_of(emulation.tests, axes), axes.some(centre));
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
      const EmulatedTest& emulated = emulation.tests[t];
      if (learned.rounds == 1) learned.tests[t].before = foretold(emulated, prior_draws(), false);
      learned.tests[t].after = foretold(emulated, posterior_draws(learned.posterior, axes), true);
      learned.tests[t].fails_first = emulated.fails_first;
      if (!emulated.life)
        learned.tests[t].measured = emulated.bending[0].numbers[emulated.shown].value / emulated.per_shown;
    }
    if (!learned.settled && learned.rounds < most_rounds) continue;
    learned.axes = learned_axes(learned.posterior, axes);
    predict_by_others(emulation, axes, learned.posterior.laplace.most_likely, learned.tests);
    learned.calibration = calibration_of(learned, tests, round, places);
    learned.notes.assign(notes.begin(), notes.end());
    add_doubts(learned, axes);
  }
  return learned;
}

}  // namespace dresslife::pipeline
