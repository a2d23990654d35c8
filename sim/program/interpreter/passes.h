// The passes of an endless loop, or of a main program that begins again: where they end, and from which on
// they repeat.
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

  void add(std::uint64_t state);  ///< state: a sum over the program's variables at the pass's end
  std::size_t count() const { return states_.size(); }
  std::size_t end(std::size_t pass) const { return ends_[pass]; }  ///< moves up to the end of pass 1, 2, ..
  /// The last pass ends as an earlier one did and moved as it did: from here on everything repeats.
  bool repeats() const;
  /// Variables that only count never come back. Passes whose motion repeats, judged by the moves alone:
  /// how many there are up to the end of the first period; 0: no period is seen.
  std::size_t by_motion() const;
  /// Likewise, judged by the lines that move alone: the same states again, if at other places.
  std::size_t by_lines() const;
  /// Whether the later passes moved only on lines on which the first one did, too. A program that goes
  /// through states moves on others: its first pass is no cycle.
  bool only_lines_of_the_first() const;
  /// How many passes the motion is.
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
