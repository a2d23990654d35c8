#include "pipeline/advise/calibrate/likelihood.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pipeline/base/lists.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

double log_density(double x, double deviation) { return -x * x / (2 * deviation * deviation) - std::log(deviation); }

/// Returns ln of the sum over y of phi(y) dy Phi((margin + c y)/o)^n. The step is 0.1, which is accurate for a smooth integrand.
/// If o is less than a tenth of c, the integrand is nearly a step function, and the error is at most 2 %.
double log_all_within(double margin, double common, double own, int specimens) {
  constexpr double reach = 8, width = 0.1;
  constexpr int steps = static_cast<int>(2 * reach / width);
  std::vector<double> terms;
  for (int i = 0; i <= steps; ++i) {
    const double y = i * width - reach;
    terms.push_back(specimens * log_normal_share((margin + common * y) / own) - y * y / 2);
  }
  return log_mean(terms) + std::log((steps + 1) * width) - std::log(2 * std::numbers::pi) / 2;
}

double log_likelihood(const ObservedLife& observed, const LifeVariant& variant, const Eigen::VectorXd& z) {
  const auto [median, spread, between, residual] = variant(z);
  const double margin = median - observed.log_life;
  const double common = std::hypot(std::hypot(std::sqrt(observed.common_share) * spread, observed.unshared_spread),
                                   std::hypot(between, residual));
  const double own = std::sqrt(1 - observed.common_share) * spread, all = std::hypot(common, own);
  const int n = observed.specimens;
  if (observed.end == LifeEnd::broken) return log_density(margin, std::hypot(common, own / std::sqrt(n)));
  const double within = observed.end == LifeEnd::at_least ? margin : -margin;
  if (n == 1 || own < 1e-3 * common) return log_normal_share(within / all);
  return log_all_within(within, common, own, n);
}

/// Phi or phi by linear interpolation between values at a distance of 0.001; the error is at most 3e-8. A sampler calls it 1e9
/// times.
class NormalTable {
 public:
  explicit NormalTable(double (*of)(double)) {
    for (int k = 0; k <= steps; ++k) values_.push_back(of(reach * (2.0 * k / steps - 1)));
    values_.push_back(values_.back());
  }
  double operator()(double z) const {
    const double place = (std::clamp(z, -reach, reach) / reach + 1) * steps / 2;
    const auto below = static_cast<std::size_t>(place);
    return values_[below] + (place - static_cast<double>(below)) * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr double reach = 8;
  static constexpr int steps = 16000;
  std::vector<double> values_;
};

/// Computes (P5) from means of shares; for small shares from their logarithms.
class ServiceLikelihood {
 public:
  ServiceLikelihood(const std::vector<LifeVariant>& variants, const Eigen::VectorXd& z) {
    for (const LifeVariant& variant : variants) lives_.push_back(variant(z));
    for (const LifeAt& life : lives_) per_spread_.push_back(1 / life.spread);
  }

  double operator()(const ServiceFactor& one) const {
    static const NormalTable share(normal_share), density(normal_density);
    double sum = 0;
    for (std::size_t k = 0; k < lives_.size(); ++k) {
      const double margin = (lives_[k].log_median - one.log_age) * per_spread_[k];
      sum += one.failed ? density(margin) * per_spread_[k] : share(margin);
    }
    const double mean = sum / static_cast<double>(lives_.size());
    constexpr double small = 1e-3;  // at this value the table has a relative error of 3e-5
    return one.count * (mean > small ? std::log(mean) : log_of_small(one));
  }

 private:
  double log_of_small(const ServiceFactor& one) const {
    std::vector<double> terms;
    for (const LifeAt& life : lives_) {
      const double margin = life.log_median - one.log_age;
      terms.push_back(one.failed ? log_density(margin, life.spread) - std::log(2 * std::numbers::pi) / 2
                                 : log_normal_share(margin / life.spread));
    }
    return log_mean(terms);
  }

  std::vector<LifeAt> lives_;
  std::vector<double> per_spread_;
};

}  // namespace

double log_mean(const std::vector<double>& terms) {
  const double most = *std::max_element(terms.begin(), terms.end());
  if (std::isinf(most)) return most;
  const double sum = sum_of(terms, [&](double term) { return std::exp(term - most); });
  return most + std::log(sum / static_cast<double>(terms.size()));
}

double log_likelihood(const ObservedLife& observed, const Eigen::VectorXd& z) {
  assert(!observed.variants.empty());
  if (!observed.service.empty()) return sum_of(observed.service, ServiceLikelihood(observed.variants, z));
  return log_mean(
      mapped(observed.variants, [&](const LifeVariant& variant) { return log_likelihood(observed, variant, z); }));
}

double said_by_model(const Measurement& measurement, const MeasuredNumber& number, const Eigen::VectorXd& z) {
  return sum_of(number.parts, [&](const auto& part) {
    const auto& [quantity, factor] = part;
    return factor * std::exp(measurement.log_quantities[quantity](z));
  });
}

double log_likelihood(const Measurement& measurement, const Eigen::VectorXd& z) {
  double sum = 0;
  for (const MeasuredNumber& number : measurement.numbers) {
    const double off = (number.value - said_by_model(measurement, number, z)) / number.deviation;
    sum -= off * off / 2;
  }
  return sum;
}

}  // namespace dresslife::pipeline
