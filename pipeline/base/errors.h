// Kinds of errors. InputError: the user can correct the input. MachineFault and DiskError: a disk, memory or a limit of the
// system failed; the same command may succeed later. All three end a program with exit status 1 and a message of the form
// `file:line:column: error: what (why); what to do`. Any other exception is a bug of this project (exit status 3).
#pragma once

#include <fmt/format.h>  // for the code that writes messages

#include <stdexcept>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

/// A place in an input file. Line and column count from 1; 0 = not known.
struct Where {
  std::string file;
  int line = 0;
  int column = 0;

  std::string text() const;  ///< "file:line:column"; unknown parts are left out
};

class InputError : public std::runtime_error {
 public:
  /// what: the problem. remedy: what the user can do. The message is "WHERE: error: WHAT; REMEDY".
  InputError(const Where& where, const std::string& what, const std::string& remedy);
  /// Makes an error with this complete message, which may have several lines.
  explicit InputError(const std::string& words) : std::runtime_error(words) {}
};

/// Every message of a MachineFault or DiskError ends with these words. A program that reads a stage's log finds such errors by
/// them.
inline constexpr char then_run_again[] = ", then run again";

/// A file cannot be written or is damaged. The message is "WHERE: error: WHAT; REMEDY, then run again".
class MachineFault : public InputError {
 public:
  MachineFault(const Where& where, const std::string& what, const std::string& remedy);
};

/// Returns whether a line that a program printed is an error of its input. Any other line, and an empty one, returns false.
bool is_refusal(std::string_view line);

/// A file exists but cannot be read, so its content is unknown. It is no InputError: a damaged file can be computed again, and a
/// failing disk must not be mistaken for a damaged file.
class DiskError : public std::runtime_error {
 public:
  /// error: errno.
  DiskError(const std::string& file, int error);
};

}  // namespace dresslife::pipeline
