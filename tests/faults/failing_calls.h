// Programs whose calls fail at chosen places: tests/faults/shim preloaded.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tests/cli/process.h"

namespace dresslife::tests {

/// Runs with words before the program; run() quotes the program alone.
inline Outcome run_with(const Scratch& scratch, const std::string& before, const std::string& program,
                        const std::string& arguments) {
  scratch.write("call.sh", before + " '" DRESSLIFE_BIN_DIR "/" + program + "' " + arguments + "\n");
  return run_shell(scratch, "sh ./call.sh");
}

/// Runs a program, of which the `at`-th `call` (write, sync, close, cut, rename) on a file that is being
/// written fails; at 0 none does. Programs that it starts are left alone.
inline Outcome run_failing(const Scratch& scratch, const std::string& call, int at,
                           const std::string& program, const std::string& arguments) {
  return run_with(scratch,
                  // so that a sanitized program lets a library be preloaded
                  "env ASAN_OPTIONS=verify_asan_link_order=0 FAULT_CALL=" + call +
                      " FAULT_AT=" + std::to_string(at) + " FAULT_PROGRAM=" + program + " FAULT_COUNT='" +
                      (scratch / "count").string() + "' LD_PRELOAD='" DRESSLIFE_FAILING_CALLS "' ",
                  program, arguments);
}

/// How many such calls the last of these programs made.
inline int calls_counted(const Scratch& scratch) { return std::stoi(content(scratch / "count")); }

/// At most `count` of 1 .. total, the first and the last among them.
inline std::vector<int> some_of(int total, int count, std::mt19937& random) {
  std::vector<int> all(static_cast<std::size_t>(total));
  std::iota(all.begin(), all.end(), 1);
  if (total <= count) return all;
  std::shuffle(all.begin() + 1, all.end() - 1, random);
  std::swap(all[static_cast<std::size_t>(count) - 1], all.back());
  all.resize(static_cast<std::size_t>(count));
  return all;
}

}  // namespace dresslife::tests
