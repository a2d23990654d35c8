// Distribution of the life of several wires: k of n broken, with a part of the scatter that is common to all. Equations (F14),
// (F15), (F25) of fatigue/scatter.h. Time is ln of a number of repeats in this file.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace dresslife::fatigue {

/// Shares of all dresspacks that have failed by the reported lives.
constexpr std::array<double, 3> percentiles{0.1, 0.5, 0.9};
using Percentiles = std::array<double, percentiles.size()>;

/// Standard deviation of log10 of a wire's life, and the share of its variance that is common to all wires of a dresspack. A
/// single number converts to a scatter without a common part.
struct Scatter {
  double log10 = 0, shared = 0;
  Scatter(double of_log10, double common_share = 0) : log10(of_log10), shared(common_share) {}
  double own() const;     ///< of log10, for each wire by itself
  double common() const;  ///< of log10, for all wires together
};

/// Returns P(at least `count` of independent events happen). probability: (event). Precondition: 0 <= count.
double at_least(std::span<const double> probability, std::size_t count);

/// Returns Phi(z) from a table: error 1e-12; 0 and 1 beyond eight deviations. For the many wires of many places.
double tabulated_normal(double z);

/// Probability of failure over ln t, after all lives are multiplied by a common random factor (F25).
class LifeDistribution {
 public:
  using Probability = std::function<double(double log_life)>;

  /// own: probability from the wires' own scatter; 0 at low, 1 at high, except for 1e-18. low == high: a step there. common:
  /// standard deviation of ln of the common factor.
  LifeDistribution(Probability own, double low, double high, double common);

  double operator()(double log_life) const;
  double low() const { return low_ - farthest * common_; }
  double high() const { return high_ + farthest * common_; }
  static constexpr double farthest = 9;  ///< standard deviations: 1e-19 of all wires lie beyond

 private:
  void tabulate();

  Probability own_;
  double low_, high_, common_;
  double table_low_ = 0, width_ = 0;
  std::vector<double> step_;  // (piece) rise of the probability
};

/// Returns the life by which in `share` of all cases at least one of several independent parts has failed; infinity without
/// parts.
double life_of_share(const std::vector<LifeDistribution>& distributions, double share);
/// Returns life_of_share() for all `percentiles`.
Percentiles first_of(const std::vector<LifeDistribution>& distributions);

/// Median lives of several wires in order. damage (wire): per repeat; wires without damage are left out.
class Wires {
 public:
  explicit Wires(std::span<const double> damage);
  std::size_t damaged() const { return lives_.size(); }
  double life(std::size_t place) const { return lives_[place]; }
  double log_life(std::size_t place) const { return log_[place]; }
  /// Returns P(at least count have broken), (F15). own: standard deviation of ln life > 0.
  double failed(double log_time, std::size_t count, double own, std::vector<double>& memory) const;

 private:
  std::vector<double> lives_, log_;
};

/// Returns the distribution of the count-th break of several wires. Precondition: count <= damaged().
LifeDistribution distribution_of(std::shared_ptr<const Wires> wires, std::size_t count, Scatter scatter);

}  // namespace dresslife::fatigue
