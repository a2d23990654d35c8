// Which instruction set the hot loops of a stage run on. They are compiled once for each; the widest that the
// machine has is chosen when the program starts, so one machine always chooses the same and gives the same
// bytes.
#pragma once

#include <string>
#include <vector>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_WIDE_KERNELS  // AVX2 and AVX-512 are compiled, too: GCC alone takes them from a file's text
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DRESSLIFE_PORTABLE_SSE4  // the portable kernels need SSE4.2; sanitizers look at plain numbers instead
#endif
#endif

namespace dresslife::pipeline {

/// portable: for x86-64 with SSE4.2 and AES (since 2010), ARM, and whatever else a build is for. avx512: with
/// its byte permutations and GFNI (Ice Lake, Zen 4 and later).
enum class InstructionSet { portable, avx2, avx512 };

/// All that this machine can run, the portable one first.
/// @throws InputError for an x86-64 machine that lacks what the portable one needs.
std::vector<InstructionSet> instruction_sets();
const char* name_of(InstructionSet set);

/// Of those that this machine can run.
/// @throws InputError for another name: the variable DRESSLIFE_KERNELS is wrong.
InstructionSet instruction_set_named(const std::string& name);
/// The widest, or the one that the environment variable DRESSLIFE_KERNELS names.
/// @throws InputError as above.
InstructionSet instruction_set();

}  // namespace dresslife::pipeline
