// Which instruction set the hot loops of a stage run on. They are compiled once for each; the widest that the
// machine has is chosen when the program starts, so one machine always chooses the same and gives the same
// bytes.
#pragma once

#include <string>
#include <vector>

namespace dresslife::pipeline {

/// baseline: whatever the build is for, number by number where that is plain x86-64; avx512: with its byte
/// permutations and GFNI (Ice Lake, Zen 4 and later).
enum class InstructionSet { baseline, sse4, avx2, avx512 };

std::vector<InstructionSet> instruction_sets();  ///< all that this machine can run, plain one first
const char* name_of(InstructionSet set);

/// Of those that this machine can run.
/// @throws InputError for another name: the variable DRESSLIFE_KERNELS is wrong.
InstructionSet instruction_set_named(const std::string& name);
/// The widest, or the one that the environment variable DRESSLIFE_KERNELS names.
/// @throws InputError as above.
InstructionSet instruction_set();

}  // namespace dresslife::pipeline
