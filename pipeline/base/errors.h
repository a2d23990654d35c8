// What can go wrong. InputError is the user's to mend. MachineFault and DiskError: a disk, memory or a limit of the
// system failed, and the same command may succeed later. All have exit status 1 and are worded
// `file:line:column: error: what (why); what to do`. Everything else that is thrown is our fault (exit status 3).
#pragma once

#include <fmt/format.h>  // for those who write messages

#include <stdexcept>
#include <string>
#include <string_view>

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

/// The last words of each error of the machine. A program that reads a stage's log knows such an error by them.
inline constexpr char then_run_again[] = ", then run again";

/// A file cannot be written, or is damaged. Reads "WHERE: error: WHAT; REMEDY, then run again".
class MachineFault : public InputError {
 public:
  MachineFault(const Where& where, const std::string& what, const std::string& remedy);
};

/// Whether a line that a program printed refuses its input. Other lines, and none, do not say that the input is wrong.
bool is_refusal(std::string_view line);

/// A file is there and cannot be read: nothing is known of what it holds. This is no InputError: what is damaged
/// can be made again, and a failing disk must not be taken for that.
class DiskError : public std::runtime_error {
 public:
  /// error: errno.
  DiskError(const std::string& file, int error);
};

}  // namespace dresslife::pipeline
