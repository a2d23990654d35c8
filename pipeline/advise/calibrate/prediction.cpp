#include "pipeline/advise/calibrate/prediction.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/advise/calibrate/life_over_parameters.h"
#include "pipeline/advise/calibrate/measured_bending.h"
#include "pipeline/advise/calibrate/own_spread.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/random.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int predicted_draws = 2000;  // the error of a decile is 3 % of the deviation

PredictedDeciles quantiles(const std::vector<double>& numbers) {
  return {quantile(numbers, 0.1), quantile(numbers, 0.5), quantile(numbers, 0.9)};
}

/// Returns deciles of a specimen's life with its scatter. In each draw of z a variant is chosen by its likelihood (`weighed`), or
/// with equal probability.
PredictedDeciles predicted_deciles(const ObservedLife& life, const Eigen::MatrixXd& draws, bool weighed) {
  RandomNumbers numbers(7);
  std::vector<double> lives;
  for (Index k = 0; k < draws.rows(); ++k) {
    const VectorXd z = draws.row(k).transpose();
    std::vector<double> weight;
    for (const LifeVariant& variant : life.variants) {
      if (!life.service.empty()) {  // a new dresspack has other individual values
        weight.push_back(0);
        continue;
      }
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
    const LifeAt at = life.variants[chosen](z);
    lives.push_back(at.log_median + std::hypot(at.spread, life.unshared_spread, at.residual) * numbers.normal());
  }
  PredictedDeciles deciles = quantiles(lives);
  for (double& one : deciles) one = one >= endless_log_life - 3 ? HUGE_VAL : std::exp(one);
  return deciles;
}

}  // namespace

PredictedDeciles predicted_deciles(const EmulatedTest& test, const Eigen::MatrixXd& draws, bool weighed) {
  if (test.life) return predicted_deciles(*test.life, draws, weighed);
  std::vector<double> values;
  for (Index k = 0; k < draws.rows(); ++k) {
    const Measurement& variant = test.bending[static_cast<std::size_t>(k) % test.bending.size()];
    values.push_back(said_by_model(variant, variant.numbers[test.shown], draws.row(k).transpose()) / test.per_shown);
  }
  return quantiles(values);
}

namespace {

/// Returns how many independent numbers the measured ones are worth.
double independent_numbers(const EmulatedTest& test) {
  return std::min(static_cast<double>(test.bending.front().numbers.size()), most_independent_moments);
}

}  // namespace

double least_misfit(const EmulatedTest& test, const Eigen::MatrixXd& draws) {
  double best = -HUGE_VAL;
  for (Index k = 0; k < draws.rows(); ++k)
    for (const Measurement& variant : test.bending)
      best = std::max(best, log_likelihood(variant, draws.row(k).transpose()));
  return std::sqrt(-2 * best / independent_numbers(test));
}

double usual_misfit(const EmulatedTest& test) {
  constexpr double deviations = 2.78;                       // one side of a normal distribution beyond it: 1 of 370
  const double part = 2 / (9 * independent_numbers(test));  // Wilson and Hilferty's quantile of chi^2
  return std::pow(1 - part + deviations * std::sqrt(part), 1.5);
}

ServiceChance service_chance(const ObservedLife& life, const std::vector<ServiceRecord>& records,
                             const Eigen::MatrixXd& draws) {
  const int failures = sum_of(
      life.service, [](const ServiceFactor& one) { return one.failed ? one.count : 0; }, 0);
  std::map<long, int> entries;  // (age) number of dresspacks; ages within 5 % are one age
  int begun = 0;
  for (const ServiceRecord& one : records)
    if (one.entry_hours > 0) ++entries[std::lround(std::log(one.entry_hours) / 0.05)], ++begun;
  ServiceChance chance{0, 0, begun > 0 ? 0.0 : 1.0};
  const auto all = static_cast<double>(draws.rows());
  for (Index k = 0; k < draws.rows(); ++k) {
    const std::vector<LifeAt> lives =
        mapped(life.variants, [&](const LifeVariant& variant) { return variant(draws.row(k).transpose()); });
    const auto log_alive = [&](double log_age) {
      return log_mean(
          mapped(lives, [&](const LifeAt& at) { return log_normal_share((at.log_median - log_age) / at.spread); }));
    };
    const double mean = std::max(
        0.0, -sum_of(life.service, [&](const ServiceFactor& one) { return one.count * log_alive(one.log_age); }));
    const auto chance_of = [&](int n) {  // one exponential: that of -mean alone underflows for a mean of 745
      return n == 0 ? std::exp(-mean) : std::exp(n * std::log(mean) - mean - std::lgamma(n + 1.0));
    };
    double below = 0;  // probability of fewer failures
    for (int n = 0; n < failures; ++n) below += chance_of(n);
    chance.few += (below + chance_of(failures)) / all, chance.many += (1 - below) / all;
    for (const auto& [bin, count] : entries)
      chance.reach += count * std::exp(log_alive(0.05 * double(bin))) / begun / all;
  }
  return chance;
}

Eigen::MatrixXd prior_draws(const Axes& axes) {
  RandomNumbers numbers(5);
  Eigen::MatrixXd draws = Eigen::MatrixXd::Constant(predicted_draws, own_spread_place + 1, own_spread_as_is);
  for (Index k = 0; k < draws.rows(); ++k)
    draws.row(k).head(own_spread_place) =
        numbers.normals(VectorXd(own_spread_place)).cwiseProduct(axes.prior().head(own_spread_place)).transpose();
  return draws;
}

Eigen::MatrixXd posterior_draws(const Posterior& posterior, const Axes& axes) {
  Eigen::MatrixXd draws = prior_draws(axes);
  const Index every = posterior.draws.rows() / draws.rows();
  for (Index k = 0; k < draws.rows(); ++k) {
    for (Index i = 0; i < axes.size(); ++i)
      draws(k, axes.places()[static_cast<std::size_t>(i)]) = posterior.draws(k * every, i);
    if (axes.has_own_spread()) draws(k, own_spread_place) = posterior.draws(k * every, axes.size());
  }
  return draws;
}

Eigen::MatrixXd with_one_spread(Eigen::MatrixXd draws) {
  draws.col(own_spread_place).setConstant(own_spread_z(own_spread_of(draws.col(own_spread_place)).factor));
  return draws;
}

}  // namespace dresslife::pipeline
