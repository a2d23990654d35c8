#include "pipeline/advise/calibrate/posterior.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/base/statistics.h"
#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The samples are worth at least 1,500 independent ones: the error of a mean is 0.026, of a spread 2 %. Three times that.
constexpr double of_mean = 0.09, of_spread = 0.06;

/// ln life that increases by `slope` along the axes.
Emulator straight(double value, const VectorXd& slope) {
  const VectorXd none = VectorXd::Zero(slope.size()), same = VectorXd::Constant(slope.size(), value);
  return {none, VectorXd::Ones(slope.size()), value, same - slope, same + slope};
}

ObservedLife life(LifeEnd end, double observed, const Emulator& emulator, double spread) {
  ObservedLife one;
  one.log_life = observed;
  one.end = end;
  one.variants = {[=](const VectorXd& z) { return LifeAt{emulator(z), spread}; }};
  return one;
}
LogLikelihood term(ObservedLife observed) {
  return [observed](const VectorXd& z) { return log_likelihood(observed, z); };
}

TEST_CASE("posterior: without data it is the prior") {
  const Posterior posterior = posterior_of({}, VectorXd::Constant(5, 0.7));
  CHECK(posterior.laplace.converged);
  CHECK(posterior.laplace.most_likely.norm() < 1e-6);
  CHECK((posterior.laplace.covariance - MatrixXd::Identity(5, 5)).norm() < 1e-5);
  CHECK(posterior.worth > 1500);
  CHECK(posterior.chains_disagree < 1.01);
  for (Index j = 0; j < 5; ++j) {
    CHECK(posterior.mean[j] == Approx(0).margin(of_mean));
    CHECK(posterior.covariance(j, j) == Approx(1).epsilon(2 * of_spread));
    CHECK(posterior.low[j] == Approx(-1.2816).margin(of_mean));
    CHECK(posterior.high[j] == Approx(1.2816).margin(of_mean));
  }
}

TEST_CASE("posterior: how far chains disagree and what draws are worth, of numbers with closed forms") {
  // Eight halves of +-1 in sequence, half of them shifted by 1: within 8/7, between 2/7; batches of one sample.
  Posterior posterior;
  posterior.draws.resize(64, 1);
  for (Index k = 0; k < 64; ++k) posterior.draws(k, 0) = (k % 2 ? 1 : -1) + (k < 32 ? 0 : 1);
  summarise(posterior);
  CHECK(posterior.chains_disagree == Approx(std::sqrt(9.0 / 8)));
  CHECK(posterior.worth == Approx(9.0 / 7 / (80.0 / 63) * 64));
}

TEST_CASE("posterior: lives that broke, under a straight model, have a closed form") {
  // Precision: I + sum of slope slope'/s^2.
  std::mt19937 random(5);
  std::normal_distribution<double> number;
  for (const int rows : {1, 2, 6}) {
    MatrixXd precision = MatrixXd::Identity(4, 4);
    VectorXd pull = VectorXd::Zero(4);
    std::vector<LogLikelihood> terms;
    for (int row = 0; row < rows; ++row) {
      VectorXd slope(4);
      for (double& each : slope) each = number(random);
      const double observed = 10 + 2 * number(random), spread = 0.3;
      terms.push_back(term(life(LifeEnd::broken, observed, straight(10, slope), spread)));
      precision += slope * slope.transpose() / (spread * spread);
      pull += slope * (observed - 10) / (spread * spread);
    }
    const MatrixXd covariance = precision.inverse();
    const VectorXd mean = covariance * pull;
    const Posterior posterior = posterior_of(terms, VectorXd::Zero(4));
    CHECK((posterior.laplace.most_likely - mean).norm() < 1e-5);
    CHECK((posterior.laplace.covariance - covariance).norm() < 1e-4);
    for (Index j = 0; j < 4; ++j) {
      const double deviation = std::sqrt(covariance(j, j));
      CHECK(posterior.mean[j] == Approx(mean[j]).margin(of_mean * deviation));
      CHECK(std::sqrt(posterior.covariance(j, j)) == Approx(deviation).epsilon(of_spread));
      CHECK(posterior.median[j] == Approx(mean[j]).margin(1.3 * of_mean * deviation));
    }
  }
}

TEST_CASE("posterior: with run-outs only the samples are right, Laplace is not") {
  // z ~ N(0, 1), likelihood Phi((a + b z)/s): mean b/S phi(a/S)/Phi(a/S), S^2 = s^2 + b^2 (extended skew-normal); variance
  // 1 - (b/S)^2 r (r + a/S), r = phi/Phi.
  const double b = 1.5, s = 0.3;
  double worst = 0;
  for (const double a : {2.0, 0.0, -2.0, -5.0}) {
    const double S = std::hypot(s, b), x = a / S;
    const double ratio = std::exp(-x * x / 2 - log_normal_share(x)) / std::sqrt(2 * std::numbers::pi);
    const double mean = b / S * ratio, deviation = std::sqrt(1 - b * b / (S * S) * ratio * (ratio + x));
    const Emulator model = straight(10, VectorXd::Constant(1, b));
    const Posterior posterior = posterior_of({term(life(LifeEnd::at_least, 10 - a, model, s))}, VectorXd::Zero(1));
    CHECK(posterior.mean[0] == Approx(mean).margin(of_mean * deviation));
    CHECK(std::sqrt(posterior.covariance(0, 0)) == Approx(deviation).epsilon(of_spread));
    worst = std::max(worst, std::abs(posterior.laplace.most_likely[0] - mean) / deviation);
  }
  CHECK(worst > 0.5);
}

