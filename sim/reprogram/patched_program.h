// A robot program with changed lines: as text that is read back, and as a patch.
#pragma once

#include <string>
#include <vector>

#include "sim/reprogram/program_ways.h"

namespace dresslife::sim {

struct PatchedProgram {
  pipeline::Motion motion;  ///< motion of the patched program, read back
  std::string patch;        ///< a line with the folder in which it applies, then the unified diff of all files
};

/// Patches a program. Errors: InputError when a line cannot be written, or when the program that is read back differs from the
/// original by more than the changes of `way`; the message names the difference.
PatchedProgram patched(const pipeline::Job& job, const ReadProgram& read, const ProgramWay& way);

/// Returns the difference between two motions apart from changes of these lines of the first; empty: none. Steps that a point
/// adds stand before the line's own step.
std::string other_difference(const pipeline::Motion& before, const pipeline::Motion& after,
                             const std::vector<LineChange>& changes);

}  // namespace dresslife::sim
