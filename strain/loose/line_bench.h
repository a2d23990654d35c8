// Where cables come to rest: so many side by side, and as one rests the next one takes its lane. How long
// each takes is as it comes, from 2 to 60 of Newton's iterations; those that took longest before go first.
#pragma once

#include <span>
#include <vector>

#include "strain/loose/cable_lines.h"
#include "strain/loose/lane_rows.h"

namespace dresslife::strain {

class LineBench {
 public:
  LineBench(const HoseLine& hose, bool presses);
  LineBench(LineBench&&) = default;  // rows stay where they are

  /// Takes all cables to the minimum of their energies, in at most so many iterations. Lines of one hose, all
  /// begun at one sample.
  void relax(std::span<CableLines* const> lines, int most);

 private:
  LineBatch bench_;
  std::vector<LaneRows> rows_;
  std::vector<WaitingCable> waiting_;
};

}  // namespace dresslife::strain
