#include "fatigue/scatter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "fatigue/life_distribution.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/random.h"
#include "pipeline/life/planning.h"

namespace dresslife::fatigue {
namespace {

/// Returns the life at which a share of the samples (sorted) has failed.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * double(sorted.size()) - 0.5;
  const auto below = static_cast<std::size_t>(std::clamp(place, 0.0, double(sorted.size() - 1)));
  return sorted[std::min<std::size_t>(below + (place > double(below) ? 1 : 0), sorted.size() - 1)];
}

Percentiles quantiles(std::vector<double>& lives) {
  std::ranges::sort(lives);
  Percentiles result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = quantile(lives, percentiles[i]);
  return result;
}

std::array<std::size_t, failures> counts_of(const ConductorWires& bundle, double failed_percent) {
  return {1, pipeline::wires_of_share(failed_percent, bundle.damage.size()), bundle.damage.size()};
}

/// Returns log10 of the common factor of a dresspack's wires in a sample. Its stream counts down from the largest number, those
/// of the wires count up from 0.
double common_of(std::size_t dresspack, std::uint64_t draw, Scatter scatter) {
  return scatter.common() > 0 ? scatter.common() * normal_of(~std::uint64_t{dresspack}, draw) : 0;
}

/// Computes the factors of the lives of a conductor's wires in one sample, (wire).
void draw_factors(const ConductorWires& bundle, std::uint64_t first_stream, std::uint64_t draw, Scatter scatter,
                  std::vector<double>& factors) {
  factors.clear();
  const double common = common_of(bundle.dresspack, draw, scatter);
  for (std::size_t wire = 0; wire < bundle.damage.size(); ++wire)
    factors.push_back(std::pow(10, common + scatter.own() * normal_of(first_stream + wire, draw)));
}

/// Computes the lives at which 1, 2, ... `count` of wires with this damage have broken. rate: see ConductorWires.
void order_breaks(std::span<const double> damage, std::span<const double> factors, std::span<const double> rate,
                  std::size_t count, std::vector<double>& breaks) {
  breaks.clear();
  for (std::size_t wire = 0; wire < damage.size(); ++wire)
    breaks.push_back(damage[wire] > 0 ? factors[wire] / damage[wire] : infinity);
  const auto last = breaks.begin() + static_cast<std::ptrdiff_t>(count);
  if (count < breaks.size()) std::nth_element(breaks.begin(), last - 1, breaks.end());
  std::sort(breaks.begin(), last);
  breaks.resize(count);
  if (rate.empty()) return;
  double before = 0, life = 0;
  for (std::size_t k = 0; k < breaks.size(); ++k) {  // (F16)
    const double next = breaks[k];
    life += (next - before) / rate[k];
    before = next;
    breaks[k] = life;
    if (next == infinity) break;
  }
}

}  // namespace

Percentiles first_wire_lives(std::span<const std::vector<double>> damage, Scatter scatter) {
  std::vector<LifeDistribution> each;
  double shortest = infinity;
  for (const std::vector<double>& of_dresspack : damage) {
    const auto wires = std::make_shared<const Wires>(of_dresspack);
    if (wires->damaged() == 0) continue;
    shortest = std::min(shortest, wires->life(0));
    each.push_back(distribution_of(wires, 1, scatter));
  }
  Percentiles result;
  result.fill(shortest);
  return scatter.log10 == 0 ? result : first_of(each);
}

FailureLives conductor_lives(const ConductorWires& bundle, double failed_percent, Scatter scatter) {
  FailureLives lives{};
  const auto counts = counts_of(bundle, failed_percent);
  const auto wires = std::make_shared<const Wires>(bundle.damage);
  for (std::size_t failure = 0; failure < failures; ++failure) {
    lives[failure].fill(infinity);
    if (wires->damaged() < counts[failure]) continue;
    lives[failure].fill(wires->life(counts[failure] - 1));
    if (scatter.log10 > 0) lives[failure] = first_of({distribution_of(wires, counts[failure], scatter)});
  }
  return lives;
}

