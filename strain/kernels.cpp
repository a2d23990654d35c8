#include "strain/kernels.h"

#include <cstdlib>
#include <string>

#include "pipeline/errors.h"

namespace dresslife::strain {

namespace baseline_kernels {
extern const Kernels set;
}
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
namespace avx2_kernels {
extern const Kernels set;
}
namespace avx512_kernels {
extern const Kernels set;
}
#endif

std::vector<const Kernels*> kernels_of_this_machine() {
  std::vector<const Kernels*> sets{&baseline_kernels::set};
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) sets.push_back(&avx2_kernels::set);
  if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512cd"))
    sets.push_back(&avx512_kernels::set);
#endif
  return sets;
}

const Kernels& kernels_named(const std::string& name) {
  std::string names;
  for (const Kernels* set : kernels_of_this_machine()) {
    if (name == set->machine) return *set;
    names += (names.empty() ? "" : ", ") + std::string(set->machine);
  }
  throw pipeline::InputError(pipeline::Where{"DRESSLIFE_KERNELS"},
                             fmt::format("is '{}' (this machine can run {})", name, names),
                             "set it to one of these, or unset it for the widest");
}

const Kernels& kernels() {
  static const char* const wanted = std::getenv("DRESSLIFE_KERNELS");
  static const Kernels& set = wanted ? kernels_named(wanted) : *kernels_of_this_machine().back();
  return set;
}

}  // namespace dresslife::strain
