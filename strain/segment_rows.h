// Numbers that come sample by sample for all segments, and are asked for segment by segment over the whole
// motion: where loose cables bend. In memory while there is room, else in a file of their own that vanishes
// with them, so that memory does not grow with the motion's length.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "pipeline/base/whole_file.h"

namespace dresslife::strain {

/// Where long histories go.
struct Scratch {
  std::size_t room = static_cast<std::size_t>(-1);  ///< in memory [bytes]
  std::filesystem::path beside{};  ///< the file that they go beside when they have no room; empty: none
};

class SegmentRows {
 public:
  /// Of so many rows in each segment. Errors: InputError when its file cannot be made.
  SegmentRows(std::size_t segments, std::size_t rows, std::size_t samples, const Scratch& scratch);

  void begin(std::size_t samples);  ///< the next block
  float& at(std::size_t segment, std::size_t row, std::size_t sample_of_block) {
    return block_[(sample_of_block * segments_ + segment) * rows_ + row];
  }
  void end();  ///< of the block. Errors: InputError when the disk is full.

  /// Samples [first, first + count) of a row, to `to`. Precondition: they are in ended blocks. Errors:
  /// InputError when they cannot be read.
  void read(std::size_t segment, std::size_t row, std::size_t first, std::size_t count, double* to) const;

 private:
  struct Block {
    std::size_t first, samples;
    std::size_t offset;         ///< in the file, in numbers
    std::vector<float> values;  ///< (segment, row, sample), where there is no file
  };

  std::size_t segments_, rows_, block_samples_ = 0;
  std::vector<float> block_;  ///< (sample, segment, row) that comes in
  std::vector<Block> blocks_;
  std::unique_ptr<pipeline::WholeFile> file_;  ///< never committed
};

}  // namespace dresslife::strain
