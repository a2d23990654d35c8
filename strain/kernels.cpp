#include "strain/kernels.h"

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
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    sets.push_back(&avx512_kernels::set);
#endif
  return sets;
}

const Kernels& kernels() {
  static const Kernels& widest = *kernels_of_this_machine().back();
  return widest;
}

}  // namespace dresslife::strain
