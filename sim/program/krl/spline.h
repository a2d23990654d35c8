// SPL points of a spline block. KUKA does not publish its splines' law; here: cubics between the points, smooth
// where they meet, each cut into lines of 20 mm.
#pragma once

#include <cstddef>
#include <set>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

/// points: indices of the instructions that are SPL points.
void bend_splines(const std::set<std::size_t>& points, Program& program);

}  // namespace dresslife::sim
