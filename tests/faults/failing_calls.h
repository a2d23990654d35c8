// Runs programs whose system calls fail at chosen points. The library of tests/faults/shim is preloaded.
#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/process.h"

namespace dresslife::tests {

/// Runs a program with words of shell (variables, a wrapper) before its path. run() has no place for these words.
inline Outcome run_with(const Scratch& scratch, const std::string& before, const std::string& program,
                        const std::string& arguments) {
  scratch.write("call.sh", before + " '" DRESSLIFE_BIN_DIR "/" + program + "' " + arguments + "\n");
  return run_shell(scratch, "sh ./call.sh");
}

/// The call that fails in a program; see tests/faults/shim/failing_calls.cpp.
struct Fault {
  std::string call;
  int at = 0;  ///< number of the first call that fails, from 1; 0: none
  std::string mode{}, path{}, more = "0";
};

/// Runs a program with this fault. Programs that it starts have no faults. A program that hangs ends with status 124.
inline Outcome run_failing(const Scratch& scratch, const Fault& fault, const std::string& program,
                           const std::string& arguments) {
  return run_with(scratch,
                  // lets a program with sanitizers preload a library
                  "env ASAN_OPTIONS=verify_asan_link_order=0 FAULT_CALL=" + fault.call +
                      " FAULT_AT=" + std::to_string(fault.at) + " FAULT_MODE=" + fault.mode + " FAULT_PATH='" +
                      fault.path + "' FAULT_MORE=" + fault.more + " FAULT_PROGRAM=" + program + " FAULT_COUNT='" +
                      (scratch / "count").string() + "' LD_PRELOAD='" DRESSLIFE_FAILING_CALLS "' timeout 300",
                  program, arguments);
}
inline Outcome run_failing(const Scratch& scratch, const std::string& call, int at, const std::string& program,
                           const std::string& arguments) {
  return run_failing(scratch, Fault{call, at}, program, arguments);
}

/// Returns the number of matching calls of the program that ran last.
inline int calls_counted(const Scratch& scratch) { return std::stoi(content(scratch / "count")); }

/// Returns at most `count` of the numbers 1 .. total, including the first and the last, the others at random.
inline std::vector<int> some_of(int total, int count, std::mt19937& random) {
  std::vector<int> all(static_cast<std::size_t>(total));
  std::iota(all.begin(), all.end(), 1);
  if (total <= count) return all;
  std::shuffle(all.begin() + 1, all.end() - 1, random);
  std::swap(all[static_cast<std::size_t>(count) - 1], all.back());
  all.resize(static_cast<std::size_t>(count));
  return all;
}

/// Returns the bytes of all result files of a study (name -> bytes), without the runner's own bookkeeping.
inline std::map<std::string, std::string> results(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    const bool own = name.find(".stage") != std::string::npos || name == ".lock" || name == "build.ninja" ||
                     entry.path().filename() == "log";
    if (entry.is_regular_file() && !own) files[name] = content(entry.path());
  }
  return files;
}

/// Returns whether a folder or its subfolders contain an unfinished file (*.part).
inline bool holds_parts(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".part") return true;
  return false;
}

/// Returns whether `words` is one line with the form of this project's errors, including a remedy.
inline bool is_one_error(const std::string& words) {
  return std::count(words.begin(), words.end(), '\n') == 1 && words.find(": error: ") != std::string::npos &&
         words.find("; ") != std::string::npos;
}

struct Kind {
  std::string call, mode, path;
};
/// Faults of a disk that is full, broken or reports errors late, in every call in which a program can notice them.
inline const std::vector<Kind> kinds{{"write", "ENOSPC", ""},
                                     {"write", "short", ""},
                                     {"sync", "EIO", ""},
                                     {"close", "EIO", ""},
                                     {"cut", "EIO", ""},
                                     {"rename", "EIO", ""},
                                     {"link", "EPERM", "dresslife-"},
                                     {"remove", "EIO", "dresslife-"},
                                     {"make", "EACCES", "dresslife-"},
                                     {"read", "EIO", "dresslife-"},
                                     {"read", "end", ".h5"},
                                     {"read", "short", ".h5"},
                                     {"read", "flip", ".h5"},
                                     {"look", "EIO", "dresslife-"},
                                     {"open", "EIO", "dresslife-"},
                                     {"open", "EMFILE", "dresslife-"},
                                     {"list", "EIO", "dresslife-"},
                                     {"lock", "ENOLCK", ""}};

inline bool is_of_the_test(const std::string& name) {
  return name == ".out" || name == ".err" || name == "call.sh" || name == "count";
}
/// Returns whether a file holds notes of the runner, which later runs repair.
inline bool is_a_note(const std::string& name) {
  return name.find(".stage") != std::string::npos || name.ends_with(".lock") || name.ends_with("build.ninja") ||
         name.ends_with("/log");
}

inline std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (const std::string name = fs::relative(entry.path(), folder).string();
        entry.is_regular_file() && !is_of_the_test(name))
      files[name] = content(entry.path());
  return files;
}

/// Restores all files of the scratch folder to `before`. Files that did not change keep their dates.
inline void restore(const Scratch& scratch, const std::map<std::string, std::string>& before) {
  for (const auto& [name, bytes] : files_in(scratch.folder()))
    if (!before.contains(name)) fs::remove(scratch / name);
  for (const auto& [name, bytes] : before)
    if (!fs::exists(scratch / name) || content(scratch / name) != bytes) scratch.write(name, bytes);
}

}  // namespace dresslife::tests
