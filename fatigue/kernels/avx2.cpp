// The loop of lockstep.h for AVX2.
#include "pipeline/base/instruction_set.h"
#ifdef DRESSLIFE_WIDE_KERNELS
#define DRESSLIFE_MACHINE avx2
#define DRESSLIFE_LOCKSTEP avx2_lockstep
#define DRESSLIFE_TARGET HWY_AVX2

// These are included first, before DRESSLIFE_BEGIN_MACHINE, because they must be compiled for any machine.
#include "fatigue/kernels/lockstep.h"
#include "pipeline/base/simd.h"

DRESSLIFE_BEGIN_MACHINE
#include "fatigue/kernels/body.h"
DRESSLIFE_END_MACHINE
#endif
