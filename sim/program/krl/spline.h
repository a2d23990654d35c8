// SPL points of a spline block. KUKA does not publish the equations of its splines. Here the curve consists of cubics
// between the points, with continuous tangents, each divided into lines of 20 mm.
#pragma once

#include <cstddef>
#include <set>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

/// Replaces the moves to SPL points by lines along the curve. points: indices of the instructions that are SPL points.
void bend_splines(const std::set<std::size_t>& points, Program& program);

}  // namespace dresslife::sim
