#include "strain/loose/tension.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace dresslife::strain {

CableTension::CableTension(const LooseCable& cable, double laid_in)
    : axial_stiffness_(cable.axial_stiffness),
      slack_(cable.slack),
      laid_in_(laid_in),
      free_length_rate_((1 + cable.slack) * (1 + laid_in)),
      most_(cable.grip == without_limit ? without_limit : cable.grip / cable.axial_stiffness) {
  assert(free_length_rate_ > 0 && cable.grip >= 0);
}

void CableTension::feed_in(double share) {
  free_length_rate_ = (1 + share * slack_) * (1 + laid_in_);
  slipped_ = 0;
  held_ = share < 1;
}

double CableTension::stretch(std::span<const double> gain) const {
  const double mean = std::accumulate(gain.begin(), gain.end(), 0.0) / static_cast<double>(gain.size());
  return (1 + mean) / free_length_rate_ - 1;
}

void CableTension::answer(std::span<const double> gain, Pull& pull) const {
  const double tried = stretch(gain) - slipped_;
  pull.strain = held_ ? tried : std::clamp(tried, -most_, most_);
  pull.mean = axial_stiffness_ * pull.strain;
  pull.stiffness = pull.strain == tried ? axial_stiffness_ / free_length_rate_ : 0;
  pull.tension.assign(gain.size(), pull.mean);
}

void CableTension::settle(std::span<const double> gain, Pull& pull) {
  answer(gain, pull);
  slipped_ = stretch(gain) - pull.strain;
}

}  // namespace dresslife::strain
