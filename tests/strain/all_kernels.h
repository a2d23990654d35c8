// Returns the kernels of every instruction set that this machine supports, the portable set first.
#pragma once

#include <vector>

#include "strain/kernels/kernels.h"

namespace dresslife::strain {

inline std::vector<const Kernels*> kernels_of_this_machine() {
  std::vector<const Kernels*> sets;
  for (const pipeline::InstructionSet set : pipeline::instruction_sets()) sets.push_back(&kernels_for(set));
  return sets;
}

}  // namespace dresslife::strain
