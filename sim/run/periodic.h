// Test whether a repeated motion has become periodic: the dresspack begins two successive repeats in the same
// state.
//
// (R8) A hose that rests by friction, or sways, may begin the second repeat in another state than the first. The
// program is repeated without a pause until two successive repeats begin in the same state; the last one is
// evaluated. The distance of two states is the largest value over the segments of
//     |x - x'| + (d/2) |log(q^-1 q')| + tau |v - v'|:
// the displacement of a point of the hose's surface, plus its further displacement by a sway of period 2 pi tau.
// tau = 0.1 s: slower sways differ less in speed than in position. The travel of a retraction unit is compared
// in the same way.
#pragma once

#include <optional>
#include <vector>

#include "sim/robot/loops.h"
#include "sim/rod/rod.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {

/// Returns the largest distance (R8) over the segments and retraction units [m]. Precondition: both states belong to this
/// rod.
double state_distance(const Rod& rod, const RodState& a, const RodState& b);

/// Leaves out the remaining rounds of a loop when two successive rounds begin in the same state (R8).
class LeftOutRounds {
 public:
  /// tolerance: largest distance of the same state [m]. Precondition: rod and path outlive this object.
  LeftOutRounds(const Rod& rod, const ClampPath& path, double tolerance);

  /// Sees the state at the next time of the motion. step: time since the previous state [s]. Returns the duration of the rounds that
  /// can be left out now [s].
  double see(double time, double step, const RodState& state);

 private:
  const Rod& rod_;
  const double tolerance_;
  std::vector<MotionLoop> loops_;
  std::size_t loop_ = 0;
  int round_ = 0;                     // the next one of this loop
  RodState before_;                   // the previous state
  std::optional<RodState> at_begin_;  // of the previous round of this loop
};

/// Returns whether the path ends at its begin, so that it can be repeated: joints within 1e-6 rad; without a robot
/// clamps within 1e-6 m and rad.
bool returns(const ClampPath& path);

}  // namespace dresslife::sim
