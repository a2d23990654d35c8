#include "strain/loose/tension.h"

#include <algorithm>
#include <cassert>

namespace dresslife::strain {

CableTension::CableTension(const LooseCable& cable, double laid_in)
    : slack_(cable.slack), laid_in_(laid_in), free_length_rate_((1 + cable.slack) * (1 + laid_in)) {
  assert(free_length_rate_ > 0 && cable.grip >= 0);
  if (cable.grip == 0)
    most_ = 0;
  else if (cable.grip < cable.axial_stiffness)  // a larger grip would exceed the strength
    most_ = cable.grip / cable.axial_stiffness;
}

void CableTension::feed_in(double share) {
  fed_in_ = share;
  shorten(shortened_);
  slipped_ = 0;
  held_ = share < 1;
}

void CableTension::shorten(double share) {
  shortened_ = share;
  free_length_rate_ = (1 + fed_in_ * slack_) * (1 + laid_in_) * (1 - share);
}

double CableTension::settle(double mean_gain) {
  const double stretch = (1 + mean_gain) / free_length_rate_ - 1, most = most_strain();
  const double strain = std::clamp(stretch - slipped_, -most, most);
  slipped_ = stretch - strain;
  return strain;
}

}  // namespace dresslife::strain
