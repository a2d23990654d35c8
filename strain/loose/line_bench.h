// Finds the rest of cables. A fixed number of cables are computed side by side; when one rests, the next one takes its lane. A
// cable needs 2 to 60 iterations of Newton's method. Cables with the most iterations at the previous sample go first, in classes of
// eight iterations.
#pragma once

#include <span>
#include <vector>

#include "strain/loose/cable_lines.h"

namespace dresslife::strain {

class LineBench {
 public:
  explicit LineBench(const HoseLine& hose);
  LineBench(LineBench&&) = default;  // the addresses of the rows are kept

  /// Moves all cables to the minimum of their energies, in at most `most` iterations. Precondition: lines of one hose, with
  /// begin() called for the same sample.
  void relax(std::span<CableLines* const> lines, int most);

 private:
  LineBatch bench_;
  std::vector<LaneRows> rows_;
  std::vector<WaitingCable> waiting_;
};

}  // namespace dresslife::strain
