// The hot loops of loose cables for the plain instruction set of the build: any machine of its kind.
#define DRESSLIFE_MACHINE baseline
#define DRESSLIFE_MACHINE_KERNELS baseline_loose
#define DRESSLIFE_MACHINE_NAME "baseline"
#if defined(__x86_64__)
#define DRESSLIFE_TARGET HWY_EMU128
#endif

// Everything from outside comes first: it must be compiled for any machine.
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "pipeline/simd.h"

DRESSLIFE_BEGIN_MACHINE
#include "strain/loose/kernels/body.h"
DRESSLIFE_END_MACHINE
