#include "fatigue/places.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "fatigue/life_distribution.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/halving.h"
#include "pipeline/life/planning.h"

namespace dresslife::fatigue {
namespace {

constexpr double certain = 1e-6;  // distance from a probability of 1

/// A conductor in one segment.
struct Place {
  std::size_t conductor, segment;
  double log_life;  // of the wire whose break is the failure, if all lives are medians
};

/// Returns all places that can fail, shortest life first.
std::vector<Place> places_of(std::span<const PlacesOfConductor> places, std::span<const ConductorWires> bundles,
                             std::size_t segments, double failed_percent) {
  std::vector<Place> all;
  std::vector<double> damage;
  for (std::size_t conductor = 0; conductor < places.size(); ++conductor) {
    const std::size_t wires = bundles[conductor].damage.size(), count = pipeline::wires_of_share(failed_percent, wires);
    assert(places[conductor].damage.size() == wires * segments);
    for (std::size_t segment = 0; wires > 0 && segment < segments; ++segment) {
      const auto first = places[conductor].damage.begin() + static_cast<std::ptrdiff_t>(segment * wires);
      damage.assign(first, first + static_cast<std::ptrdiff_t>(wires));
      std::nth_element(damage.begin(), damage.begin() + static_cast<std::ptrdiff_t>(count - 1), damage.end(),
                       std::greater<>());
      if (damage[count - 1] > 0) all.push_back({conductor, segment, -std::log(damage[count - 1])});
    }
  }
  std::ranges::stable_sort(all, {}, &Place::log_life);
  return all;
}

/// A place whose failure can influence the result.
struct JudgedPlace {
  Wires wires;
  std::size_t conductor, segment, count;
  double log_life;
};

std::span<const double> damage_at(const PlacesOfConductor& places, std::size_t segment, std::size_t wires) {
  return std::span(places.damage).subspan(segment * wires, wires);
}

/// Failure of the first of a dresspack's places.
class Places {
 public:
  /// all: of this dresspack, shortest life first, not empty. haste: ln of the largest factor by which load sharing can shorten a
  /// life.
  Places(std::span<const PlacesOfConductor> places, std::span<const ConductorWires> bundles,
         const std::vector<Place>& all, double failed_percent, double own, double haste)
      : own_(own) {
    const auto judged = [&](const Place& place) {
      const std::size_t wires = bundles[place.conductor].damage.size();
      return JudgedPlace{Wires(damage_at(places[place.conductor], place.segment, wires)), place.conductor,
                         place.segment, pipeline::wires_of_share(failed_percent, wires), place.log_life};
    };
    least_ = neglected / double(all.size());
    constexpr std::size_t soonest = 64;  // enough places to find the time by which the first has certainly failed
    for (std::size_t i = 0; i < std::min(soonest, all.size()); ++i) judged_.push_back(judged(all[i]));
    take_conductors(bundles);
    latest_ = latest_of_judged(all.front().log_life);
    judged_.clear();
    std::vector<double> memory;
    for (const Place& place : all) {
      // k broken wires include one of the n - k + 1 longest-lived ones, each at most as likely to break as the k-th.
      const double wires = double(bundles[place.conductor].damage.size());
      if (own_ > 0 ? wires * tabulated_normal((latest_ + haste - place.log_life) / own_) < least_
                   : place.log_life > latest_ + haste)
        continue;
      JudgedPlace candidate = judged(place);
      if (own_ > 0 && candidate.wires.failed(latest_ + haste, candidate.count, own_, memory) < least_) continue;
      judged_.push_back(std::move(candidate));
    }
    take_conductors(bundles);
  }

  /// Returns (F26) for a given common factor. Precondition: own > 0.
  double failed(double log_time, std::vector<double>& memory) const {
    double none = 1;
    auto place = judged_.begin();
    for (const JudgedPlace& conductor : anywhere_) {
      double none_of_it = 1;
      for (; place != judged_.end() && place->conductor == conductor.conductor; ++place) {
        const double most = double(place->wires.damaged()) * tabulated_normal((log_time - place->log_life) / own_);
        if (most > least_) none_of_it *= 1 - place->wires.failed(log_time, place->count, own_, memory);
      }
      if (none_of_it < 1)
        none_of_it = std::max(none_of_it, 1 - conductor.wires.failed(log_time, conductor.count, own_, memory));
      none *= none_of_it;
      if (none < certain * certain) return 1;
    }
    return 1 - none;
  }

