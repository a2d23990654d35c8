// What is wrong with a job as far as geometry and statics say, in seconds: slack over the whole program, as a run finds
// it; bend radius and twist of the dresspack at rest, pose after pose of the program; axes that wind the dresspack up before the
// program begins.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::sim {

/// Errors: InputError for a motion that the robot cannot run.
std::vector<pipeline::Warning> quick_warnings(const pipeline::Setup& setup);

}  // namespace dresslife::sim
