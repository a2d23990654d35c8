// Selects the instruction set of the hot loops. The loops are compiled once per instruction set. A program selects the widest set
// of its machine at its start. The selection is always the same on one machine, so the results have the same bytes.
#pragma once

#include <string>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_WIDE_KERNELS  // AVX2 and AVX-512 are compiled too; only GCC accepts them as a pragma in a file
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DRESSLIFE_PORTABLE_SSE4  // the portable kernels need SSE4.2; with sanitizers they compute number by number instead
#endif
#endif

namespace dresslife::pipeline {

/// portable: x86-64 with SSE4.2 and AES (since 2010), ARM, and any other architecture. avx512: with byte permutations and GFNI
/// (Ice Lake, Zen 4 and later).
enum class InstructionSet { portable, avx2, avx512 };

/// Returns all sets that this machine can run, portable first.
/// @throws InputError for an x86-64 machine without the instructions of the portable set.
std::vector<InstructionSet> instruction_sets();
const char* name_of(InstructionSet set);

/// Returns the set with this name, if this machine can run it.
/// @throws InputError for another name: the variable DRESSLIFE_KERNELS is wrong.
InstructionSet instruction_set_named(const std::string& name);
/// Returns the widest set, or the set that the environment variable DRESSLIFE_KERNELS names.
/// @throws InputError like instruction_sets() and instruction_set_named().
InstructionSet instruction_set();

}  // namespace dresslife::pipeline
