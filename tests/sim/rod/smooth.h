// How motions of the tests start and end.
#pragma once

namespace dresslife::sim::test {

/// From 0 to 1 as u does, at rest with its first two derivatives at both ends.
inline double smooth(double u) { return u <= 0 ? 0 : u >= 1 ? 1 : u * u * u * (10 - 15 * u + 6 * u * u); }

}  // namespace dresslife::sim::test
