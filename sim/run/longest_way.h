// The largest straight way of each span over a motion: a shorter hose does not reach.
//
// Equal pieces of a robot's motion, as those of its repeats, are computed once.
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
