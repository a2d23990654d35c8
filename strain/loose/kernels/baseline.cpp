// The hot loops of loose cables for the plain instruction set of the build: any machine of its kind.
#define DRESSLIFE_MACHINE baseline
#define DRESSLIFE_MACHINE_KERNELS baseline_loose
#define DRESSLIFE_MACHINE_NAME "baseline"
#if defined(__x86_64__)
#define DRESSLIFE_TARGET HWY_EMU128
#endif

#include "pipeline/base/simd.h"  // and what loops use from outside: it must be compiled for any machine

DRESSLIFE_BEGIN_MACHINE
#include "strain/loose/kernels/body.h"
DRESSLIFE_END_MACHINE
