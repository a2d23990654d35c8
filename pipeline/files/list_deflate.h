// Compresses increasing lists of numbers, each similar to the preceding one, in the format of HDF5's deflate filter: any HDF5
// library reads such a dataset as plain numbers. Neighbouring wires have their reversals at the same samples, so a list needs
// little space for the parts that are equal: one bit per number, where a coding of the numbers alone would need thirteen.
//
// libdeflate (included only here) compresses the chunks at its lowest level, without HDF5's shuffle filter: whole numbers repeat
// better than their single bytes. For the 114 million reversals of a glued job of 0.8 G wire-samples it takes 0.5 s and 9.9 MB;
// shuffled 1.1 s and 9.2 MB; HDF5's own filters 1.1 s and 11.9 MB; HDF5's scale-offset filter 1.2 s and 170 MB (Xeon, one core).
//
// Inflater decompresses any deflated chunk, and reports a chunk of a wrong size: HDF5 would read beyond the end of a short one.
//
// Source: HDF5 reference manual, H5Pset_deflate; RFC 1950.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct libdeflate_compressor;
struct libdeflate_decompressor;

namespace dresslife::pipeline {

/// Compresses lists; one object is used for many chunks.
class ListDeflater {
 public:
  /// Largest number of numbers in a chunk.
  static constexpr std::size_t most_numbers = 1 << 15;

  ListDeflater();

  /// Writes the bytes of one chunk. Precondition: 1 .. most_numbers numbers.
  void pack(std::span<const std::uint32_t> numbers, std::vector<char>& chunk);

 private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

/// Decompresses chunks; one object is used for many chunks.
class Inflater {
 public:
  Inflater();

  /// Decompresses a chunk of any program. Returns false if it is damaged, or does not have exactly bytes.size() bytes.
  bool unpack(std::span<const char> chunk, std::span<char> bytes);

 private:
  struct Free {
    void operator()(libdeflate_decompressor* decompressor) const;
  };
  std::unique_ptr<libdeflate_decompressor, Free> decompressor_;
};

}  // namespace dresslife::pipeline
