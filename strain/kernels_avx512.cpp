// The hot loops for AVX-512.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_MACHINE avx512
#define DRESSLIFE_MACHINE_KERNELS avx512_kernels
#define DRESSLIFE_MACHINE_NAME "avx512"
#define DRESSLIFE_REGISTER_BYTES 64

// Everything from outside comes first: it must be compiled for any machine.
#include <immintrin.h>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "pipeline/job.h"

#pragma GCC push_options
#pragma GCC target("avx,avx2,fma,bmi,bmi2,avx512f,avx512vl,avx512bw,avx512dq,avx512cd,avx512vbmi,gfni,prefer-vector-width=512")
#include "strain/kernels_body.h"
#pragma GCC pop_options
#endif
