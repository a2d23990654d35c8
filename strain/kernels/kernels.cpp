#include "strain/kernels/kernels.h"

#include <cassert>
#include <string>

#include "pipeline/base/instruction_set.h"

namespace dresslife::strain {

using pipeline::InstructionSet;

namespace baseline_kernels {
extern const Kernels set;
}
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
namespace sse4_kernels {
extern const Kernels set;
}
namespace avx2_kernels {
extern const Kernels set;
}
namespace avx512_kernels {
extern const Kernels set;
}
#endif

namespace {

const Kernels& kernels_for(InstructionSet instructions) {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (instructions == InstructionSet::avx512) return avx512_kernels::set;
  if (instructions == InstructionSet::avx2) return avx2_kernels::set;
  if (instructions == InstructionSet::sse4) return sse4_kernels::set;
#endif
  assert(instructions == InstructionSet::baseline);
  return baseline_kernels::set;
}

}  // namespace

std::vector<const Kernels*> kernels_of_this_machine() {
  std::vector<const Kernels*> sets;
  for (const InstructionSet instructions : pipeline::instruction_sets())
    sets.push_back(&kernels_for(instructions));
  return sets;
}

const Kernels& kernels_named(const std::string& name) {
  return kernels_for(pipeline::instruction_set_named(name));
}

const Kernels& kernels() {
  static const Kernels& set = kernels_for(pipeline::instruction_set());
  return set;
}

}  // namespace dresslife::strain
