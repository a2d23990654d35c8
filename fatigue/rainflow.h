// Cycle counting: reversals of a strain history and the closed hysteresis loops (cycles) among them.
//
// Two countings of ASTM E1049-85: half cycles of a history that happens once (5.4.4), and the repeating history (5.4.5), in which
// every reversal belongs to a closed cycle.
//
// Conventions (F1):
//   - Reversals are the first sample, the last sample, and every turn between; a plateau counts at its first sample.
//   - A range closes a cycle when it is at least as large as the range before it: equal ranges close.
//   - Only strains are compared, never differences or products of differences, so rounding and underflow have no influence. With
//     below < top > next, the range (top, next) closes the range (below, top) if next <= below.
//   - A number that is not finite is an error; it is not skipped.
// Any quantity can be counted; the stage counts strain [1].
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
  std::int64_t sample = 0;  ///< number of the sample in the history

  bool operator==(const Reversal&) const = default;
};

/// A counted range: its two extremes in the order of time.
struct Cycle {
  Reversal begin, end;
  double count = 1;  ///< 1, or 0.5 for a half cycle

  double range() const { return begin.strain < end.strain ? end.strain - begin.strain : begin.strain - end.strain; }
  double mean() const { return begin.strain / 2 + end.strain / 2; }
};

/// Finds the reversals of a history that arrives sample by sample.
class ReversalFinder {
 public:
  /// Takes the next sample. Returns the reversal that it confirms, or std::nullopt.
  /// @throws pipeline::InputError when the sample is not finite.
  std::optional<Reversal> push(double strain);
  /// Returns the last reversal; std::nullopt for an empty or constant history, whose only reversal is its first sample.
  std::optional<Reversal> finish() const;

 private:
  std::int64_t sample_ = 0;
  Reversal candidate_;
  int direction_ = 0;  // +1 rising to the candidate, -1 falling, 0: one level so far
};

/// Returns all reversals of a history (sample).
std::vector<Reversal> find_reversals(std::span<const double> history);

/// Returns the index of the first element of a list that continues the direction of the element before it; the list's size if
/// rises and falls alternate. A plateau is one level. strain_of: returns the strain of an element.
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

/// Returns full and half cycles of a history that happens once, in the order of counting: ASTM E1049-85, 5.4.4.
/// @throws pipeline::InputError when rises and falls do not alternate; those of find_reversals() do.
std::vector<Cycle> count_half_cycles(std::span<const Reversal> reversals);

/// Returns the reversals of one period of a repeated history, from its largest |strain| (the first one) to the next occurrence.
/// The end of the history is joined to its begin, and continued directions are merged, so that rises and falls alternate
/// strictly. A constant history gives one reversal. Precondition: not empty.
std::vector<Reversal> rotate_to_largest(std::span<const Reversal> reversals);

/// Returns the cycles of the repeated history, all of them full: one three-point pass over rotate_to_largest(), without residue.
/// A cycle that begins late in one repeat and ends early in the next has end.sample < begin.sample.
std::vector<Cycle> count_repeating(std::span<const Reversal> reversals);

}  // namespace dresslife::fatigue
