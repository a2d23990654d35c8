#include "pipeline/base/instruction_set.h"

#include <fmt/format.h>

#include <cstdlib>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

// Tests every instruction that the Highway targets let the compiler use. Highway's own test is in a shared library that measures
// the clock at each start of a program. This takes 3 ms, half as much as the whole start of a stage.
std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::portable};
#ifdef DRESSLIFE_WIDE_KERNELS
  const bool sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("ssse3") &&
                    __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
#ifdef DRESSLIFE_PORTABLE_SSE4
  if (!sse4)
    throw InputError(Where{"this machine"}, "has no SSE4.2 and AES (processors made since 2010 have both)",
                     "use a newer machine; in a virtual one, let it see the processor's features");
#endif
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("f16c") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  if (avx2) sets.push_back(InstructionSet::avx2);
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2") &&
                      __builtin_cpu_supports("avx512bitalg") && __builtin_cpu_supports("avx512vpopcntdq") &&
                      __builtin_cpu_supports("vpclmulqdq") && __builtin_cpu_supports("vaes") &&
                      __builtin_cpu_supports("gfni");
  if (avx512) sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

const char* name_of(InstructionSet set) {
  return set == InstructionSet::avx512 ? "avx512" : set == InstructionSet::avx2 ? "avx2" : "portable";
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
