// Numbers and units that many folders need.
#pragma once

#include <limits>
#include <numbers>

namespace dresslife {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degree = pi / 180;  // in radians
constexpr double millimetre = 1e-3;  // in metres

}  // namespace dresslife
