#include "pipeline/study/run_share.h"

namespace dresslife::pipeline {
namespace {

/// Shares of the stages in the processor time of spot_robot_1 [%]: 8.4, 86 and 1.2 s with uncertainty. A kind of stage counts with
/// its share until the first one of this kind has ended.
constexpr std::array<double, stage_count> usual{9, 90, 1};

}  // namespace

double RunShare::ended(std::size_t stage, double seconds) {
  seconds_[stage] += seconds - last_;
  last_ = seconds;
  ++ended_[stage];
  if (left_[stage] > 0) --left_[stage];
  double usual_of_ended = 0;
  for (std::size_t k = 0; k < stage_count; ++k) usual_of_ended += usual[k] * static_cast<double>(ended_[k]);
  double left = 0;
  for (std::size_t k = 0; k < stage_count; ++k)
    left += static_cast<double>(left_[k]) *
            (ended_[k] > 0 ? seconds_[k] / static_cast<double>(ended_[k]) : usual[k] * seconds / usual_of_ended);
  return seconds > 0 ? seconds / (seconds + left) : 0;
}

}  // namespace dresslife::pipeline
