// The search for all questions of a program, so that one round of answers is enough.
//
// At an undecided branch a reading asks the user and continues along one of the arms (ways) as if it were the answer.
// The next reading takes a way that no reading has taken. If all ways are taken, the choice is random: with
// probability 1/2 the way that last led to something new, else any way. Fixed turns would combine two successive
// branches always in the same manner. If 10 readings in a row find nothing new, a branch keeps its way for a few
// passes of the same reading. If 30 readings find nothing new, the search ends. A situation after the first guess may
// never happen: the questions of the reading count, its mistakes do not.
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
  /// Begins a reading. Returns false if the search is complete or a limit is reached.
  bool next_reading();
  /// Returns a way, 0 .. ways - 1, for a place. The random numbers are the same in every run.
  int choose(const std::string& place, int ways);
  /// Whether this reading has chosen a way.
  bool guessing() const { return guessing_; }
  /// Records an executed statement (`meet`) or a question (`meet_question`).
  void meet(const void* statement) {
    if (met_.insert(statement).second) ++news_;
  }
  void meet_question(const std::string& name) {
    if (asked_.insert(name).second) ++news_;
  }
  /// Returns the number of statements, questions and ways met so far.
  long news() const { return news_; }
  /// Records a branch without moves that decides a branch with moves: its ways are explored, too.
  void follow(const std::string& line);
  bool follows(const std::string& line) const { return followed_.contains(line); }
  /// Records the safe answer of a question (the delivered value `standard`). Later readings use it and find further questions.
  void suppose(const std::string& name, const std::string& standard) { supposed_.emplace(name, standard); }
  bool supposes_any() const { return readings_ > 1 && !supposed_.empty(); }
  /// Returns the name of the delivered value for a name; null: none.
  const std::string* supposed(const std::string& name) const {
    const auto found = supposed_.find(name);
    return found == supposed_.end() ? nullptr : &found->second;
  }
  /// Adds the number of statements and values that a finished reading executed.
  void spend(long executed) { spent_ += executed; }

 private:
  void report_ways();

  struct Way {
    bool taken = false;
    long led_to = 0;  // news() when the way last led to something new
  };
  std::map<std::string, std::vector<Way>> ways_;                        // by place
  std::deque<std::pair<std::vector<Way>*, std::ptrdiff_t>> last_ways_;  // last ways of this reading
  std::map<std::string, std::pair<int, int>>
      taken_here_;  // place -> last way in this reading, and number of repeated visits
  std::minstd_rand lot_;
  std::set<const void*> met_;
  std::set<std::string> asked_, followed_;
  std::map<std::string, std::string> supposed_;  // name -> name of the delivered value
  bool guessing_ = false;
  long news_ = 0, news_before_ = 0, news_printed_ = 0, spent_ = 0;
  int readings_ = 0, barren_ = 0;
};

/// Reads a program. If it has questions, reads it again until all questions are known. read(exploration, program, problems) is
/// one reading; the program of the first reading is the result.
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
