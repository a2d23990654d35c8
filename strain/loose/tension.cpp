#include "strain/loose/tension.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace dresslife::strain {
namespace {

constexpr double small_strain = 1e-6;  // over which a slope is taken: far below where a metal yields
constexpr double large_strain = 1.0;   // beyond, no force is looked for

}  // namespace

CableTension::CableTension(const LooseCable& cable, double laid_in)
    : axial_stiffness_(cable.axial_stiffness),
      slack_(cable.slack),
      laid_in_(laid_in),
      free_length_rate_((1 + cable.slack) * (1 + laid_in)),
      grip_(cable.grip),
      force_(cable.force) {
  assert(free_length_rate_ > 0 && grip_ >= 0);
  if (grip_ == without_limit) return;
  most_ = strain_of(grip_);
  least_ = strain_of(-grip_);
}

void CableTension::feed_in(double share) {
  free_length_rate_ = (1 + share * slack_) * (1 + laid_in_);
  slipped_ = 0;
  held_ = share < 1;
}

double CableTension::force(double strain) const {
  return force_ ? force_(strain) : axial_stiffness_ * strain;
}

/// Bisection: the law rises. Infinite where no strain within reason needs that force.
double CableTension::strain_of(double wanted) const {
  if (wanted == 0) return 0;
  double low = -large_strain, high = large_strain;
  if (force(low) > wanted || force(high) < wanted) return std::copysign(without_limit, wanted);
  while (high - low > small_strain * small_strain) {
    const double middle = (low + high) / 2;
    (force(middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

double CableTension::stretch(std::span<const double> gain) const {
  const double mean = std::accumulate(gain.begin(), gain.end(), 0.0) / static_cast<double>(gain.size());
  return (1 + mean) / free_length_rate_ - 1;
}

void CableTension::answer(std::span<const double> gain, Pull& pull) const {
  const double tried = stretch(gain) - slipped_;
  pull.strain = held_ ? tried : std::clamp(tried, least_, most_);
  pull.mean = force(pull.strain);
  if (pull.strain != tried)
    pull.stiffness = 0;
  else if (!force_)
    pull.stiffness = axial_stiffness_ / free_length_rate_;
  else
    pull.stiffness = (force_(tried + small_strain) - force_(tried - small_strain)) / (2 * small_strain) /
                     free_length_rate_;
  pull.tension.assign(gain.size(), pull.mean);
}

void CableTension::settle(std::span<const double> gain, Pull& pull) {
  answer(gain, pull);
  slipped_ = stretch(gain) - pull.strain;
}

}  // namespace dresslife::strain
