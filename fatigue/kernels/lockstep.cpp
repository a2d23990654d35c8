#include "fatigue/kernels/lockstep.h"

#include <cassert>

namespace dresslife::fatigue {

using pipeline::InstructionSet;

namespace baseline_lockstep {
extern const Lockstep set;
}
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
namespace avx2_lockstep {
extern const Lockstep set;
}
namespace avx512_lockstep {
extern const Lockstep set;
}
#endif

const Lockstep& lockstep_for(InstructionSet instructions) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (instructions == InstructionSet::avx512) return avx512_lockstep::set;
  if (instructions == InstructionSet::avx2) return avx2_lockstep::set;
#endif
  assert(instructions == InstructionSet::baseline || instructions == InstructionSet::sse4);
  return baseline_lockstep::set;
}

}  // namespace dresslife::fatigue
