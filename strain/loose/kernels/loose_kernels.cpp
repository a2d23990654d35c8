#include "strain/loose/kernels/loose_kernels.h"

#include <cassert>

#include "pipeline/base/instruction_set.h"

namespace dresslife::strain {

using pipeline::InstructionSet;

namespace baseline_loose {
extern const LooseKernels set;
}
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
namespace sse4_loose {
extern const LooseKernels set;
}
namespace avx2_loose {
extern const LooseKernels set;
}
namespace avx512_loose {
extern const LooseKernels set;
}
#endif

namespace {

const LooseKernels& kernels_for(InstructionSet instructions) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (instructions == InstructionSet::avx512) return avx512_loose::set;
  if (instructions == InstructionSet::avx2) return avx2_loose::set;
  if (instructions == InstructionSet::sse4) return sse4_loose::set;
#endif
  assert(instructions == InstructionSet::baseline);
  return baseline_loose::set;
}

}  // namespace

const LooseKernels& loose_kernels() {
  static const LooseKernels& set = kernels_for(pipeline::instruction_set());
  return set;
}

}  // namespace dresslife::strain
