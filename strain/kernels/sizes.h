// Numbers of samples, wires and waves that are processed together.
#pragma once

#include <cstddef>

namespace dresslife::strain {

constexpr int padding = 16;                 ///< histories are padded to a multiple of this number of samples
constexpr int lanes = 16;                   ///< wires scanned for turning points together
constexpr std::size_t block_samples = 256;  ///< samples per block: five layers' waves, 26 kB, stay in cache
constexpr int waves_per_layer = 5;          ///< mean, sin, cos, sin 2, cos 2 of the angle around a layer
constexpr int phases_per_pitch = 6;         ///< places of a mean over an ancestor's pitch

}  // namespace dresslife::strain
