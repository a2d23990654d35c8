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
// A node keeps its sign if its slide in the wrong direction is less than this share of the length; strains change by the same
// amount. The value exceeds the rounding of a sum of some hundred elements.
constexpr double no_slide = 1e-13;
// Six rounds cost as much as the exact method. They fail if a node sticks, and then usually also at the next sample.
constexpr int most_sign_rounds = 6, sign_rounds_after_failure = 1;

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
      sign_(lengths_.size(), 1.0),
      slide_(slid_),
      length_(std::accumulate(lengths_.begin(), lengths_.end(), 0.0)),
      soft_weight_(soft_end * length_ / axial_stiffness) {
  assert(!lengths_.empty() && axial_stiffness > 0 && base_grip >= 0 && tool_grip >= 0);
}

/// Returns whether all nodes slide and no clamp does. Then force_ is the solution, else it is undefined. Precondition: tried_.
bool SlidingLine::all_slide(std::span<const double> limits) {
  const std::size_t n = lengths_.size();
  const double nothing = no_slide * length_ * stiffness_;
  const int rounds = std::exchange(all_slid_, false) ? most_sign_rounds : sign_rounds_after_failure;
  for (int round = 0; round < rounds; ++round) {
    double offset = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) offset += sign_[i] * limits[i];
      force_[i] = offset;
      sum += lengths_[i] * (stiffness_ * tried_[i] - offset);
    }
    const double first = sum / length_;
    double slide = 0;
    for (std::size_t i = 0; i < n; ++i) {
      slide_[i] = slide;
      force_[i] += first;
      slide += lengths_[i] * (force_[i] - stiffness_ * tried_[i]);
    }
    bool right = true;
    for (std::size_t i = 1; i < n; ++i)
      if (slide_[i] * sign_[i] < -nothing) {
        sign_[i] = -sign_[i];
        right = false;
      }
    if (right) return all_slid_ = true;
  }
  return false;
}

/// Lets the force after this node differ by up to `limit` from the force before it.
void SlidingLine::widen(double limit) {
  below_shift_ -= limit;
  above_shift_ += limit;
  below_.push_back({lowest_at_ - limit - below_shift_, -slope_});
  above_.push_back({lowest_at_ + limit - above_shift_, slope_});
  slope_ = at_zero_ = 0;
}

/// Adds weight (T - target)^2 / 2 to the sum, and finds its minimum.
void SlidingLine::add(double weight, double target) {
  slope_ += weight;
  at_zero_ -= weight * target;
  const auto cross = [&](std::vector<Knot>& from, double from_shift, std::vector<Knot>& to, double to_shift,
                         double sign) {
    const Knot knot = from.back();
    const double at = knot.at + from_shift, value = slope_ * at + at_zero_;
    from.pop_back();
    to.push_back({at - to_shift, knot.bend});
    slope_ += sign * knot.bend;
    at_zero_ = value - slope_ * at;
  };
  const auto find_lowest = [&] { return lowest_at_ = -at_zero_ / slope_; };
  const auto is_below = [&] { return !below_.empty() && find_lowest() < below_.back().at + below_shift_; };
  const auto is_above = [&] { return !above_.empty() && find_lowest() > above_.back().at + above_shift_; };
  // An added line moves the minimum to one side. Rounding can put it on the other side of a knot that was just crossed. A step
  // back would repeat without end.
  if (is_below()) do
      cross(below_, below_shift_, above_, above_shift_, -1);
    while (is_below());
  else
    while (is_above()) cross(above_, above_shift_, below_, below_shift_, 1);
  find_lowest();
}

void SlidingLine::attempt(std::span<const double> unslid, std::span<const double> limits) {
  const std::size_t n = lengths_.size();
  assert(unslid.size() == n && limits.size() == n);
  for (std::size_t i = 0; i < n; ++i) tried_[i] = unslid[i] + slid_[i];
  if (base_grip_ == without_limit && tool_grip_ == without_limit && all_slide(limits)) return;
  below_.clear();
  above_.clear();
  below_shift_ = above_shift_ = slope_ = at_zero_ = 0;
  const double weightless = 1 / stiffness_;
  if (base_grip_ < without_limit) {
    add(soft_weight_, 0);
    widen(base_grip_);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) widen(limits[i]);
    add(lengths_[i] * weightless, stiffness_ * tried_[i]);
    least_[i] = lowest_at_;
  }
  force_[n - 1] = least_[n - 1];
  if (tool_grip_ < without_limit) {
    widen(tool_grip_);
    add(soft_weight_, 0);
    force_[n - 1] = std::clamp(least_[n - 1], lowest_at_ - tool_grip_, lowest_at_ + tool_grip_);
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
