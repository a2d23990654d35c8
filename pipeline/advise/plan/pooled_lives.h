// Lives of similar worlds together, because few lives of each world are known.
//
// x: ln of a life. m_w: mean of x over the n known lives of the world w. m: mean of m_w over the worlds. v: variance of m_w.
// s^2: variance of x in a world, mean over the worlds. m_w contains chance of the variance s^2/n. If a weight of a world and its
// forecast come from the same lives, worlds whose lives are long by chance get a large weight, and the forecast has too few
// failures. So the lives of a world have the mean
//     m'_w = m + (m_w - m) sqrt(max(0, 1 - s^2 / (n v)))                                    (D11)
// and their distances from it are quantiles of (x - m_w) sqrt(n / (n - 1)) of the worlds with similar m_w. Then means and
// distances have the variances of the law. This is exact if ln of lives is normal over the worlds and in them.
// No damage counts in m_w as a life 100 times as long as any that influences a decision.
#pragma once

#include <vector>

#include "pipeline/advise/plan/plan.h"

namespace dresslife::pipeline {

class PooledLives {
 public:
  explicit PooledLives(const LifeTable& table);
  /// Returns the share of dresspacks that reach an age in a world, from the lives of similar worlds, moved to the mean of this
  /// world. If no life is longer, half a life is assumed.
  double alive(std::size_t world, double age) const;
  /// Returns m'_w of (D11), (world).
  std::vector<double> means_without_chance() const;
  /// Returns `draws` lives of each world by (D11) [h], (world, draw), rising in each world. means: m'_w. The mean of these few
  /// lives deviates from m'_w, and early lives more often belong to worlds with a smaller mean. So weights (D3) need m'_w itself.
  std::vector<float> lives_around(const std::vector<double>& means) const;

 private:
  std::size_t draws_;
  double chance_ = 0;                         ///< s^2/n
  std::vector<double> mean_;                  ///< (world) m_w
  std::vector<std::size_t> order_;            ///< worlds by m_w, rising
  std::vector<std::size_t> begin_;            ///< (pool) its first place in order_; the last: end
  std::vector<std::size_t> pool_of_;          ///< (world)
  std::vector<std::vector<float>> distance_;  ///< (pool) x - m_w of its lives, rising
};

/// Changes the lives of a table to those of (D11). The longest life of a world remains that of the same draw, and so on.
void remove_chance(LifeTable& table);

}  // namespace dresslife::pipeline
