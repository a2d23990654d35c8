#include "pipeline/instruction_set.h"

#include <fmt/format.h>

#include <hwy/targets.h>
#include <cstdint>
#include <cstdlib>

#include "pipeline/errors.h"

namespace dresslife::pipeline {

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  const std::int64_t found = hwy::SupportedTargets();
  if (found & HWY_SSE4) sets.push_back(InstructionSet::sse4);
  if (found & HWY_AVX2) sets.push_back(InstructionSet::avx2);
  if ((found & HWY_AVX3_DL) && __builtin_cpu_supports("gfni")) sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::sse4:
      return "sse4";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::baseline:
      break;
  }
  return "baseline";
}

InstructionSet instruction_set_named(const std::string& name) {
  std::string names;
  for (const InstructionSet set : instruction_sets()) {
    if (name == name_of(set)) return set;
    names += (names.empty() ? "" : ", ") + std::string(name_of(set));
  }
  throw InputError(Where{"DRESSLIFE_KERNELS"}, fmt::format("is '{}' (this machine can run {})", name, names),
                   "set it to one of these, or unset it for the widest");
}

InstructionSet instruction_set() {
  static const char* const wanted = std::getenv("DRESSLIFE_KERNELS");
  static const InstructionSet set = wanted ? instruction_set_named(wanted) : instruction_sets().back();
  return set;
}

}  // namespace dresslife::pipeline
