// The passes of an endless loop, or of a main program that starts again: their ends, and the first pass that repeats
// an earlier one.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

class Passes {
 public:
  explicit Passes(const std::vector<Instruction>& moves) : moves_(&moves), ends_{moves.size()} {}

  void add(std::uint64_t state);  ///< ends a pass; state: checksum of the program's variables
  std::size_t count() const { return states_.size(); }
  std::size_t end(std::size_t pass) const { return ends_[pass]; }  ///< number of moves at the end of pass 1, 2, ..
  /// Whether the last pass has the moves and the final state of an earlier pass. Then all later passes repeat.
  bool repeats() const;
  /// Returns the number of passes up to the end of the first period, judged by the moves alone; 0: no period.
  /// The moves are needed because a variable that counts never returns to an earlier value.
  std::size_t by_motion() const;
  /// Returns the same as by_motion(), judged by the lines of the moves alone; the targets may differ.
  std::size_t by_lines() const;
  /// Whether the later passes moved only on lines of the first pass's moves. False for a program that goes
  /// through several states: its first pass is not a whole cycle.
  bool only_lines_of_the_first() const;
  /// Returns the number of passes in the motion. wanted: the user's number; 0: none.
  std::size_t kept(std::size_t wanted) const;

 private:
  using Line = std::pair<std::string, int>;
  bool same_motion(std::size_t a, std::size_t b) const;
  std::set<Line> lines(std::size_t begin, std::size_t end) const;
  template <class Same>
  std::size_t period(const Same& same) const;

  const std::vector<Instruction>* moves_;
  std::vector<std::size_t> ends_;
  std::vector<std::uint64_t> states_;
};

/// "one pass", "3 passes".
std::string passes_text(long passes);

}  // namespace dresslife::sim
