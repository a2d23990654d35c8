// All that is wrong with what a user wrote, at once: readers and checks add to it and go on, and the last of
// them throws the whole as one InputError, a line for each, in the order of the file.
//
// What follows from a mistake is no mistake: a problem notes the key that it is of ("routing.free_length_m"),
// a reader passes over a key that was refused before, and a check asks touch() whether what it judges was
// read.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

struct Problem {
  Where where;
  std::string key;   ///< path of the key that has no value for it; empty: all keys have theirs
  std::string line;  ///< "WHERE: error: WHAT; REMEDY"
};

/// An InputError that may tell of several problems: what() has a line for each.
class InputErrors final : public InputError {
 public:
  explicit InputErrors(std::vector<Problem> problems);
  const char* what() const noexcept override { return text_.c_str(); }
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
  std::string text_;
};

class Problems {
 public:
  void add(const Where& where, const std::string& what, const std::string& remedy,
           const std::string& key = "");

  /// Calls what may throw an InputError; what it throws is noted as of the key, at its own place or, where
  /// that lies in no line that is known, at this one. Returns whether it threw nothing.
  template <class Act>
  bool attempt(const std::string& key, const Where& where, const Act& act) {
    try {
      act();
      return true;
    } catch (const InputErrors& several) {
      for (const Problem& problem : several.problems()) note({problem.where, key, problem.line});
    } catch (const InputError& one) {
      note({where, key, one.what()});
    }
    return false;
  }

  const std::set<std::string>& keys() const { return keys_; }  ///< that were refused
  /// Whether a value of this key, at it, in it or around it, was refused: "routing" by
  /// "routing.free_length_m".
  bool touch(const std::string& key) const;

  /// Throws all of them as InputErrors, those in this file first and each file's by line and column; nothing
  /// where there are none.
  void finish(const std::string& first_file = "") const;

 private:
  void note(Problem problem);  ///< the same line twice is one problem
  std::vector<Problem> problems_;
  std::set<std::string> keys_;
  bool more_ = false;  ///< problems than are kept
};

/// The lines of an InputError's words: one for each problem.
std::vector<std::string> problem_lines(const std::string& words);

}  // namespace dresslife::pipeline
