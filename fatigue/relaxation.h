// Mean stress that relaxes while a motion repeats (README F22, F23).
//
// A repeated history runs between two strains; its outermost loop is off centre by a stress
//     s_0 = +-[curve(L) - branch(R)/2],  L the largest |strain|, R the range,                        (F22)
// and so is every loop in it: they keep their places in the outer one (F4). In repeat n the offset is s_0 n^r
// (Jhansale and Topper 1971), r = -r1 (eps_a/eps_th - 1) above eps_th, else 0 (Landgraf and Chernenkoff
// 1988), eps_a = R/2. What is left of it, n^r, is its share here.
#pragma once

#include <functional>
#include <span>

#include "pipeline/job/fatigue.h"
#include "pipeline/job/material.h"

namespace dresslife::fatigue {

/// How a material's offset falls; built once, const in use.
class Relaxation {
 public:
  Relaxation(const pipeline::Material& material, const pipeline::Fatigue& settings);
  bool never() const { return never_; }        ///< the offset stays, whatever the amplitude
  bool complete() const { return complete_; }  ///< it is gone before the first repeat
  /// r <= 0 of a history with this strain amplitude: continuous, 0 up to the threshold. Precondition: neither
  /// never() nor complete().
  double exponent(double strain_amplitude) const;

 private:
  bool never_ = true, complete_ = false;
  double threshold_ = 0, rate_ = 0;
};

/// Mean of n^r over the first so many repeats, of which the first, and a part of it, has the whole offset.
/// Falls with both; 1 for r = 0, 0 for a life without end.
double mean_share(double repeats, double exponent);

/// Damage per repeat with each of these shares of the offset left.
using DamageOfShares = std::function<void(std::span<const double> share, std::span<double> damage)>;

/// Repeats until the damage sums up to 1 (F23): the integral over n of damage(max(n, 1)^r) reaches 1.
/// Infinite where it has not by 2^50 and has stopped. The damage must go one way with the share, as that of
/// all mean stress rules does. Where it is smooth the life is right within 1e-5, below a hundred repeats
/// within 5e-4. Precondition: r <= 0.
double relaxing_life(double exponent, const DamageOfShares& damage);

/// The same to some ten per cent, and 1e15 at most, from `damage(share)` at one share for each power of ten:
/// for the innermost loop. ten_to_exponent: 10^r; middle_share: 5.5^r, in the middle of 1 to 10.
template <class Damage>
double rough_relaxing_life(double ten_to_exponent, double middle_share, const Damage& damage) {
  constexpr int powers = 15;  // most_reversals
  const double first = damage(1.0);
  if (first >= 1) return 1 / first;
  double sum = first, repeats = 1, share = middle_share;
  for (int power = 0; power < powers; ++power) {
    const double rate = damage(share), more = 9 * repeats * rate;
    if (sum + more >= 1) return repeats + (1 - sum) / rate;
    sum += more, repeats *= 10, share *= ten_to_exponent;
  }
  return repeats;
}

}  // namespace dresslife::fatigue
