#include "strain/kernels/kernels.h"

#include <cassert>

namespace dresslife::strain {

using pipeline::InstructionSet;

namespace portable_kernels {
extern const Kernels set;
}
#ifdef DRESSLIFE_WIDE_KERNELS
namespace avx2_kernels {
extern const Kernels set;
}
namespace avx512_kernels {
extern const Kernels set;
}
#endif

const Kernels& kernels_for([[maybe_unused]] InstructionSet instructions) {
#ifdef DRESSLIFE_WIDE_KERNELS
  if (instructions == InstructionSet::avx512) return avx512_kernels::set;
  if (instructions == InstructionSet::avx2) return avx2_kernels::set;
#endif
  assert(instructions == InstructionSet::portable);
  return portable_kernels::set;
}

const Kernels& kernels() {
  static const Kernels& set = kernels_for(pipeline::instruction_set());
  return set;
}

}  // namespace dresslife::strain
