#include "fatigue/rated_cables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fatigue/rainflow.h"

namespace dresslife::fatigue {
namespace {

using pipeline::Rating;
using pipeline::RigKind;

constexpr std::size_t directions = 12;  // error of a range: 1 - cos(7.5 deg), of a damage: 4 % at m = 5

using Damage =
    std::array<double, 3>;  // with the damage exponent one deviation below its median, at its median, one above
using Exponents = std::array<double, 3>;

bool is_twisted(const Rating& rating) { return rating.rig.kind == RigKind::torsion; }

std::vector<double> rig_cycle(const Rating& rating, double diameter) {
  pipeline::Rig rig = rating.rig;
  check_rig(rig);
  if (rig.kind == RigKind::torsion) return {*rig.twist, -*rig.twist};
  const double bent = 1 / axis_radius(rig, diameter);
  if (rig.kind == RigKind::tick_tock) return {0, bent, 0, -bent};
  const pipeline::BendWay way = bend_way(rig, diameter);
  const bool passes = way.sweep >= way.bend;
  if (rig.kind == RigKind::rolling_flex)
    return passes ? std::vector<double>{0, bent, 0, bent} : std::vector<double>{0, bent};
  return passes ? std::vector<double>{0, -bent, bent, 0, bent, -bent} : std::vector<double>{-bent, bent};
}

/// Sums of range^m, and the sample of the larger extreme of the largest range.
struct Sum {
  Damage sum{};
  double largest = 0;
  std::size_t sample = 0;
};

/// Returns the sums of a history. Ranges are divided by `unit`.
Sum sum_of(std::span<const double> history, const Exponents& exponents, double unit) {
  Sum result;
  const std::vector<Reversal> reversals = find_reversals(history);
  if (reversals.size() < 2) return result;
  for (const Cycle& cycle : count_repeating(reversals)) {
    const double range = cycle.range() / unit;
    for (std::size_t i = 0; i < exponents.size(); ++i) result.sum[i] += cycle.count * std::pow(range, exponents[i]);
    if (range <= result.largest) continue;
    result.largest = range;
    const bool begins = std::abs(cycle.begin.strain) > std::abs(cycle.end.strain);
    result.sample = static_cast<std::size_t>((begins ? cycle.begin : cycle.end).sample);
  }
  return result;
}

/// Returns the sums of bending in the worst direction.
Sum bends_of(const SegmentMotion& segment, const Exponents& exponents, double unit) {
  Sum worst;
  std::vector<double> history(segment.curvature1.size());
  for (std::size_t k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / directions;
    for (std::size_t t = 0; t < history.size(); ++t)
      history[t] = std::cos(angle) * segment.curvature1[t] + std::sin(angle) * segment.curvature2[t];
    const Sum sum = sum_of(history, exponents, unit);
    if (sum.sum[1] > worst.sum[1]) worst = sum;
  }
  return worst;
}

/// The cycles of all ratings of one kind; the rating that allows the largest sum counts.
class Promise {
 public:
  Promise(const pipeline::Component& cable, const Exponents& exponents, bool twisted) {
    for (const Rating& rating : cable.ratings)
      if (is_twisted(rating) == twisted) {
        const std::vector<double> cycle = rig_cycle(rating, 2 * cable.radius);
        const double largest = *std::ranges::max_element(cycle);
        if (unit_ == 0) unit_ = largest;
        const Sum each = sum_of(cycle, exponents, unit_);
        largest_ = std::max(largest_, each.largest);
        for (std::size_t i = 0; i < all_.size(); ++i) all_[i] = std::max(all_[i], each.sum[i] * rating.cycles);
      }
  }
  bool given() const { return unit_ > 0; }
  double unit() const { return unit_; }
  double times(const Sum& motion) const { return motion.largest / largest_; }
  Damage damage(const Sum& motion) const {
    Damage damage{};
    for (std::size_t i = 0; i < damage.size(); ++i) damage[i] = motion.sum[i] / all_[i];
    return damage;
  }

 private:
  double unit_ = 0;     // range of the first rating; keeps the powers in the range of floating-point numbers
  double largest_ = 0;  // range of all ratings, in units
  Damage all_{};        // allowed sum of range^m
};

}  // namespace

RatedLife rated_life(const pipeline::Component& cable, std::span<const SegmentMotion> segments) {
  const double median = cable.plain->damage_exponent.value_or(pipeline::usual_damage_exponent);
  const Exponents exponents{std::max(1.0, median - pipeline::damage_exponent_deviation), median,
                            median + pipeline::damage_exponent_deviation};
  const Promise bending(cable, exponents, false), torsion(cable, exponents, true);
  RatedLife life;
  life.bends = bending.given(), life.twists = torsion.given();
  Damage worst{};
  for (std::size_t k = 0; k < segments.size(); ++k) {
    Damage all{}, by_twist{};
    Sum bends, twists;
    if (life.bends) bends = bends_of(segments[k], exponents, bending.unit()), all = bending.damage(bends);
    if (life.twists) twists = sum_of(segments[k].twist, exponents, torsion.unit()), by_twist = torsion.damage(twists);
    if (life.bends) life.bend_times = std::max(life.bend_times, bending.times(bends));
    if (life.twists) life.twist_times = std::max(life.twist_times, torsion.times(twists));
    const bool twist_leads = by_twist[1] > all[1];
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i] += by_twist[i];
      if (i != 1) worst[i] = std::max(worst[i], all[i]);
    }
    if (!(all[1] > worst[1])) continue;
    worst[1] = all[1];
    life.segment = k;
    life.sample = twist_leads ? twists.sample : bends.sample;
    life.twist_share = by_twist[1] / all[1];
  }
  life.repeats = worst[1] > 0 ? 1 / worst[1] : std::numeric_limits<double>::infinity();
  if (worst[0] > 0 && worst[2] > 0) life.log10_spread = std::abs(std::log10(worst[2] / worst[0])) / 2;
  return life;
}

}  // namespace dresslife::fatigue
