#include "pipeline/advise/calibrate/service_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;

// A shape needs several failures: of one or two it may be infinite.
constexpr std::size_t fewest_failures = 5;
constexpr Index most_draws = 200;  // standard error of a mean of R: 0.002 at 0.01 or less

/// Returns -ln S(x), exact for small and large ages.
double cumulative_hazard(const std::vector<LifeAt>& lives, double log_age) {
  const auto margin = [&](const LifeAt& at) { return (at.log_median - log_age) / at.spread; };
  const double failed =
      sum_of(lives, [&](const LifeAt& at) { return normal_share(-margin(at)); }) / static_cast<double>(lives.size());
  if (failed < 0.5) return -std::log1p(-failed);
  return -log_mean(mapped(lives, [&](const LifeAt& at) { return log_normal_share(margin(at)); }));
}

/// Likelihood of a Weibull distribution of H with the shape b and its most likely rate.
class WeibullOfHazard {
 public:
  void add(double end, double entry, bool failed) {
    // an underflow represents an age of seconds
    const double least = 1e-300, log_end = std::log(std::max(end, least));
    total_ += end - entry, log_ends_.push_back(log_end);
    log_entries_.push_back(entry > 0 ? std::log(entry) : -HUGE_VAL);
    most_ = std::max(most_, log_end);
    if (failed) ++failures_, sum_ += log_end;
  }

  /// Returns ln R, a and b.
  std::array<double, 3> fit() const {
    constexpr double golden = 0.6180339887498949;
    double low = -3, high = 3.5;    // of ln b, from failures by chance to a scatter of 4 % (b = 33)
    for (int k = 0; k < 24; ++k) {  // to 6e-5 of ln b, which changes ln R by its square
      const double left = high - golden * (high - low), right = low + golden * (high - low);
      (at(left) < at(right) ? low : high) = at(left) < at(right) ? left : right;
    }
    const double log_shape = (low + high) / 2, log_rate = this->log_rate(std::exp(log_shape));
    return {std::min(0.0, -total_ - at(log_shape)), std::exp(std::clamp(log_rate, -50.0, 50.0)), std::exp(log_shape)};
  }

 private:
  /// Returns ln a, at which the number of failures is the expected one.
  double log_rate(double shape) const {
    double exposure = 0;  // in units of the largest H^b
    for (std::size_t k = 0; k < log_ends_.size(); ++k)
      exposure += std::exp(shape * (log_ends_[k] - most_)) - std::exp(shape * (log_entries_[k] - most_));
    return std::log(failures_) - std::log(exposure) - shape * most_;
  }
  double at(double log_shape) const {
    const double shape = std::exp(log_shape);
    return failures_ * (log_rate(shape) + log_shape - 1) + (shape - 1) * sum_;
  }

  std::vector<double> log_ends_, log_entries_;
  double failures_ = 0, total_ = 0, sum_ = 0, most_ = -HUGE_VAL;
};

}  // namespace

std::optional<ObservedAges> observed_ages(const std::vector<ServiceRecord>& records) {
  std::vector<double> begins = mapped(records, &ServiceRecord::entry_hours), ends;
  std::ranges::sort(begins);
  std::vector<ServiceRecord> by_end = records;
  // at equal ages a failure comes first
  std::ranges::sort(by_end, [](const ServiceRecord& a, const ServiceRecord& b) {
    return a.hours < b.hours || (a.hours == b.hours && a.failed > b.failed);
  });
  ObservedAges ages;
  bool has_begun = false;
  double alive = 1;
  std::size_t begun = 0;
  for (std::size_t ended = 0; ended < by_end.size(); ++ended) {
    const double age = by_end[ended].hours;
    while (begun < begins.size() && begins[begun] < age) {
      ++begun;
      if (!has_begun && begun - ended >= ObservedAges::fewest) has_begun = true, ages.from = begins[begun - 1];
    }
    const std::size_t in_use = begun - ended;
    if (!has_begun) continue;
    if (in_use < ObservedAges::fewest) break;
    ages.until = age;
    if (!by_end[ended].failed) continue;
    alive *= 1 - 1 / static_cast<double>(in_use);
    ages.failed_until = 1 - alive;
    constexpr double rounding = 1e-9;
    if (!ages.tenth && alive <= 0.9 + rounding) ages.tenth = age;
    if (!ages.half && alive <= 0.5 + rounding) ages.half = age;
  }
  if (!has_begun) return std::nullopt;
  return ages;
}

std::string words_of(const ObservedAges& ages) {
  std::string words;
  if (!ages.tenth)
    words = fmt::format("{:.0f} % had failed by {}", 100 * ages.failed_until, hours_text(ages.until));
  else
    words = fmt::format("10 % had failed by {}, ", hours_text(*ages.tenth)) +
            (ages.half ? "half by " + hours_text(*ages.half)
                       : fmt::format("{:.0f} % by {}", 100 * ages.failed_until, hours_text(ages.until)));
  return words + (ages.from > 0 ? fmt::format(", of those that reached {}", hours_text(ages.from)) : "");
}

ServiceFit service_fit(const ObservedLife& life, const std::vector<ServiceRecord>& records,
                       const Eigen::MatrixXd& draws) {
  ServiceFit fit{.observed = observed_ages(records)};
  const auto failures = std::ranges::count_if(records, &ServiceRecord::failed);
  const Index used = std::min(most_draws, draws.rows());
  const auto share = 1 / static_cast<double>(used);
  double chance = 0, log_rate = 0, log_shape = 0;
  for (Index k = 0; k < used; ++k) {
    const Eigen::VectorXd z = draws.row(k * (draws.rows() / used)).transpose();
    const std::vector<LifeAt> lives = mapped(life.variants, [&](const LifeVariant& variant) { return variant(z); });
    const auto hazard = [&](double hours) { return hours > 0 ? cumulative_hazard(lives, std::log(hours)) : 0; };
    if (fit.observed) {
      const auto failed_until = [&](const std::optional<double>& age) {
        return age ? share * -std::expm1(hazard(fit.observed->from) - hazard(*age)) : 0;
      };
      fit.predicted_tenth += failed_until(fit.observed->tenth);
      fit.predicted_half += failed_until(fit.observed->half);
    }
    if (failures < static_cast<std::ptrdiff_t>(fewest_failures)) continue;
    WeibullOfHazard weibull;
    for (const ServiceRecord& one : records) weibull.add(hazard(one.hours), hazard(one.entry_hours), one.failed);
    const auto [log_ratio, rate, shape] = weibull.fit();
    chance += share * std::exp(log_ratio), log_rate += share * std::log(rate), log_shape += share * std::log(shape);
  }
  if (failures >= static_cast<std::ptrdiff_t>(fewest_failures))
    fit.chance = chance, fit.rate = std::exp(log_rate), fit.shape = std::exp(log_shape);
  return fit;
}

}  // namespace dresslife::pipeline
