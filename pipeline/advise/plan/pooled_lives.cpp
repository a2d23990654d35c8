#include "pipeline/advise/plan/pooled_lives.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t lives_of_pool = 8192;  // lives: the error of 1 - S = 1 % is 11 %

std::span<const float> lives_in(const LifeTable& table, std::size_t world) {
  return {table.hours.data() + world * table.draws, table.draws};
}

/// Sorts numbers by their bits, 11 at a time (radix sort). In a plan of 500 duties it takes 0.4 s; std::sort takes 4 s, because the
/// processor predicts half of its comparisons wrong.
void sort_by_bits(std::vector<float>& numbers) {
  constexpr std::uint32_t sign = 0x80000000, digits = 11, values = 1u << digits;
  std::vector<std::uint32_t> keys, sorted(numbers.size());  // in the order of the numbers
  for (const float number : numbers) {
    const auto bits = std::bit_cast<std::uint32_t>(number);
    keys.push_back(bits & sign ? ~bits : bits | sign);
  }
  for (std::uint32_t shift = 0; shift < 32; shift += digits) {
    std::array<std::uint32_t, values> place{};  // first the count of a digit, then its next place
    for (const std::uint32_t key : keys) ++place[key >> shift & (values - 1)];
    for (std::uint32_t next = 0; std::uint32_t & of_digit : place) next += std::exchange(of_digit, next);
    for (const std::uint32_t key : keys) sorted[place[key >> shift & (values - 1)]++] = key;
    keys.swap(sorted);
  }
  for (std::size_t k = 0; k < keys.size(); ++k)
    numbers[k] = std::bit_cast<float>(keys[k] & sign ? keys[k] ^ sign : ~keys[k]);
}

}  // namespace

PooledLives::PooledLives(const LifeTable& table) : draws_(table.draws), mean_(table.worlds), pool_of_(table.worlds) {
  constexpr double no_influence = 100;
  constexpr float shortest = 1e-3F;  // [h] so that its logarithm is finite
  const auto longest = static_cast<float>(std::log(no_influence * table.horizon_or_median()));
  const auto count = static_cast<double>(table.draws);
  std::vector<float> logs(table.hours.size());
  for (std::size_t w = 0; w < table.worlds; ++w) {
    double sum = 0, squares = 0;
    float* const of_world = logs.data() + w * table.draws;
    const std::span<const float> lives = lives_in(table, w);
    for (std::size_t d = 0; d < lives.size(); ++d) {
      of_world[d] = std::log(std::max(lives[d], shortest));
      const double x = std::min(of_world[d], longest);
      sum += x, squares += x * x;
    }
    mean_[w] = sum / count;
    if (table.draws > 1)
      chance_ += std::max(0.0, squares - sum * mean_[w]) / (count - 1) / count / static_cast<double>(table.worlds);
  }
  if (!table.mean_ln.empty()) mean_ = table.mean_ln;
  order_ = smallest_first(table.worlds, [&](std::size_t w) { return mean_[w]; });
  const std::size_t in_pool = std::clamp<std::size_t>(lives_of_pool / table.draws, 1, table.worlds),
                    pools = table.worlds / in_pool;
  distance_.resize(pools);
  for (std::size_t p = 0; p <= pools; ++p) begin_.push_back(table.worlds * p / pools);
  for (std::size_t p = 0; p < pools; ++p) {
    distance_[p].reserve((begin_[p + 1] - begin_[p]) * table.draws);
    for (std::size_t place = begin_[p]; place < begin_[p + 1]; ++place) {
      const std::size_t w = order_[place];
      pool_of_[w] = p;
      const float* const of_world = logs.data() + w * table.draws;
      for (std::size_t d = 0; d < table.draws; ++d) distance_[p].push_back(of_world[d] - static_cast<float>(mean_[w]));
    }
    sort_by_bits(distance_[p]);
  }
}

double PooledLives::alive(std::size_t world, double age) const {
  const std::vector<float>& all = distance_[pool_of_[world]];
  const auto longer = all.end() - std::ranges::upper_bound(all, static_cast<float>(std::log(age) - mean_[world]));
  return (double(longer) + 0.5) / (double(all.size()) + 0.5);
}

std::vector<double> PooledLives::means_without_chance() const {
  const auto worlds = static_cast<double>(mean_.size());
  double mean = 0, variance = 0;
  for (const double of_world : mean_) mean += of_world / worlds;
  for (const double of_world : mean_) variance += (of_world - mean) * (of_world - mean) / worlds;
  const double narrower = variance > 0 ? std::sqrt(std::max(0.0, 1 - chance_ / variance)) : 0;
  return mapped(mean_, [&](double of_world) { return mean + narrower * (of_world - mean); });
}

std::vector<float> PooledLives::lives_around(const std::vector<double>& means) const {
  const auto count = static_cast<double>(draws_);
  const double wider = draws_ > 1 ? std::sqrt(count / (count - 1)) : 1;
  std::vector<float> hours(mean_.size() * draws_);
  for (std::size_t place = 0; place < order_.size(); ++place) {
    // Each world takes other quantiles, so that together they are those of the whole pool (a golden section sequence).
    constexpr double golden = 0.6180339887498949;
    const double first = golden * double(place) - std::floor(golden * double(place));
    const std::size_t w = order_[place];
    const std::vector<float>& all = distance_[pool_of_[w]];
    for (std::size_t d = 0; d < draws_; ++d) {
      const auto at = static_cast<std::size_t>((double(d) + first) * double(all.size()) / count);
      hours[w * draws_ + d] = static_cast<float>(std::exp(means[w] + wider * all[std::min(at, all.size() - 1)]));
    }
  }
  return hours;
}

void remove_chance(LifeTable& table) {
  const PooledLives pooled(table);
  table.mean_ln = pooled.means_without_chance();
  std::vector<float> better = pooled.lives_around(table.mean_ln);
  if (!table.of_draw.empty())
    for (std::size_t w = 0; w < table.worlds; ++w) {
      const auto order =
          smallest_first(table.draws, [&](std::size_t d) { return table.of_draw[d * table.worlds + w]; });
      for (std::size_t k = 0; k < order.size(); ++k)
        table.of_draw[order[k] * table.worlds + w] = better[w * table.draws + k];
    }
  table.hours = std::move(better);
}

}  // namespace dresslife::pipeline
