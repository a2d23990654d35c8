// Four-point cycle counting, an independent method that rainflow.h is compared with.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "fatigue/rainflow.h"

namespace dresslife::fatigue {

/// Of four successive reversals the middle pair closes a cycle if it lies within the outer pair. Returns the full cycles of
/// half-cycle counting and leaves the residue. The result does not depend on how the history is cut into pieces.
class FourPointCounter {
 public:
  /// Appends the cycles that this reversal closes to `closed`. A reversal that continues the last direction replaces the last.
  void push(const Reversal& reversal, std::vector<Cycle>& closed) {
    auto& r = residue_;
    if (!r.empty() && r.back().strain == reversal.strain) return;
    const bool goes_on =
        r.size() > 1 && (r.back().strain > r[r.size() - 2].strain) == (reversal.strain > r.back().strain);
    if (goes_on) r.pop_back();
    r.push_back(reversal);
    while (r.size() >= 4) {
      const std::size_t n = r.size();
      const auto [outer_low, outer_high] = std::minmax(r[n - 4].strain, r[n - 1].strain);
      const auto [inner_low, inner_high] = std::minmax(r[n - 3].strain, r[n - 2].strain);
      if (inner_low < outer_low || inner_high > outer_high) return;
      closed.push_back({r[n - 3], r[n - 2], 1});
      r.erase(r.end() - 3, r.end() - 1);
    }
  }
  const std::vector<Reversal>& residue() const { return residue_; }

 private:
  std::vector<Reversal> residue_;
};

/// Returns the cycles that close when a residue is repeated, in the order in which they close.
inline std::vector<Cycle> repeat_residue(std::span<const Reversal> residue) {
  FourPointCounter counter;
  std::vector<Cycle> closed;
  for (const Reversal& reversal : residue) counter.push(reversal, closed);
  closed.clear();
  for (const Reversal& reversal : residue) counter.push(reversal, closed);
  return closed;
}

}  // namespace dresslife::fatigue
