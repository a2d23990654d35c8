#include "fatigue/life_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/constants.h"
#include "pipeline/base/statistics.h"

namespace dresslife::fatigue {
namespace {

using pipeline::normal_density;
using pipeline::normal_share;

constexpr double log_accuracy = 1e-10;  // [ln life]

/// Returns the integral of Phi from minus infinity to y.
double integral_of_normal(double y) { return y * normal_share(y) + normal_density(y); }

/// Returns the ln t between low and high at which a rising probability reaches `share`.
template <class Probability>
double bisect(double low, double high, double share, const Probability& probability) {
  while (high - low > log_accuracy) {
    const double middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;  // rounding
    (probability(middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Cubics with the values and slopes at the ends of each cell, 128 cells per standard deviation. The error is h^4/384 times
/// the fourth derivative, which is at most 1.4.
class NormalTable {
 public:
  static constexpr double reach = 8;
  static constexpr int cells_of_one = 128;
  NormalTable() {
    constexpr double width = 1.0 / cells_of_one;
    for (int i = 0; i < int(2 * reach) * cells_of_one; ++i) {
      const double z = i * width - reach, y0 = normal_share(z), y1 = normal_share(z + width);
      const double s0 = width * normal_density(z), s1 = width * normal_density(z + width);
      cell_.push_back({y0, s0, 3 * (y1 - y0) - 2 * s0 - s1, 2 * (y0 - y1) + s0 + s1});
    }
  }
  double operator()(double z) const {
    if (!(z > -reach)) return 0;
    if (z >= reach) return 1;
    const double x = (z + reach) * cells_of_one;
    const auto i = static_cast<std::size_t>(x);
    const double t = x - double(i);
    const std::array<double, 4>& c = cell_[i];
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }

 private:
  std::vector<std::array<double, 4>> cell_;
};

}  // namespace

double tabulated_normal(double z) {
  static const NormalTable table;
  return table(z);
}

double Scatter::own() const { return log10 * std::sqrt(1 - shared); }
double Scatter::common() const { return log10 * std::sqrt(shared); }

// Adds one event after the other: with p the next probability, P(k) becomes P(k) (1-p) + P(k-1) p. Only counts
// below `count` are stored; the probability that leaves them is summed in `reached`.
double at_least(std::span<const double> probability, std::size_t count) {
  if (count == 0) return 1;
  std::vector<double> exactly(count, 0.0);
  exactly[0] = 1;
  double reached = 0;
  for (const double p : probability) {
    reached += exactly[count - 1] * p;
    for (std::size_t k = count - 1; k > 0; --k) exactly[k] += p * (exactly[k - 1] - exactly[k]);
    exactly[0] *= 1 - p;
  }
  return reached;
}

LifeDistribution::LifeDistribution(Probability own, double low, double high, double common)
    : own_(std::move(own)), low_(low), high_(high), common_(common) {
  if (common_ > 0 && low_ < high_) tabulate();
}

// With s the common deviation, P(x) = integral of F(u) phi((x - u)/s) du/s. F is linear between points, so a piece with
// slope m contributes m [I(x - u0) - I(x - u1)], I(y) = s G(y/s), G' = Phi.
double LifeDistribution::operator()(double log_life) const {
  if (low_ == high_) {
    if (common_ == 0) return log_life >= low_ ? 1 : 0;
    return normal_share((log_life - low_) / common_);
  }
  if (common_ == 0) return own_(log_life);
  double sum = 0, right = integral_of_normal((log_life - table_low_) / common_);
  for (std::size_t i = 0; i < step_.size(); ++i) {
    const double left = right;
    right = integral_of_normal((log_life - table_low_ - double(i + 1) * width_) / common_);
    sum += step_[i] * (left - right);
  }
  return sum * common_ / width_;
}

// Linear pieces of width h add h^2/6 to the variance: 0.35 % of the variance of own and common part. The deviation of the own
// part is about a tenth of the distance between both ends.
void LifeDistribution::tabulate() {
  constexpr double negligible = 1e-6, piece = 0.145;  // piece^2/6 = 0.0035
  const double accuracy = std::max(1e-4 * (high_ - low_), 0.02 * common_);
  const auto end = [&](double share) {
    double low = low_, high = high_;
    while (high - low > accuracy) {
      const double middle = (low + high) / 2;
      (own_(middle) < share ? low : high) = middle;
    }
    return share < 0.5 ? low : high;
  };
  table_low_ = end(negligible);
  const double whole = end(1 - negligible) - table_low_;
  const auto pieces =
      static_cast<std::size_t>(std::clamp(std::ceil(whole / (piece * std::hypot(common_, whole / 10))), 8.0, 70.0));
  width_ = whole / double(pieces);
  double before = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const double now = i + 1 == pieces ? 1 : own_(table_low_ + double(i + 1) * width_);
    step_.push_back(now - before);
    before = now;
  }
}

double life_of_share(const std::vector<LifeDistribution>& distributions, double share) {
  if (distributions.empty()) return infinity;
  double low = infinity, high = infinity;
  for (const LifeDistribution& one : distributions) low = std::min(low, one.low()), high = std::min(high, one.high());
  return std::exp(bisect(low, high, share, [&](double log_life) {
    double none = 1;
    for (const LifeDistribution& one : distributions) none *= 1 - one(log_life);
    return 1 - none;
  }));
}

Percentiles first_of(const std::vector<LifeDistribution>& distributions) {
  Percentiles result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = life_of_share(distributions, percentiles[i]);
  return result;
}

Wires::Wires(std::span<const double> damage) {
  for (const double d : damage)
    if (d > 0) lives_.push_back(1 / d);
  std::ranges::sort(lives_);
  for (const double life : lives_) log_.push_back(std::log(life));
}

double Wires::failed(double log_time, std::size_t count, double own, std::vector<double>& memory) const {
  memory.clear();
  constexpr double far = 6.5;  // standard deviations: a probability of 4e-11
  for (const double median : log_) {
    const double z = (log_time - median) / own;
    if (z < -far) break;
    memory.push_back(tabulated_normal(z));
  }
  return at_least(memory, count);
}

/// Returns the distribution of the count-th break. Precondition: at least `count` wires are damaged.
LifeDistribution distribution_of(std::shared_ptr<const Wires> wires, std::size_t count, Scatter scatter) {
  const double own = scatter.own() * std::numbers::ln10;
  return {[wires, count, own, memory = std::vector<double>()](double log_time) mutable {
            return wires->failed(log_time, count, own, memory);
          },
          wires->log_life(own > 0 ? 0 : count - 1) - LifeDistribution::farthest * own,
          wires->log_life(count - 1) + LifeDistribution::farthest * own, scatter.common() * std::numbers::ln10};
}

}  // namespace dresslife::fatigue
