// Rising lists of numbers, one after the other and each much like the one before, as HDF5's shuffle and
// deflate filters store them: any HDF5 library reads such a dataset as plain numbers. Wires side by side turn
// at the same samples, so a list costs little more than where it departs from that before: one bit a number
// where counting bits would need thirteen. A general compressor finds the same, at twenty times the cost.
//
// A chunk is a zlib stream of the numbers' lowest bytes, then their second bytes, third and fourth. Lists are
// told apart where numbers do not rise. Within a list, numbers that the list before has in the same order are
// copied from there; what is left over is written out, equal bytes in a row as one. Codes are the fixed ones.
//
// Source: RFC 1950 and 1951; HDF5 reference manual, H5Pset_shuffle and H5Pset_deflate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dresslife::pipeline {

/// Reused from chunk to chunk.
class ListDeflater {
 public:
  /// Largest chunk: copies reach back so far.
  static constexpr std::size_t most_numbers = 1 << 15;

  /// Bytes of one chunk. Precondition: 1 .. most_numbers numbers.
  void pack(std::span<const std::uint32_t> numbers, std::vector<char>& chunk);

 private:
  /// Numbers [at, at + length) are those `distance` before.
  struct Copy {
    std::size_t at, length, distance;
  };
  void find_copies(std::span<const std::uint32_t> numbers);

  std::vector<Copy> copies_;
  std::vector<std::uint8_t> plane_;  ///< one byte of every number
};

}  // namespace dresslife::pipeline
