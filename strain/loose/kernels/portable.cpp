// The hot loops of loose cables for every machine for which a build is made (simd.h).
#define DRESSLIFE_MACHINE portable
#define DRESSLIFE_MACHINE_KERNELS portable_loose
#define DRESSLIFE_MACHINE_NAME "portable"

#include "pipeline/base/simd.h"  // included here, with its own includes, because it must be compiled for any machine

DRESSLIFE_BEGIN_MACHINE
#include "strain/loose/kernels/body.h"
DRESSLIFE_END_MACHINE
