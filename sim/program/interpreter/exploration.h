// The search for all that a program asks, so that one round of answers is enough.
//
// Where the way that a program takes is unknown, a reading asks, and goes on along one of the ways as if that were
// the answer. The next reading takes a way that was not taken yet. Where all were, it takes every other time the one
// that led to something new last, else one by lot: in turns, two places that follow each other would always take the
// same of their ways together. When several readings in a row meet nothing new, a place that is met again goes the
// same way a few times; when these do not either, the search ends. What such a reading meets behind the first guess
// may never happen: its questions count, its mistakes do not.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

class Exploration {
 public:
  /// Begins a reading. False: enough is known.
  bool next_reading();
  /// A way, 0 .. ways - 1, from this place; lots fall the same in every run.
  int choose(const std::string& place, int ways);
  /// Whether this reading has chosen a way.
  bool guessing() const { return guessing_; }
  /// A statement was run, or something was asked.
  void meet(const void* statement) {
    if (met_.insert(statement).second) ++news_;
  }
  void meet_question(const std::string& name) {
    if (asked_.insert(name).second) ++news_;
  }
  /// How much was met for the first time.
  long news() const { return news_; }
  /// A branch that was left out because it moves nothing decides something that does: its ways are taken, too.
  void follow(const std::string& line);
  bool follows(const std::string& line) const { return followed_.contains(line); }
  /// What is asked has a safe answer, the delivered value of this name: later readings take it, to find what that asks for.
  void suppose(const std::string& name, const std::string& standard) { supposed_.emplace(name, standard); }
  bool supposes_any() const { return readings_ > 1 && !supposed_.empty(); }
  /// The delivered value for a name; null: none.
  const std::string* supposed(const std::string& name) const {
    const auto found = supposed_.find(name);
    return found == supposed_.end() ? nullptr : &found->second;
  }
  /// Of a reading that ends: statements and values that it ran.
  void spend(long executed) { spent_ += executed; }

 private:
  void report_ways();

  struct Way {
    bool taken = false;
    long led_to = 0;  // news() when it last led to something new
  };
  std::map<std::string, std::vector<Way>> ways_;                        // by their places
  std::deque<std::pair<std::vector<Way>*, std::ptrdiff_t>> last_ways_;  // of this reading
  std::map<std::string, std::pair<int, int>>
      taken_here_;  // place -> last way in this reading, and how often it was met again
  std::minstd_rand lot_;
  std::set<const void*> met_;
  std::set<std::string> asked_, followed_;
  std::map<std::string, std::string> supposed_;  // name -> name of the delivered value
  bool guessing_ = false;
  long news_ = 0, news_before_ = 0, news_printed_ = 0, spent_ = 0;
  int readings_ = 0, barren_ = 0;
};

/// Reads a program, and where it asks, again until all of its questions are known. read(exploration, program, problems) is one
/// reading; what the first one makes is kept.
template <class Read>
void explore(const Read& read, Program& program, Problems& problems) {
  Exploration exploration;
  const Program before = program;
  bool first = true;
  while (exploration.next_reading() && (first || problems.asks())) {
    Program made = before;
    Problems found;
    read(exploration, made, found);
    problems.add_all(found);
    if (first) program = std::move(made);
    first = false;
  }
}

}  // namespace dresslife::sim
