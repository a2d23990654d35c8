#include "pipeline/advise/calibrate/typical_cables.h"

#include <cmath>
#include <random>

#include "pipeline/advise/calibrate/observations.h"
#include "pipeline/base/digest.h"
#include "pipeline/job/calibration.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

const std::vector<Index> parameters{static_cast<Index>(index_of(Uncertain::friction_inside)),
                                    static_cast<Index>(index_of(Uncertain::strength)),
                                    static_cast<Index>(index_of(Uncertain::model))};
constexpr Index axes = 3;

double share(Index axis) {
  return share_between_cables(static_cast<std::size_t>(parameters[static_cast<std::size_t>(axis)]));
}

/// Returns the parameters with values for these axes; the others are 0.
VectorXd everywhere(const VectorXd& some) {
  VectorXd z = VectorXd::Zero(uncertain_count);
  for (Index i = 0; i < axes; ++i) z[parameters[static_cast<std::size_t>(i)]] = some[i];
  return z;
}

/// Returns the likelihood of a cable whose life is linear in z: ln life = 8 + slope z; it lasted the limit, or did not.
LogLikelihood told(const VectorXd& slope, double spread, double limit, bool lasted, bool typical) {
  ObservedLife life;
  life.log_life = limit;
  life.end = lasted ? LifeEnd::at_least : LifeEnd::at_most;
  std::array<bool, uncertain_count> acts;
  acts.fill(true);
  const auto median = [wide = everywhere(slope)](const VectorXd& z) { return 8 + wide.dot(z); };
  life.variants.push_back([=](const VectorXd& z) {
    return LifeAt{median(z), spread, typical ? deviation_between_cables(median, acts, z) : 0};
  });
  return [life](const VectorXd& some) { return log_likelihood(life, everywhere(some)); };
}

}  // namespace

TEST_CASE("typical cables: a parameter's own and common parts make its prior together") {
  std::vector<LogLikelihood> nothing{prior_of_deviations(common_deviations(parameters))};
  Posterior posterior = posterior_of(nothing, VectorXd::Zero(axes));
  for (Index i = 0; i < axes; ++i) CHECK(posterior.laplace.covariance(i, i) == Approx(1 - share(i)).epsilon(1e-3));
  add_own_deviations(posterior, parameters);
  // 48,000 samples, of which the chains are worth at least a tenth: the error of a deviation is 1/sqrt(2 4800) = 1 %.
  for (Index i = 0; i < axes; ++i) CHECK(std::sqrt(posterior.covariance(i, i)) == Approx(1).epsilon(0.04));
  CHECK(share(0) > share(1));
  CHECK(share(2) == 0);
}

TEST_CASE("typical cables: between cables a life deviates by what differs between them") {
  const VectorXd slope = (VectorXd(axes) << 2, -3, 5).finished(), wide = everywhere(slope);
  std::array<bool, uncertain_count> acts;
  acts.fill(true);
  const auto median = [&](const VectorXd& z) { return wide.dot(z); };
  const VectorXd anywhere = VectorXd::Constant(uncertain_count, 0.3);
  CHECK(deviation_between_cables(median, acts, anywhere) == Approx(std::sqrt(4 * share(0) + 9 * share(1))));
  acts[index_of(Uncertain::friction_inside)] = false;
  CHECK(deviation_between_cables(median, acts, anywhere) == Approx(3 * std::sqrt(share(1))));
}

TEST_CASE("typical cables: a new cable lies in the 80 % interval as often as it should") {
  // Seven makers' cables, each with its own deviations. Each lasted its limit or not. An eighth cable is predicted. The interval
  // of 80 % has a deviation of 2 % in 400 trials; the bounds of 75 .. 85 are 2.5 deviations.
  std::mt19937 random(23);
  std::normal_distribution<double> number;
  constexpr int trials = 400, makers = 7;
  const VectorXd program = (VectorXd(axes) << -0.8, 1.5, 0.7).finished();
  VectorXd within = VectorXd::Zero(axes);
  double program_within = 0, pooled_within = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto draw = [&](const VectorXd& mean, bool own) {
      VectorXd z = mean;
      for (Index i = 0; i < axes; ++i) z[i] += std::sqrt(own ? share(i) : 1 - share(i)) * number(random);
      return z;
    };
    const VectorXd common = draw(VectorXd::Zero(axes), false), truth = draw(common, true);
    std::vector<LogLikelihood> terms, pooled;
    for (int maker = 0; maker < makers; ++maker) {
      const VectorXd slope = (VectorXd(axes) << -0.6 * std::abs(number(random)), 1.5, 0.7).finished();
      const double spread = 0.4, limit = 8 + number(random);
      const double lived = 8 + slope.dot(draw(common, true)) + spread * number(random);
      terms.push_back(told(slope, spread, limit, lived > limit, true));
      pooled.push_back(told(slope, spread, limit, lived > limit, false));
    }
    terms.push_back(prior_of_deviations(common_deviations(parameters)));
    SamplerSettings quick;
    quick.draws = 1000;
    quick.seed = static_cast<std::uint64_t>(trial);
    Posterior posterior = posterior_of(terms, VectorXd::Zero(axes), quick);
    add_own_deviations(posterior, parameters);
    for (Index i = 0; i < axes; ++i) within[i] += posterior.low[i] <= truth[i] && truth[i] <= posterior.high[i];
    const auto holds = [&](const Posterior& of) {
      const VectorXd lives = of.draws * program;
      const std::vector<double> drawn(lives.begin(), lives.end());
      const double life = program.dot(truth);
      return quantile(drawn, 0.1) <= life && life <= quantile(drawn, 0.9);
    };
    program_within += holds(posterior);
    pooled_within += holds(posterior_of(pooled, VectorXd::Zero(axes), quick));
  }
  CAPTURE(within.transpose(), program_within, pooled_within);
  for (const double each : within) {
    CHECK(each / trials > 0.75);
    CHECK(each / trials < 0.85);
  }
  CHECK(program_within / trials > 0.75);
  CHECK(program_within / trials < 0.85);
  CHECK(pooled_within / trials < 0.75);  // with the assumption that all makers' cables are one
}

TEST_CASE("typical cables: the shipped file was learned from the shipped ratings") {
  const std::filesystem::path folder = std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/observations";
  Calibration calibration;
  read_fields(read_document(folder / "typical_cables.yaml"), calibration);
  CHECK(calibration.typical);
  const std::vector<ObservedTest> tests = read_observed_tests(folder / "ratings.yaml");
  REQUIRE(tests.size() == calibration.observations.size());
  for (std::size_t t = 0; t < tests.size(); ++t) {
    INFO("run scripts/ratings after a change of " << tests[t].observation.name);
    CHECK(calibration.observations[t].observation == tests[t].observation.name);
    CHECK(calibration.observations[t].digest == xxh3(tests[t].text));
  }
}
