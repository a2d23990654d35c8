// Collects all errors in a user's input. Readers and checks add problems and continue. At the end, finish() throws all problems
// as one InputErrors, one line each, in the order of the file.
//
// Consequences of an error are not reported: a problem notes its key ("routing.free_length_m"), a reader skips keys that were
// refused before, and a check calls touch() to find out whether its input was refused.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

struct Problem {
  Where where;
  std::string key;   ///< path of the key whose value was refused; empty: all keys have values
  std::string line;  ///< "WHERE: error: WHAT; REMEDY"
};

/// An InputError with one or several problems: what() has a line for each.
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
  void add(const Where& where, const std::string& what, const std::string& remedy, const std::string& key = "");

  /// Calls `act`, which may throw InputError, and adds its problems under `key`. A problem without a known line gets the place
  /// `where`. Returns whether `act` threw nothing.
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
  /// Returns whether the value of this key, a value in it or a value around it was refused: "routing" is touched by
  /// "routing.free_length_m".
  bool touch(const std::string& key) const;

  /// Throws all problems as InputErrors: those of `first_file` first, those of each file by line and column. Does nothing without
  /// problems.
  void finish(const std::string& first_file = "") const;

 private:
  void note(Problem problem);  ///< two equal lines are one problem
  std::vector<Problem> problems_;
  std::set<std::string> keys_;
  bool more_ = false;  ///< there are more problems than are stored
};

}  // namespace dresslife::pipeline
