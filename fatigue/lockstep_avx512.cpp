// The loop of lockstep.h for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_MACHINE avx512_lockstep
#define DRESSLIFE_REGISTER_BYTES 64

// Everything from outside comes first: it must be compiled for any machine.
#include <immintrin.h>

#include "fatigue/lockstep.h"

#pragma GCC push_options
#pragma GCC target( \
    "avx,avx2,fma,bmi,bmi2,avx512f,avx512vl,avx512bw,avx512dq,avx512cd,prefer-vector-width=512")
#include "fatigue/lockstep_body.h"
#pragma GCC pop_options
#endif
