// Eight samples side by side: arithmetic on a Pack is arithmetic on eight samples, in one instruction where
// the machine has registers that wide and in several where it has not. The compilers' vector extension does
// the lowering, so one source serves every instruction set (see DRESSLIFE_EVERY_MACHINE).
#pragma once

#include <cmath>

namespace dresslife::strain {

constexpr int pack_size = 8;
typedef double Pack __attribute__((vector_size(pack_size * sizeof(double))));

inline Pack square_root(const Pack& x) {
  Pack root;
  for (int k = 0; k < pack_size; ++k) root[k] = std::sqrt(x[k]);
  return root;
}

/// Before a hot function: compiled once per instruction set, everything it calls inlined into each copy, the
/// right copy chosen when the program starts. Elsewhere than on x86-64 there is one copy.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define DRESSLIFE_EVERY_MACHINE \
  __attribute__((target_clones("default", "arch=haswell", "arch=skylake-avx512"), flatten))
#else
#define DRESSLIFE_EVERY_MACHINE
#endif

}  // namespace dresslife::strain
