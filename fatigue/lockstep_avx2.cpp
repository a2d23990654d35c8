// The loop of lockstep.h for AVX2 with fused multiply-add (x86-64 since 2013).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_MACHINE avx2_lockstep
#define DRESSLIFE_REGISTER_BYTES 32

// Everything from outside comes first: it must be compiled for any machine.
#include <immintrin.h>

#include "fatigue/lockstep.h"

#pragma GCC push_options
#pragma GCC target("avx,avx2,fma,bmi,bmi2")
#include "fatigue/lockstep_body.h"
#pragma GCC pop_options
#endif
