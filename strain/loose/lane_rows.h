// Arrays of numbers of cables, side by side in the lanes of a register (strain/loose/kernels).
#pragma once

#include <vector>

#include "strain/loose/kernels/loose_kernels.h"

namespace dresslife::strain {

/// Starts at a cache line.
class LaneRows {
 public:
  void assign(std::size_t rows, std::size_t in_row) { blocks_.assign(rows * in_row / most_lanes, {}); }
  double* data() { return blocks_.empty() ? nullptr : blocks_.front().of; }
  const double* data() const { return blocks_.empty() ? nullptr : blocks_.front().of; }
  double& operator[](std::size_t k) { return data()[k]; }
  double operator[](std::size_t k) const { return data()[k]; }

 private:
  struct alignas(64) Block {
    double of[most_lanes] = {};
  };
  std::vector<Block> blocks_;
};

}  // namespace dresslife::strain