TEST_CASE("posterior: run-outs never shorten a life, and longer ones lengthen it") {
  // A likelihood that increases with the life moves any prior to longer lives. Reference: sums over a plane; also bent models.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    VectorXd low(2), high(2);
    for (int j = 0; j < 2; ++j) low[j] = 3 * number(random), high[j] = 3 * number(random);
    const Emulator model(VectorXd::Zero(2), VectorXd::Ones(2), 0, low, high);
    ObservedLife row = life(LifeEnd::at_least, 0, model, 0.2 + std::abs(number(random)));
    row.specimens = 1 + trial % 3;
    row.common_share = trial % 2 ? 0.5 : 0;
    double before = -1e9;
    for (const double observed : {-1e6, -3.0, -1.0, 0.0, 1.0, 3.0}) {  // the first contains no information
      row.log_life = observed;
      const std::vector<LogLikelihood> terms{term(row)};
      double weight = 0, sum = 0;
      for (double z0 = -5; z0 <= 5; z0 += 0.5)
        for (double z1 = -5; z1 <= 5; z1 += 0.5) {
          const VectorXd z = (VectorXd(2) << z0, z1).finished();
          const double density = std::exp(log_posterior(terms, z));
          weight += density;
          sum += density * model(z);
        }
      CHECK(sum / weight >= before - 1e-9);
      before = sum / weight;
    }
  }
}

TEST_CASE("posterior: true parameters lie in the 80 % interval as often as they should") {
  // Three parameters from the prior, four rows simulated by the model: two breaks and two run-outs. The life of another program
  // is predicted. The interval of 80 % has a deviation of 2 % in 400 trials; the bounds of 75 .. 85 are 2.5 deviations.
  std::mt19937 random(17);
  std::normal_distribution<double> number;
  constexpr int trials = 400, axes = 3;
  const VectorXd program = (VectorXd(axes) << 1.0, -0.7, 0.4).finished();
  VectorXd within = VectorXd::Zero(axes);
  double program_within = 0;
  for (int trial = 0; trial < trials; ++trial) {
    VectorXd truth(axes);
    for (double& each : truth) each = number(random);
    std::vector<LogLikelihood> terms;
    for (int row = 0; row < 4; ++row) {
      VectorXd slope(axes);
      for (double& each : slope) each = 0.8 * number(random);
      const double spread = 0.4, limit = 8;
      const Emulator model = straight(8, slope);
      const double lived = model(truth) + spread * number(random);
      const LifeEnd end = row < 2 ? LifeEnd::broken : lived > limit ? LifeEnd::at_least : LifeEnd::at_most;
      terms.push_back(term(life(end, row < 2 ? lived : limit, model, spread)));
    }
    SamplerSettings quick;
    quick.draws = 1000;
    quick.seed = static_cast<std::uint64_t>(trial);
    const Posterior posterior = posterior_of(terms, VectorXd::Zero(axes), quick);
    for (Index j = 0; j < axes; ++j) within[j] += posterior.low[j] <= truth[j] && truth[j] <= posterior.high[j];
    const VectorXd lives = posterior.draws * program;
    const std::vector<double> drawn(lives.begin(), lives.end());
    const double true_life = program.dot(truth);
    program_within += quantile(drawn, 0.1) <= true_life && true_life <= quantile(drawn, 0.9);
  }
  CAPTURE(within.transpose(), program_within);
  for (const double each : within) {
    CHECK(each / trials > 0.75);
    CHECK(each / trials < 0.85);
  }
  CHECK(program_within / trials > 0.75);
  CHECK(program_within / trials < 0.85);
}

TEST_CASE("posterior: the same numbers every time, and quantiles between neighbours") {
  const Emulator model = straight(8, VectorXd::Constant(2, 0.6));
  const std::vector<LogLikelihood> terms{term(life(LifeEnd::at_least, 9, model, 0.3))};
  CHECK(posterior_of(terms, VectorXd::Zero(2)).draws == posterior_of(terms, VectorXd::Zero(2)).draws);
  CHECK(quantile({3, 1, 2}, 0.5) == 2);
  CHECK(quantile({3, 1, 2}, 0.25) == Approx(1.5));
  CHECK(quantile({4}, 0.9) == 4);
}

}  // namespace
}  // namespace dresslife::pipeline
