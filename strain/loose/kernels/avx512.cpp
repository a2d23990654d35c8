// The hot loops of loose cables for AVX-512.
#include "pipeline/base/instruction_set.h"
#ifdef DRESSLIFE_WIDE_KERNELS
#define DRESSLIFE_MACHINE avx512
#define DRESSLIFE_MACHINE_KERNELS avx512_loose
#define DRESSLIFE_MACHINE_NAME "avx512"
#define DRESSLIFE_TARGET HWY_AVX3_DL

#include "pipeline/base/simd.h"  // included here, with its own includes, because it must be compiled for any machine

DRESSLIFE_BEGIN_MACHINE
#include "strain/loose/kernels/body.h"
DRESSLIFE_END_MACHINE
#endif
