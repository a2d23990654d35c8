// The loop of lockstep.h for every machine for which a build is made (simd.h).
#define DRESSLIFE_MACHINE portable
#define DRESSLIFE_LOCKSTEP portable_lockstep
#define DRESSLIFE_TARGET HWY_SCALAR  // with two lanes the table look-ups cost more than the lanes gain

// These are included first, before DRESSLIFE_BEGIN_MACHINE, because they must be compiled for any machine.
#include "fatigue/kernels/lockstep.h"
#include "pipeline/base/simd.h"

DRESSLIFE_BEGIN_MACHINE
#include "fatigue/kernels/body.h"
DRESSLIFE_END_MACHINE