  /// Returns the start of the time range: -9 deviations of the first wire. latest(): the first place has certainly failed.
  double earliest() const {
    double first = infinity;
    for (const JudgedPlace& place : judged_) first = std::min(first, place.wires.log_life(0));
    return first - LifeDistribution::farthest * own_;
  }
  double latest() const { return latest_; }
  const std::vector<JudgedPlace>& judged() const { return judged_; }

 private:
  /// Sorts the evaluated places by conductor, and creates each conductor's wires with their worst places.
  void take_conductors(std::span<const ConductorWires> bundles) {
    std::ranges::stable_sort(judged_, {}, &JudgedPlace::conductor);
    anywhere_.clear();
    for (const JudgedPlace& place : judged_)
      if (anywhere_.empty() || anywhere_.back().conductor != place.conductor)
        anywhere_.push_back({Wires(bundles[place.conductor].damage), place.conductor, 0, place.count, 0});
  }

  /// Returns the time by which the first of the evaluated places has certainly failed; more places can only make it earlier.
  double latest_of_judged(double soonest) const {
    const double reach = LifeDistribution::farthest * own_;
    std::vector<double> memory;
    return pipeline::halved(soonest - reach, soonest + reach, own_ > 0 ? 16 : 0,
                            [&](double log_life) { return failed(log_life, memory) < 1 - certain; })
        .high;
  }

  double own_, latest_ = 0, least_ = 0;
  std::vector<JudgedPlace> judged_;    // sorted by conductor
  std::vector<JudgedPlace> anywhere_;  // (conductor) its wires with their worst places
};

}  // namespace

std::vector<double> median_place_lives(std::span<const PlacesOfConductor> places,
                                       std::span<const ConductorWires> bundles, std::size_t segments,
                                       double failed_percent) {
  std::vector<double> lives(places.size(), infinity);
  for (const Place& place : places_of(places, bundles, segments, failed_percent))
    lives[place.conductor] = std::min(lives[place.conductor], std::exp(place.log_life));
  return lives;
}

FirstPlace first_place_lives(std::span<const PlacesOfConductor> places, std::span<const ConductorWires> bundles,
                             std::size_t segments, double failed_percent, Scatter scatter, int draws) {
  assert(places.size() == bundles.size());
  FirstPlace result;
  result.lives.fill(infinity);
  const std::vector<Place> all = places_of(places, bundles, segments, failed_percent);
  if (all.empty()) return result;
  std::vector<bool> seen(places.size());
  for (const Place& place : all)
    if (!seen[place.conductor])
      seen[place.conductor] = true, result.soonest.push_back({place.conductor, place.segment});
  std::map<std::size_t, std::vector<Place>> of_dresspack;
  for (const Place& place : all) of_dresspack[bundles[place.conductor].dresspack].push_back(place);

  const bool sharing = std::ranges::any_of(bundles, [](const ConductorWires& b) { return !b.rate.empty(); });
  double haste = 0;
  for (const ConductorWires& bundle : bundles)
    for (std::size_t k = 0;
         k < bundle.rate.size() && k < pipeline::wires_of_share(failed_percent, bundle.damage.size()); ++k)
      haste = std::max(haste, std::log(bundle.rate[k]));
  const double own = scatter.own() * std::numbers::ln10;
  if (scatter.log10 == 0 && !sharing) {
    result.lives.fill(std::exp(all.front().log_life));
    return result;
  }
  std::vector<Places> dresspacks;
  for (const auto& [dresspack, its] : of_dresspack) {
    dresspacks.emplace_back(places, bundles, its, failed_percent, own, haste);
    result.judged += dresspacks.back().judged().size();
  }
  if (sharing) {
    std::vector<PlaceOfConductor> judged;
    for (const Places& dresspack : dresspacks)
      for (const JudgedPlace& place : dresspack.judged()) judged.push_back({place.conductor, place.segment});
    result.lives = shared_place_lives(bundles, judged, failed_percent, scatter, draws,
                                      [&](std::size_t conductor, std::size_t segment) {
                                        return damage_at(places[conductor], segment, bundles[conductor].damage.size());
                                      });
    return result;
  }
  std::vector<LifeDistribution> each;
  for (const Places& dresspack : dresspacks)
    each.emplace_back(
        [&dresspack, memory = std::vector<double>()](double log_time) mutable {
          return dresspack.failed(log_time, memory);
        },
        own > 0 ? dresspack.earliest() : dresspack.latest(), dresspack.latest(), scatter.common() * std::numbers::ln10);
  result.lives = first_of(each);
  return result;
}

}  // namespace dresslife::fatigue
