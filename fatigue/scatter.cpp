#include "fatigue/scatter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace dresslife::fatigue {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double farthest = 9;          // standard deviations: beyond lies 1e-19 of all wires
constexpr double log_accuracy = 1e-10;  // of ln life

std::vector<double> medians(std::span<const double> damage) {
  std::vector<double> lives;
  for (const double d : damage) {
    if (d > 0) lives.push_back(1 / d);
  }
  std::sort(lives.begin(), lives.end());
  return lives;
}

/// Where a probability that grows with time passes `share`.
double bisect(double low, double high, double share, const std::function<double(double)>& probability) {
  double a = std::log(low), b = std::log(high);
  while (b - a > log_accuracy) {
    const double middle = (a + b) / 2;
    (probability(std::exp(middle)) < share ? a : b) = middle;
  }
  return std::exp((a + b) / 2);
}

std::vector<double> shares_at(double time, std::span<const double> lives, double scatter) {
  std::vector<double> shares;
  for (const double life : lives) shares.push_back(broken_share(time, life, scatter));
  return shares;
}

/// The life at which a share of the draws (sorted) has failed.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * double(sorted.size()) - 0.5;
  const auto below = static_cast<std::size_t>(std::clamp(place, 0.0, double(sorted.size() - 1)));
  return sorted[std::min<std::size_t>(below + (place > double(below) ? 1 : 0), sorted.size() - 1)];
}

Percentiles quantiles(std::vector<double>& lives) {
  std::sort(lives.begin(), lives.end());
  Percentiles result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = quantile(lives, percentiles[i]);
  return result;
}

std::array<std::size_t, failures> counts_of(const Bundle& bundle, double failed_percent) {
  return {1, wires_of_share(failed_percent, bundle.damage.size()), bundle.damage.size()};
}

std::uint64_t mixed(std::uint64_t x) {  // splitmix64 (Steele, Lea and Flood 2014)
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Uniform in (0, 1).
double uniform_of(std::uint64_t bits) { return (double(bits >> 11) + 0.5) * 0x1p-53; }

/// Lives at which 1, 2, ... wires of a conductor have broken in one draw, (wire).
void draw_breaks(const Bundle& bundle, std::uint64_t first_stream, std::uint64_t draw, double scatter,
                 std::vector<double>& breaks) {
  breaks.clear();
  for (std::size_t wire = 0; wire < bundle.damage.size(); ++wire) {
    const double median = bundle.damage[wire] > 0 ? 1 / bundle.damage[wire] : infinity;
    breaks.push_back(median * std::pow(10, scatter * normal_of(first_stream + wire, draw)));
  }
  std::sort(breaks.begin(), breaks.end());
  if (bundle.rate.empty()) return;
  double before = 0, life = 0;
  for (std::size_t k = 0; k < breaks.size(); ++k) {  // (F16)
    const double next = breaks[k];
    life += (next - before) / bundle.rate[k];
    before = next;
    breaks[k] = life;
    if (next == infinity) break;
  }
}

}  // namespace

double broken_share(double time, double median_life, double scatter_log10) {
  if (scatter_log10 == 0) return time >= median_life ? 1 : 0;
  return std::erfc(-std::log10(time / median_life) / (scatter_log10 * std::numbers::sqrt2)) / 2;
}

// Event after event: with p the next one's probability, P(k) becomes P(k) (1-p) + P(k-1) p. Only the counts
// below `count` are followed; what leaves them has reached it.
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

std::size_t wires_of_share(double percent, std::size_t wires) {
  const double count = std::ceil(percent / 100 * double(wires) * (1 - 1e-12));  // 10 % of 70 are 7, not 8
  return std::clamp<std::size_t>(static_cast<std::size_t>(count), 1, std::max<std::size_t>(wires, 1));
}

double life_until(std::span<const double> damage, std::size_t count, double scatter_log10, double share) {
  assert(count >= 1);
  const std::vector<double> lives = medians(damage);
  if (lives.size() < count) return infinity;
  if (scatter_log10 == 0) return lives[count - 1];
  const double spread = std::pow(10, farthest * scatter_log10);
  return bisect(lives.front() / spread, lives[count - 1] * spread, share,
                [&](double time) { return at_least(shares_at(time, lives, scatter_log10), count); });
}

FailureLives conductor_lives(const Bundle& bundle, double failed_percent, double scatter_log10) {
  FailureLives lives{};
  const auto counts = counts_of(bundle, failed_percent);
  for (std::size_t failure = 0; failure < failures; ++failure) {
    for (std::size_t i = 0; i < percentiles.size(); ++i)
      lives[failure][i] = life_until(bundle.damage, counts[failure], scatter_log10, percentiles[i]);
  }
  return lives;
}

Percentiles first_conductor_lives(std::span<const Bundle> bundles, double failed_percent,
                                  double scatter_log10) {
  std::vector<std::vector<double>> lives;
  std::vector<std::size_t> counts;
  double low = infinity, high = infinity;
  for (const Bundle& bundle : bundles) {
    const std::size_t count = wires_of_share(failed_percent, bundle.damage.size());
    std::vector<double> own = medians(bundle.damage);
    if (own.size() < count) continue;
    low = std::min(low, own.front());
    high = std::min(high, own[count - 1]);
    lives.push_back(std::move(own));
    counts.push_back(count);
  }
  Percentiles result;
  result.fill(high);
  if (lives.empty() || scatter_log10 == 0) return result;
  const double spread = std::pow(10, farthest * scatter_log10);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = bisect(low / spread, high * spread, percentiles[i], [&](double time) {
      double all_last = 1;
      for (std::size_t k = 0; k < lives.size(); ++k)
        all_last *= 1 - at_least(shares_at(time, lives[k], scatter_log10), counts[k]);
      return 1 - all_last;
    });
  }
  return result;
}

SharedLives shared_lives(std::span<const Bundle> bundles, double failed_percent, double scatter_log10,
                         int draws) {
  SharedLives result;
  std::vector<double> first(draws, infinity), breaks;
  std::uint64_t stream = 0;
  for (const Bundle& bundle : bundles) {
    const auto counts = counts_of(bundle, failed_percent);
    std::array<std::vector<double>, failures> lives;
    for (int draw = 0; draw < draws; ++draw) {
      draw_breaks(bundle, stream, draw, scatter_log10, breaks);
      for (std::size_t failure = 0; failure < failures; ++failure)
        lives[failure].push_back(breaks[counts[failure] - 1]);
      first[draw] = std::min(first[draw], lives[1].back());
    }
    FailureLives& own = result.conductor.emplace_back();
    for (std::size_t failure = 0; failure < failures; ++failure) own[failure] = quantiles(lives[failure]);
    stream += bundle.damage.size();
  }
  result.first_conductor = quantiles(first);
  return result;
}

double normal_of(std::uint64_t stream, std::uint64_t draw) {  // Box and Muller 1958
  const std::uint64_t seed = mixed(mixed(stream) ^ (draw + 1));
  return std::sqrt(-2 * std::log(uniform_of(seed))) *
         std::cos(2 * std::numbers::pi * uniform_of(mixed(seed)));
}

}  // namespace dresslife::fatigue
