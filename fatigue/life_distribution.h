// How the life of some wires together is distributed: k of n broken, with a part of the scatter that all have
// in common.
//
// Equations (F14), (F15), (F25) of README.md. Time is ln of a number of repeats throughout.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace dresslife::fatigue {

/// Shares of all dresspacks that have failed by the stated life.
constexpr std::array<double, 3> percentiles{0.1, 0.5, 0.9};
using Percentiles = std::array<double, percentiles.size()>;

/// Standard deviation of log10 of a wire's life, and the share of its variance that all wires of a dresspack
/// have in common. A number alone: nothing in common.
struct Scatter {
  double log10 = 0, shared = 0;
  Scatter(double of_log10, double common_share = 0) : log10(of_log10), shared(common_share) {}
  double own() const;     ///< of log10, of each wire
  double common() const;  ///< of log10, of all together
};

/// P(at least `count` of independent events happen), (event) -> probability. 0 <= count.
double at_least(std::span<const double> probability, std::size_t count);

/// Phi(z) by a table: within 1e-12, 0 and 1 beyond eight deviations. For the many wires of many places.
double tabulated_normal(double z);

/// Probability over ln t that something has failed, once all lives vary by a common factor, too (F25).
class LifeDistribution {
 public:
  using Probability = std::function<double(double log_life)>;

  /// own: by the wires' own scatter; 0 at low, 1 at high but for 1e-18. low == high: a step there. common:
  /// deviation of ln of the factor that is common.
  LifeDistribution(Probability own, double low, double high, double common);

  double operator()(double log_life) const;
  double low() const { return low_ - farthest * common_; }
  double high() const { return high_ + farthest * common_; }
  static constexpr double farthest = 9;  ///< standard deviations: beyond lies 1e-19 of all wires

 private:
  void tabulate();

  Probability own_;
  double low_, high_, common_;
  double table_low_ = 0, width_ = 0;
  std::vector<double> step_;  // (piece) what the probability rises by
};

/// Life by which `share` of all cases have one of several that are independent failed; infinite without any.
double life_of_share(const std::vector<LifeDistribution>& distributions, double share);
/// The same for all `percentiles`.
Percentiles first_of(const std::vector<LifeDistribution>& distributions);

/// Median lives of some wires in order. damage (wire): per repeat; what is not damaged is not among them.
class Wires {
 public:
  explicit Wires(std::span<const double> damage);
  std::size_t damaged() const { return lives_.size(); }
  double life(std::size_t place) const { return lives_[place]; }
  double log_life(std::size_t place) const { return log_[place]; }
  /// P(at least count have broken), (F15). own: deviation of ln life > 0.
  double failed(double log_time, std::size_t count, double own, std::vector<double>& memory) const;

 private:
  std::vector<double> lives_, log_;
};

/// Of the count-th of some wires; precondition: so many are damaged.
LifeDistribution distribution_of(std::shared_ptr<const Wires> wires, std::size_t count, Scatter scatter);

}  // namespace dresslife::fatigue
