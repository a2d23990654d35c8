// The loop of lockstep.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_MACHINE avx512
#define DRESSLIFE_LOCKSTEP avx512_lockstep
#define DRESSLIFE_TARGET HWY_AVX3_DL

// Everything from outside comes first: it must be compiled for any machine.
#include "fatigue/kernels/lockstep.h"
#include "pipeline/base/simd.h"

DRESSLIFE_BEGIN_MACHINE
#include "fatigue/kernels/body.h"
DRESSLIFE_END_MACHINE
#endif
