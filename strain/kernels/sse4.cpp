// The hot loops for SSE4.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_MACHINE sse4
#define DRESSLIFE_MACHINE_KERNELS sse4_kernels
#define DRESSLIFE_MACHINE_NAME "sse4"
#define DRESSLIFE_TARGET HWY_SSE4

#include "pipeline/base/simd.h"  // and what loops use from outside: it must be compiled for any machine

DRESSLIFE_BEGIN_MACHINE
#include "strain/kernels/body.h"
DRESSLIFE_END_MACHINE
#endif
