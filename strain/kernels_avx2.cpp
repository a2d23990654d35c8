// The hot loops for AVX2 with fused multiply-add (x86-64 since 2013).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DRESSLIFE_MACHINE avx2
#define DRESSLIFE_MACHINE_KERNELS avx2_kernels
#define DRESSLIFE_MACHINE_NAME "avx2"
#define DRESSLIFE_REGISTER_BYTES 32

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
#pragma GCC target("avx,avx2,fma,bmi,bmi2")
#include "strain/kernels_body.h"
#pragma GCC pop_options
#endif
