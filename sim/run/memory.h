// The memory of a simulation, known when its motion is (pipeline/stage/memory.h).
#pragma once

#include "pipeline/job/uncertainty.h"
#include "pipeline/stage/memory.h"

namespace dresslife::sim {

class Simulation;

pipeline::MemoryNeed memory_of(const Simulation& simulation, const pipeline::Uncertainty& uncertainty);

}  // namespace dresslife::sim
