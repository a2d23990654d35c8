#include "strain/sliding_line.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace dresslife::strain {
namespace {

// Beyond a clamp that can slip, an element represents the free end. It is so much softer than the part that only a millionth of
// the force remains in it.
constexpr double soft_end = 1e6;
constexpr double at_limit =
    1 - 1e-5;  // share of a grip at which it counts as reached, because of the soft end and rounding

}  // namespace

SlidingLine::SlidingLine(std::vector<double> lengths, double axial_stiffness, double base_grip, double tool_grip)
    : lengths_(std::move(lengths)),
      stiffness_(axial_stiffness),
      base_grip_(base_grip),
      tool_grip_(tool_grip),
      slid_(lengths_.size(), 0.0),
      force_(slid_),
      tried_(slid_),
      least_(slid_),
      below_(2 * lengths_.size() + 2),
      above_(below_),
      length_(std::accumulate(lengths_.begin(), lengths_.end(), 0.0)),
      soft_weight_(soft_end * length_ / axial_stiffness) {
  assert(!lengths_.empty() && axial_stiffness > 0 && base_grip >= 0 && tool_grip >= 0);
}

void SlidingLine::attempt(std::span<const double> unslid, std::span<const double> limits) {
  const std::size_t n = lengths_.size();
  assert(unslid.size() == n && limits.size() == n);
  for (std::size_t i = 0; i < n; ++i) tried_[i] = unslid[i] + slid_[i];
  // The slope of the least sum: slope T + at_zero between the nearest knots; those farther from the minimum lie below them. Each
  // side has a shift. Local variables, because registers make this loop twice as fast.
  Knot *below = below_.data(), *above = above_.data();  // behind the last knot
  double below_shift = 0, above_shift = 0, slope = 0, at_zero = 0, lowest_at = 0;
  // Lets the force after this node differ by up to `limit` from the force before it.
  const auto widen = [&](double limit) {
    below_shift -= limit;
    above_shift += limit;
    *below++ = {lowest_at - limit - below_shift, -slope};
    *above++ = {lowest_at + limit - above_shift, slope};
    slope = at_zero = 0;
  };
  // Moves the knot nearest to the minimum to the other side if the minimum lies there: below it, the slope is positive at it.
  const auto cross = [&](Knot*& from, const Knot* first, double from_shift, Knot*& to, double to_shift, double sign) {
    if (from == first) return false;
    const Knot knot = from[-1];
    const double at = knot.at + from_shift, value = slope * at + at_zero;
    if (sign * value <= 0) return false;
    --from;
    *to++ = {at - to_shift, knot.bend};
    slope -= sign * knot.bend;
    at_zero = value - slope * at;
    return true;
  };
  const auto down = [&] { return cross(below, below_.data(), below_shift, above, above_shift, 1); };
  const auto up = [&] { return cross(above, above_.data(), above_shift, below, below_shift, -1); };
  // Adds weight (T - target)^2 / 2 to the sum, and finds its minimum.
  const auto add = [&](double weight, double target) {
    slope += weight;
    at_zero -= weight * target;
    // An added line moves the minimum to one side. Rounding can put it on the other side of a knot that was just crossed. A step
    // back would repeat without end.
    if (down())
      while (down()) {
      }
    else
      while (up()) {
      }
    lowest_at = -at_zero / slope;
  };
  const double weightless = 1 / stiffness_;
  if (base_grip_ < without_limit) {
    add(soft_weight_, 0);
    widen(base_grip_);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) widen(limits[i]);
    add(lengths_[i] * weightless, stiffness_ * tried_[i]);
    least_[i] = lowest_at;
  }
  force_[n - 1] = least_[n - 1];
  if (tool_grip_ < without_limit) {
    widen(tool_grip_);
    add(soft_weight_, 0);
    force_[n - 1] = std::clamp(least_[n - 1], lowest_at - tool_grip_, lowest_at + tool_grip_);
  }
  for (std::size_t i = n - 1; i-- > 0;)
    force_[i] = std::clamp(least_[i], force_[i + 1] - limits[i + 1], force_[i + 1] + limits[i + 1]);
}

void SlidingLine::keep() {
  const std::size_t n = lengths_.size();
  double gained = 0;  // increase of the length of part between the clamps
  for (std::size_t i = 0; i < n; ++i) {
    slid_[i] += strain(i) - tried_[i];
    gained += lengths_[i] * (tried_[i] - strain(i));
  }
  const bool base = std::abs(force_[0]) > at_limit * base_grip_;
  const bool tool = std::abs(force_[n - 1]) > at_limit * tool_grip_;
  if (!base && !tool) return;
  const double share = base && tool ? 0.5 : 1;  // if both slip, the shares of the clamps are unknown
  for (const auto& [slips, side] : {std::pair(base, 0), std::pair(tool, 1)})
    if (slips) {
      let_in_[side] += share * gained;
      travel_[side] += share * std::abs(gained);
    }
}

}  // namespace dresslife::strain
