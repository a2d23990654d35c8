// The time law of the start and end of the tests' motions.
#pragma once

namespace dresslife::sim::test {

/// Rises from 0 to 1 for u = 0 .. 1. First and second derivative are 0 at both ends.
inline double smooth(double u) { return u <= 0 ? 0 : u >= 1 ? 1 : u * u * u * (10 - 15 * u + 6 * u * u); }

}  // namespace dresslife::sim::test
