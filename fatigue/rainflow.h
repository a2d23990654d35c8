// Cycle counting: reversals of a strain history and the closed hysteresis loops (cycles) among them.
//
// Two countings of ASTM E1049-85, 5.4.4: half cycles (the history happens once) and the repeating history
// (5.4.5; the history happens again and again, so every reversal belongs to a closed cycle).
//
// Conventions, fatigue/README.md (F1):
//   - Reversals are the first sample, the last sample, every turn between, and the first sample of a plateau.
//   - A range closes a cycle when it is at least as large as the one before it: ties close.
//   - Only strains are compared, never differences or products of differences: no rounding and no underflow
//     decides. With below < top > next, the range (top, next) closes the range (below, top) if next <= below.
//   - A number that is not finite is refused, not skipped.
// Any quantity may be counted; the stage counts strain [1].
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dresslife::fatigue {

/// A turn of the history.
struct Reversal {
  double strain = 0;        ///< [1]
  std::int64_t sample = 0;  ///< where in the history

  bool operator==(const Reversal&) const = default;
};

/// A counted range: its two extremes in the order in which the history visits them.
struct Cycle {
  Reversal begin, end;
  double count = 1;  ///< 1, or 0.5 for a half cycle

  double range() const {
    return begin.strain < end.strain ? end.strain - begin.strain : begin.strain - end.strain;
  }
  double mean() const { return begin.strain / 2 + end.strain / 2; }
};

/// Finds the reversals of a history that arrives sample by sample.
class ReversalFinder {
 public:
  /// The reversal that this sample makes certain, if it does.
  /// @throws pipeline::InputError when the sample is not finite.
  std::optional<Reversal> push(double strain);
  /// The last one; nothing for an empty or constant history, whose only reversal is its first sample.
  std::optional<Reversal> finish() const;

 private:
  std::int64_t sample_ = 0;
  Reversal candidate_;
  int direction_ = 0;  // +1 rising to the candidate, -1 falling, 0 nothing but one level so far
};

/// All reversals of a history, (sample).
std::vector<Reversal> find_reversals(std::span<const double> history);

/// The first of a list that goes on in the direction of the one before it; its size where rises and falls
/// alternate. A plateau is one level. strain_of: of an element.
template <class List, class StrainOf>
std::size_t first_going_on(const List& list, const StrainOf& strain_of) {
  int direction = 0;
  for (std::size_t i = 1; i < list.size(); ++i) {
    const auto before = strain_of(list[i - 1]), now = strain_of(list[i]);
    if (now == before) continue;
    const int next = now > before ? 1 : -1;
    if (next == direction) return i;
    direction = next;
  }
  return list.size();
}

/// ASTM E1049-85, 5.4.4: full and half cycles of a history that happens once, in the order of counting.
/// @throws pipeline::InputError when rises and falls do not alternate: find_reversals() makes them.
std::vector<Cycle> count_half_cycles(std::span<const Reversal> reversals);

/// The reversals of one period of a repeated history, starting and ending with its largest |strain| (the
/// first such): begin of the next period joined to the end of this one, continued directions merged, so that
/// rises and falls alternate strictly. A constant history gives one reversal. Precondition: not empty.
std::vector<Reversal> rotate_to_largest(std::span<const Reversal> reversals);

/// Cycles of the repeated history, all of them full: one three-point pass over rotate_to_largest(), which
/// leaves no residue. A cycle that begins late in the repeat and ends early in the next has end.sample <
/// begin.sample.
std::vector<Cycle> count_repeating(std::span<const Reversal> reversals);

}  // namespace dresslife::fatigue
