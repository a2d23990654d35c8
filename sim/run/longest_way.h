// The largest straight way of each span over a motion: a shorter hose does not reach.
//
// On a robot few moments have to be computed:
// - Equal pieces of a motion, as those of its repeats, are computed once.
// - Within a piece no axis j is faster than v_j. It turns the one end of a straight line relative to the other, whose distance from
//   the joint's origin is at most the sum r_j of the distances from joint to joint. So the way w of a span follows
//       |w(t) - w(t_0)| <= |t - t_0| sum_j v_j r_j,
//   and moments are left out in which w cannot be larger than the largest one so far.
// The result is that of all moments.
#pragma once

#include <vector>

#include "sim/run/clamp_path.h"

namespace dresslife::sim {

struct LongestWay {
  double way = 0;   ///< [m]
  double time = 0;  ///< of its first occurrence [s]
};

/// Returns, (span), the largest of shortest_ways() over the motion; 0 for a span with a free end. step: distance of two moments [s]; it
/// is larger if there would be more than a million. Each piece of a robot's motion begins with a moment.
std::vector<LongestWay> longest_ways(const pipeline::Setup& setup, const Rod& rod, const ClampPath& path, double step);

}  // namespace dresslife::sim
