// The loop of lockstep.h for every machine that a build is for (simd.h).
#define DRESSLIFE_MACHINE portable
#define DRESSLIFE_LOCKSTEP portable_lockstep
#define DRESSLIFE_TARGET HWY_SCALAR  // two lanes gain less than their look-ups in tables cost

// Everything from outside comes first: it must be compiled for any machine.
#include "fatigue/kernels/lockstep.h"
#include "pipeline/base/simd.h"

DRESSLIFE_BEGIN_MACHINE
#include "fatigue/kernels/body.h"
DRESSLIFE_END_MACHINE
