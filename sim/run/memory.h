// The memory that a simulation needs, computed when its motion is known (pipeline/stage/memory.h).
#pragma once

#include "pipeline/job/uncertainty.h"
#include "pipeline/stage/memory.h"

namespace dresslife::sim {

class Simulation;

pipeline::MemoryNeed memory_of(const Simulation& simulation, const pipeline::Uncertainty& uncertainty);

}  // namespace dresslife::sim
