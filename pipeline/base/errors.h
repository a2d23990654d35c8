// What can go wrong, in three kinds. InputError is the user's to mend. DiskError: the system cannot read what is
// there. Both have exit status 1 and are worded `file:line:column: error: what (why); what to do`. Everything else
// that is thrown is our fault (exit status 3).
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace dresslife::pipeline {

/// A place in an input file. Line and column count from 1; 0 = not known.
struct Where {
  std::string file;
  int line = 0;
  int column = 0;

  std::string text() const;  ///< "file:line:column", as much of it as is known
};

class InputError : public std::runtime_error {
 public:
  /// what: the problem; remedy: what to do about it. Reads "WHERE: error: WHAT; REMEDY".
  InputError(const Where& where, const std::string& what, const std::string& remedy);
  /// The words of another one, with more lines.
  explicit InputError(const std::string& words) : std::runtime_error(words) {}
};

/// A file is there and cannot be read: nothing is known of what it holds. This is no InputError: what is damaged
/// can be made again, and a failing disk must not be taken for that.
class DiskError : public std::runtime_error {
 public:
  /// error: errno.
  DiskError(const std::string& file, int error);
};

}  // namespace dresslife::pipeline
