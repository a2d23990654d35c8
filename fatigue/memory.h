// Memory of a fatigue evaluation, from the sizes of its strain file (pipeline/stage/memory.h).
#pragma once

#include <cstddef>

#include "pipeline/stage/memory.h"

namespace dresslife::pipeline {
class FileReader;
}

namespace dresslife::fatigue {

pipeline::MemoryNeed memory_of(const pipeline::FileReader& strain, std::size_t threads);

}  // namespace dresslife::fatigue
