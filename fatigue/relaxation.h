// Relaxation of mean stress while a motion repeats ((F22), (F23)).
//
// A repeated history runs between two strains. Its outermost loop has an offset stress
//     s_0 = +-[curve(L) - branch(R)/2],  L the largest |strain|, R the range,                        (F22)
// and so have all loops inside it, because their positions in the outermost loop are fixed (F4). In repeat n the offset is
// s_0 n^r (Jhansale and Topper 1971), r = -r1 (eps_a/eps_th - 1) above eps_th, else 0 (Landgraf and Chernenkoff
// 1988), eps_a = R/2. The remaining part n^r is called the share.
#pragma once

#include <functional>
#include <span>

#include "pipeline/job/fatigue.h"
#include "pipeline/job/material.h"

namespace dresslife::fatigue {

/// Law by which a material's offset falls. Built once, then only read.
class Relaxation {
 public:
  Relaxation(const pipeline::Material& material, const pipeline::Fatigue& settings);
  bool never() const { return never_; }        ///< the offset stays at any amplitude
  bool complete() const { return complete_; }  ///< the offset is zero before the first repeat
  /// Returns r <= 0 of a history with this strain amplitude. It is continuous, and 0 up to the threshold. Precondition: neither
  /// never() nor complete().
  double exponent(double strain_amplitude) const;

 private:
  bool never_ = true, complete_ = false;
  double threshold_ = 0, rate_ = 0;
};

/// Returns the mean of n^r over the first `repeats` repeats, with the whole offset in the first repeat or a part of it. Falls
/// with both arguments; 1 for r = 0, 0 for infinite `repeats`.
double mean_share(double repeats, double exponent);

/// Writes the damage per repeat for each of these remaining shares of the offset.
using DamageOfShares = std::function<void(std::span<const double> share, std::span<double> damage)>;

/// Returns the number of repeats at which the damage sums up to 1 (F23): the integral over n of damage(max(n, 1)^r) reaches 1.
/// Infinity if it has not reached 1 by 2^50 and does not grow. Error of the life for smooth damage: 1e-5, below a hundred repeats
/// 5e-4. Precondition: r <= 0; damage is monotonic in the share, as it is for all mean stress rules.
double relaxing_life(double exponent, const DamageOfShares& damage);

/// Returns this life with an error of some ten per cent, at most 1e15, from one value of damage(share) for each power of ten;
/// for the innermost loop. ten_to_exponent: 10^r. middle_share: 5.5^r, in the middle of 1 to 10.
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
