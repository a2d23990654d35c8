#include "strain/loose/tension.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace dresslife::strain {

CableTension::CableTension(const LooseCable& cable, double length, std::size_t elements, double laid_in)
    : stiffness_(cable.axial_stiffness),
      free_length_rate_((1 + cable.slack) * (1 + laid_in)),
      grip_(cable.grip) {
  assert(length > 0 && elements > 0 && free_length_rate_ > 0);
}

void CableTension::answer(std::span<const double> gain, std::span<const double> press, Pull& pull) const {
  assert(press.size() == gain.size() + 1);
  const double mean_gain = std::accumulate(gain.begin(), gain.end(), 0.0) / static_cast<double>(gain.size());
  const double tried = stiffness_ * ((1 + mean_gain) / free_length_rate_ - 1 - slipped_);
  pull.mean = std::clamp(tried, -grip_, grip_);
  pull.stiffness = pull.mean == tried ? stiffness_ / free_length_rate_ : 0;
  pull.strain = stiffness_ > 0 ? pull.mean / stiffness_ : 0;
  pull.tension.assign(gain.size(), pull.mean);
}

void CableTension::settle(std::span<const double> gain, std::span<const double> press, Pull& pull) {
  answer(gain, press, pull);
  if (pull.stiffness > 0) return;
  const double mean_gain = std::accumulate(gain.begin(), gain.end(), 0.0) / static_cast<double>(gain.size());
  slipped_ = (1 + mean_gain) / free_length_rate_ - 1 - pull.strain;
}

}  // namespace dresslife::strain
