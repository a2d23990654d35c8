// Values that arrive sample by sample for all segments, and are read segment by segment over the whole motion (curvature of
// loose cables). They stay in memory if they fit. Otherwise they go to a temporary file, which is deleted with this object, so
// that memory does not grow with the motion's length.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "pipeline/base/whole_file.h"

namespace dresslife::strain {

/// Memory limit and place of a temporary file for long histories.
struct Scratch {
  std::size_t room = static_cast<std::size_t>(-1);  ///< limit in memory [bytes]
  std::filesystem::path beside{};  ///< file beside which the temporary file is created; empty: no temporary file
};

class SegmentRows {
 public:
  /// rows: per segment. Errors: InputError when the temporary file cannot be created.
  SegmentRows(std::size_t segments, std::size_t rows, std::size_t samples, const Scratch& scratch);

  void clear() { blocks_.clear(); }  ///< the next block is the first one again
  void begin(std::size_t samples);   ///< the next block
  float& at(std::size_t segment, std::size_t row, std::size_t sample_of_block) {
    return block_[(sample_of_block * segments_ + segment) * rows_ + row];
  }
  void end();  ///< ends the block. Errors: InputError when the disk is full.
  /// Adds a whole block. values: (segment, row, sample). Errors: InputError when the disk is full.
  void append(std::vector<float> values, std::size_t samples);

  /// Copies samples [first, first + count) of a row to `to`. Precondition: end() was called for their blocks. Errors:
  /// MachineFault (an InputError) when the temporary file cannot be read.
  void read(std::size_t segment, std::size_t row, std::size_t first, std::size_t count, double* to) const;

 private:
  struct Block {
    std::size_t first, samples;
    std::size_t offset;         ///< in the file, in values
    std::vector<float> values;  ///< (segment, row, sample); empty if there is a file
  };

  std::size_t segments_, rows_, block_samples_ = 0;
  std::vector<float> block_;  ///< (sample, segment, row) of the present block
  std::vector<Block> blocks_;
  std::unique_ptr<pipeline::WholeFile> file_;  ///< the temporary file, never committed
};

}  // namespace dresslife::strain
