// The loop of lockstep.h for the plain instruction set of the build: any machine of its kind.
#define DRESSLIFE_MACHINE baseline
#define DRESSLIFE_LOCKSTEP baseline_lockstep
#define DRESSLIFE_TARGET HWY_SCALAR  // two lanes gain less than their look-ups in tables cost

// Everything from outside comes first: it must be compiled for any machine.
#include "fatigue/kernels/lockstep.h"
#include "pipeline/base/simd.h"

DRESSLIFE_BEGIN_MACHINE
#include "fatigue/kernels/body.h"
DRESSLIFE_END_MACHINE
