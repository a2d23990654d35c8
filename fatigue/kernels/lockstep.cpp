#include "fatigue/kernels/lockstep.h"

#include <cassert>

namespace dresslife::fatigue {

using pipeline::InstructionSet;

namespace portable_lockstep {
extern const Lockstep set;
}
#ifdef DRESSLIFE_WIDE_KERNELS
namespace avx2_lockstep {
extern const Lockstep set;
}
namespace avx512_lockstep {
extern const Lockstep set;
}
#endif

const Lockstep& lockstep_for([[maybe_unused]] InstructionSet instructions) {
#ifdef DRESSLIFE_WIDE_KERNELS
  if (instructions == InstructionSet::avx512) return avx512_lockstep::set;
  if (instructions == InstructionSet::avx2) return avx2_lockstep::set;
#endif
  assert(instructions == InstructionSet::portable);
  return portable_lockstep::set;
}

}  // namespace dresslife::fatigue
