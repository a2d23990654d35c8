// A robot program with changed lines: as text, read back, and as a patch.
#pragma once

#include <string>
#include <vector>

#include "sim/reprogram/program_ways.h"

namespace dresslife::sim {

struct PatchedProgram {
  pipeline::Motion motion;  ///< of the patched program, read back
  std::string patch;        ///< unified diff of all its files, with names below the program's folder
};

/// Errors: InputError where a line cannot be written, or where the program that is read back differs from what it was
/// in more than what the way changes; the message says in what.
PatchedProgram patched(const pipeline::Job& job, const ReadProgram& read, const ProgramWay& way);

/// What differs between two motions besides changes of these lines of the first; empty: nothing. Steps that a point
/// adds stand before the line's own.
std::string other_difference(const pipeline::Motion& before, const pipeline::Motion& after,
                             const std::vector<LineChange>& changes);

}  // namespace dresslife::sim
