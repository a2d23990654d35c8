// Eight samples side by side: arithmetic on a Pack is arithmetic on eight samples, in one instruction where
// the machine has registers that wide and in several where it has not. Included by kernels_body.h only,
// before helix.h.
#pragma once

#include <cmath>

#include "strain/sizes.h"

#ifndef DRESSLIFE_MACHINE
#error "pack.h belongs to the kernels, which name their instruction set"
#endif

namespace dresslife::strain {

inline namespace DRESSLIFE_MACHINE {

typedef double Pack __attribute__((vector_size(pack_size * sizeof(double))));

inline Pack square_root(const Pack& x) {
  Pack root;
  for (int k = 0; k < pack_size; ++k) root[k] = std::sqrt(x[k]);
  return root;
}

}  // namespace DRESSLIFE_MACHINE
}  // namespace dresslife::strain
