#include "strain/loose/kernels/loose_kernels.h"

#include <cassert>

#include "pipeline/base/instruction_set.h"

namespace dresslife::strain {

using pipeline::InstructionSet;

namespace portable_loose {
extern const LooseKernels set;
}
#ifdef DRESSLIFE_WIDE_KERNELS
namespace avx2_loose {
extern const LooseKernels set;
}
namespace avx512_loose {
extern const LooseKernels set;
}
#endif

namespace {

const LooseKernels& kernels_for([[maybe_unused]] InstructionSet instructions) {
#ifdef DRESSLIFE_WIDE_KERNELS
  if (instructions == InstructionSet::avx512) return avx512_loose::set;
  if (instructions == InstructionSet::avx2) return avx2_loose::set;
#endif
  assert(instructions == InstructionSet::portable);
  return portable_loose::set;
}

}  // namespace

const LooseKernels& loose_kernels() {
  static const LooseKernels& set = kernels_for(pipeline::instruction_set());
  return set;
}

}  // namespace dresslife::strain