Percentiles first_conductor_lives(std::span<const ConductorWires> bundles, double failed_percent, Scatter scatter) {
  struct Conductor {
    Wires wires;
    std::size_t count;
  };
  std::map<std::size_t, std::vector<Conductor>> dresspacks;
  double shortest = infinity;
  for (const ConductorWires& bundle : bundles) {
    Conductor conductor{Wires(bundle.damage), pipeline::wires_of_share(failed_percent, bundle.damage.size())};
    if (conductor.wires.damaged() < conductor.count) continue;
    shortest = std::min(shortest, conductor.wires.life(conductor.count - 1));
    dresspacks[bundle.dresspack].push_back(std::move(conductor));
  }
  Percentiles result;
  result.fill(shortest);
  if (scatter.log10 == 0) return result;
  const double own = scatter.own() * std::numbers::ln10;
  std::vector<LifeDistribution> each;
  for (const auto& in_dresspack : dresspacks) {
    const std::vector<Conductor>& conductors = in_dresspack.second;
    double low = infinity, high = infinity;
    for (const Conductor& conductor : conductors) {
      low = std::min(low, conductor.wires.log_life(own > 0 ? 0 : conductor.count - 1));
      high = std::min(high, conductor.wires.log_life(conductor.count - 1));
    }
    each.emplace_back(
        [&conductors, own, memory = std::vector<double>()](double log_time) mutable {
          double all_last = 1;
          for (const Conductor& conductor : conductors)
            all_last *= 1 - conductor.wires.failed(log_time, conductor.count, own, memory);
          return 1 - all_last;
        },
        low - LifeDistribution::farthest * own, high + LifeDistribution::farthest * own,
        scatter.common() * std::numbers::ln10);
  }
  return first_of(each);
}

SharedLives shared_lives(std::span<const ConductorWires> bundles, double failed_percent, Scatter scatter, int draws) {
  SharedLives result;
  std::vector<double> first(draws, infinity), factors, breaks;
  std::uint64_t stream = 0;
  for (const ConductorWires& bundle : bundles) {
    const auto counts = counts_of(bundle, failed_percent);
    std::array<std::vector<double>, failures> lives;
    for (int draw = 0; draw < draws; ++draw) {
      draw_factors(bundle, stream, draw, scatter, factors);
      order_breaks(bundle.damage, factors, bundle.rate, bundle.damage.size(), breaks);
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

Percentiles shared_place_lives(std::span<const ConductorWires> bundles, std::span<const PlaceOfConductor> places,
                               double failed_percent, Scatter scatter, int draws, const DamageAt& damage_at) {
  std::vector<std::uint64_t> stream;  // (conductor) first stream, as in shared_lives()
  std::uint64_t next = 0;
  for (const ConductorWires& bundle : bundles) {
    stream.push_back(next);
    next += bundle.damage.size();
  }
  std::vector<double> first, factors, breaks;
  for (int draw = 0; draw < draws; ++draw) {
    double soonest = infinity;
    std::size_t drawn = bundles.size();
    for (const auto& [conductor, segment] : places) {
      const ConductorWires& bundle = bundles[conductor];
      if (drawn != conductor) draw_factors(bundle, stream[conductor], draw, scatter, factors);
      drawn = conductor;
      order_breaks(damage_at(conductor, segment), factors, bundle.rate,
                   pipeline::wires_of_share(failed_percent, bundle.damage.size()), breaks);
      soonest = std::min(soonest, breaks.back());
    }
    first.push_back(soonest);
  }
  return quantiles(first);
}

double normal_of(std::uint64_t stream, std::uint64_t draw) {
  const std::uint64_t seed = pipeline::mixed(pipeline::mixed(stream) ^ (draw + 1));
  return pipeline::normal_of(pipeline::uniform_of(seed), pipeline::uniform_of(pipeline::mixed(seed)));
}

}  // namespace dresslife::fatigue
