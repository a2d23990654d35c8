// The loop of lockstep.h for the plain instruction set of the build: any machine of its kind.
#define DRESSLIFE_MACHINE baseline_lockstep
#define DRESSLIFE_REGISTER_BYTES 8

// Everything from outside comes first: it must be compiled for any machine.
#include "fatigue/lockstep.h"

#include "fatigue/lockstep_body.h"
